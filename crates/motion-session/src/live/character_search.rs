//! One character's search as the animator has it: it goes on under every edit, and the take that is
//! looked at stays.
//!
//! Rules about the **shown take**, each with a test of its name:
//!
//! 1. Until the animator picks or edits, the best is shown, for the first rounds and until it is
//!    acceptable; then it counts as picked.
//! 2. After that the shown take changes only by an edit, by choice, or by following the best.
//! 3. After an edit it is refined among its own descendants until nothing more is gained.
//! 4. Back at earlier constraints, the take that was shown for them is shown again, if it is an
//!    ancestor or a descendant of the one shown now.

use std::collections::{BTreeMap, HashSet, VecDeque};
use std::sync::Arc;

use motion_core::cancel::CancelToken;
use motion_core::path::Path;
use motion_core::score::Judgement;
use motion_core::search::Search;
use motion_io::content_hash::ContentHash;

use super::company::SettledTake;
use super::kindred::Kindred;
use super::layers::Layers;
use super::lineage::Lineage;
use super::ready_library::ReadyLibrary;
use super::snapshot::{BestAt, Better, CharacterSnapshot, ConstraintHash, Made, SearchState, Take};
use crate::document::{ByHand, TakeId, TakePiece};
use crate::finish::misses::{Misses, constraint_reports};
use crate::finish::{Assembly, Finished, assemble};
use crate::problem::CharacterProblem;
use crate::solve_job::Alternative;
use crate::suggest::{Case, Effort, Ground, Suggester};
use crate::unmet::too_fast::infeasible;

/// Constraints whose searches are remembered, so that undo brings their takes back.
const MAX_REMEMBERED: usize = 24;
/// Paths beside the search's own that are scored again after an edit.
const MAX_POOL: usize = 160;
/// Takes whose paths are known for a pick.
const MAX_SEEN: usize = 256;
/// Rounds without anything new after which a search has settled.
const SETTLED_AFTER: u64 = 100;
/// Rounds after which the first take counts as picked if it is acceptable: about half a second.
const FIRST_ROUNDS_AT_LEAST: u64 = 24;
/// Rounds after which it does, acceptable or not.
const FIRST_ROUNDS_AT_MOST: u64 = 72;
/// A better take must be better by this share to be worth a badge.
const WORTH_A_BADGE: f32 = 0.01;
/// Rounds that a change of what is asked is tried with.
const ROUNDS_OF_A_CHANGE: u64 = 8;
/// Points of the sparkline.
const MAX_TRACE: usize = 512;

/// A character's search.
pub(super) struct CharacterSearch {
    ready: ReadyLibrary,
    asked: CharacterProblem,
    version: ConstraintHash,
    search: Search,
    /// What cannot be in what is asked.
    infeasible: Vec<String>,
    remembered: Vec<Remembered>,
    /// Paths of earlier constraints, the latest first.
    pool: Vec<Path>,
    pinned: Vec<Path>,
    kindred: Kindred,
    lineage: Lineage,
    shown: Option<Shown>,
    follow_best: bool,
    layers: Layers,
    made: BTreeMap<TakeId, Kept>,
    trace: Vec<BestAt>,
    /// Paths of takes that were in snapshots: a pick may come when they are none any more.
    seen: VecDeque<(TakeId, Path)>,
    /// Whether the present constraints are worth remembering.
    passing: Passing,
    /// What the search knew when something new last came, and in which round.
    news: (f32, usize, u64),
    /// How takes were judged for the present constraints: with obstacles that takes a while.
    judged: BTreeMap<TakeId, Option<Judgement>>,
    /// Changes that may help, for the present constraints; none before they are thought of.
    suggester: Option<Suggester>,
}

/// The take that is looked at.
#[derive(Clone, Debug)]
struct Shown {
    path: Path,
    id: TakeId,
    picked: TakeId,
    /// Whether the animator has not had a word in it yet.
    is_provisional: bool,
    /// Whether it is being refined after an edit.
    is_refining: bool,
}

/// A motion with what it was made of, so that a change by hand need not begin from the pieces.
struct Kept {
    assembly: Assembly,
    made: Made,
}

/// A search for earlier constraints.
struct Remembered {
    version: ConstraintHash,
    search: Search,
    shown: Option<(Path, TakeId)>,
}

/// Whether constraints are passing by or have been arrived at.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Passing {
    /// In the middle of a drag: not worth remembering.
    By,
    /// Where a gesture or a command has ended.
    Not,
}

/// The hash of what is asked.
pub(super) fn version_of(asked: &CharacterProblem, seed: u64) -> ConstraintHash {
    // Numbers print as the shortest text that reads back as them, so equal text is equal numbers.
    let text = format!("{:?} {:?} {seed}", asked.problem, asked.ids);
    let bytes = ContentHash::of(text.as_bytes()).0;
    ConstraintHash(bytes.iter().take(8).fold(0, |hash, &byte| hash << 8 | u64::from(byte)))
}

impl CharacterSearch {
    /// A search for `asked`; fails with a sentence.
    pub(super) fn new(
        ready: ReadyLibrary,
        asked: CharacterProblem,
        seed: u64,
        pinned: &[Path],
    ) -> Result<Self, String> {
        let search =
            Search::with_paths(Arc::clone(&ready.search), asked.problem.clone(), seed, pinned);
        let search = search.map_err(|error| asked.refusal(&error).to_string())?;
        Ok(Self {
            version: version_of(&asked, seed),
            infeasible: infeasible(&asked, &ready.library),
            ready,
            asked,
            search,
            remembered: Vec::new(),
            pool: Vec::new(),
            pinned: pinned.to_vec(),
            kindred: Kindred::default(),
            lineage: Lineage::default(),
            shown: None,
            follow_best: false,
            layers: Layers::default(),
            made: BTreeMap::new(),
            trace: Vec::new(),
            seen: VecDeque::new(),
            passing: Passing::Not,
            news: (f32::INFINITY, 0, 0),
            judged: BTreeMap::new(),
            suggester: None,
        })
    }

    /// The library that it searches.
    pub(super) fn ready(&self) -> &ReadyLibrary {
        &self.ready
    }

    /// Something else is asked. What is known is scored anew, and the search
    /// goes on from there.
    pub(super) fn ask(
        &mut self,
        asked: CharacterProblem,
        seed: u64,
        passing: Passing,
    ) -> Result<(), String> {
        let version = version_of(&asked, seed);
        if version == self.version {
            self.asked = asked;
            self.passing = passing;
            return Ok(());
        }
        let known = self.remembered.iter().position(|r| r.version == version);
        let (mut search, back_to) = match known {
            Some(at) => (self.remembered[at].search.clone(), self.remembered[at].shown.clone()),
            None => {
                let rescored = self.search.rescored(asked.problem.clone(), &self.pool);
                (rescored.map_err(|error| asked.refusal(&error).to_string())?, None)
            }
        };
        search.reseed(seed);
        self.remember();
        let left = self.search.paths();
        for path in &self.pinned {
            search.offer(path, None);
        }
        std::mem::swap(&mut self.search, &mut search);
        // The latest first; what falls out at the end was known longest ago.
        let old = std::mem::take(&mut self.pool);
        self.pool = left;
        self.pool.extend(old);
        let mut seen = HashSet::new();
        self.pool.retain(|path| seen.insert(path.clone()));
        self.pool.truncate(MAX_POOL);
        self.infeasible = infeasible(&asked, &self.ready.library);
        (self.asked, self.version) = (asked, version);
        self.suggester = None;
        self.judged.clear();
        self.trace.clear();
        self.news = (f32::INFINITY, 0, self.search.progress().iteration);
        if let Some(shown) = &mut self.shown {
            shown.is_provisional = false;
            shown.is_refining = true;
            if let Some((path, id)) = back_to
                && (self.lineage.descends(shown.id, id) || self.lineage.descends(id, shown.id))
                && self.lineage.descends(id, shown.picked)
            {
                (shown.path, shown.id) = (path, id);
                shown.is_refining = false;
            }
        }
        self.passing = passing;
        self.note_news();
        Ok(())
    }

    /// Which takes are kept with the project.
    pub(super) fn pin(&mut self, pinned: &[Path]) {
        for path in pinned.iter().filter(|path| !self.pinned.contains(path)) {
            self.search.offer(path, None);
        }
        self.pinned = pinned.to_vec();
    }

    /// What is changed by hand on kept takes. Motions are made anew where that is something else
    /// than before; the search goes on as it was.
    pub(super) fn lay<'l>(&mut self, layers: impl Iterator<Item = (TakeId, &'l ByHand)>) {
        self.layers.set(layers, &self.ready.skeleton);
    }

    /// The animator chooses a take to look at.
    pub(super) fn pick(&mut self, id: TakeId) {
        if let Some(path) = self.path_of(id) {
            self.show(path, false);
        }
    }

    /// Looks for takes that share much with this one.
    pub(super) fn more_like(&mut self, id: TakeId) {
        if let Some(path) = self.path_of(id) {
            self.kindred.begin(path);
            self.news.2 = self.search.progress().iteration;
        }
    }

    fn path_of(&self, id: TakeId) -> Option<Path> {
        let known = self.search.alternatives().into_iter().map(|solution| solution.path);
        let seen = self.seen.iter().find(|(seen, _)| *seen == id).map(|(_, path)| path.clone());
        seen.or_else(|| known.chain(self.pinned.iter().cloned()).find(|path| self.id(path) == id))
    }

    /// Whether the best take is shown whenever there is a better one.
    pub(super) fn follow_best(&mut self, follow: bool) {
        self.follow_best = follow;
        self.follow();
    }

    /// Other seeds; what was found stays.
    pub(super) fn shake(&mut self) {
        self.suggester = None;
        self.search.shake();
        self.news.2 = self.search.progress().iteration;
    }

    /// Whether nothing new has come for long.
    pub(super) fn is_settled(&self) -> bool {
        let iteration = self.search.progress().iteration;
        iteration >= self.news.2 + SETTLED_AFTER
            && !self.is_refining()
            && !self.kindred.is_looking()
    }

    /// Whether the shown take may still be gained on since the last edit.
    pub(super) fn is_refining(&self) -> bool {
        self.shown.as_ref().is_some_and(|shown| shown.is_refining)
    }

    /// The take that is looked at, once nothing is being done about it and its motion is made for
    /// what is asked.
    pub(super) fn settled_take(&self) -> Option<SettledTake> {
        let shown = self.shown.as_ref().filter(|s| !s.is_refining && !s.is_provisional)?;
        let made = &self.made.get(&shown.id)?.made;
        let (path, motion) = (shown.path.clone(), Arc::clone(&made.motion));
        (made.version == self.version).then_some(SettledTake { path, motion })
    }

    /// One round of the search. Returns `false` if it was cancelled.
    pub(super) fn round(&mut self, cancel: &CancelToken) -> bool {
        if !self.search.step(cancel) {
            return false;
        }
        if let Some((child, of)) = self.kindred.step(&self.search, cancel) {
            self.lineage.note(self.id(&child), self.id(&of));
        }
        for solution in self.search.alternatives() {
            if let Some(parent) = &solution.improves {
                self.lineage.note(self.id(&solution.path), self.id(parent));
            }
        }
        self.note_news();
        self.follow();
        true
    }

    /// One step of the shown take among its own descendants, after an edit.
    pub(super) fn refine(&mut self, cancel: &CancelToken) {
        let Some(shown) = self.shown.as_ref().filter(|shown| shown.is_refining) else { return };
        let better = self.search.improve(&shown.path, cancel);
        if cancel.is_cancelled() {
            return;
        }
        match better {
            Some(better) => {
                let id = self.id(&better.path);
                self.lineage.note(id, shown.id);
                if let Some(shown) = &mut self.shown {
                    (shown.path, shown.id) = (better.path, id);
                }
            }
            None => {
                let path = shown.path.clone();
                if let Some(shown) = &mut self.shown {
                    shown.is_refining = false;
                }
                self.search.offer(&path, None);
                self.note_news();
            }
        }
    }

    /// Makes one motion that is not made for the present constraints yet, the shown take's first;
    /// `only_shown` during a drag. Returns whether one was made.
    pub(super) fn finish_one(&mut self, only_shown: bool) -> bool {
        let shown = self.shown.as_ref().map(|shown| shown.path.clone());
        let mut paths: Vec<Path> = shown.into_iter().collect();
        if !only_shown {
            paths.extend(self.search.alternatives().into_iter().map(|solution| solution.path));
            paths.extend(self.pinned.iter().cloned());
            paths.extend(self.kindred.paths(&self.search));
        }
        let assembler = self.ready.assembler();
        for path in paths {
            let id = self.id(&path);
            let by_hand = self.layers.of(id, &self.lineage);
            let known = self.made.get(&id).filter(|kept| kept.made.version == self.version);
            if known.is_some_and(|kept| kept.made.by_hand == by_hand) {
                continue;
            }
            let library = &self.ready.library;
            // What is stale is to be seen until there is something else.
            let assembly = match known {
                Some(_) => self.made.remove(&id).map(|kept| kept.assembly),
                None => self.search.judge(&path).and_then(|judgement| {
                    let alternative =
                        Alternative { path, judgement, iteration: 0, found_at_s: 0.0 };
                    assemble(library, &assembler, &self.asked, &alternative, 0)
                }),
            };
            let Some(assembly) = assembly else { continue };
            let layer = by_hand.as_ref().and_then(|by_hand| self.layers.on_body(by_hand.from));
            let Finished { motion, before_hand, source_frames, report } =
                assembly.finish(library, &self.asked, layer);
            let (report, version) = (Arc::new(report), self.version);
            let made = Made { motion, before_hand, source_frames, by_hand, report, version };
            self.made.insert(id, Kept { assembly, made });
            return true;
        }
        false
    }

    /// Tries the next change that may help, where the search has settled on a best motion that misses
    /// something. Returns whether there was one.
    pub(super) fn suggest_one(&mut self, ground: &Ground<'_>, cancel: &CancelToken) -> bool {
        if self.suggester.is_none() {
            let best = self.search.best().and_then(|best| {
                let judgement = self.search.judge(&best.path)?;
                Some((best.path, judgement))
            });
            let Some((path, judgement)) = best else { return false };
            let of = (ground.document, ground.character);
            let case = Case::new(of, &self.asked, ground.library, &path, &judgement);
            self.suggester =
                Some(case.map_or_else(Suggester::default, |case| Suggester::new(&case)));
        }
        let Some(suggester) = self.suggester.as_mut().filter(|known| known.n_waiting() > 0) else {
            return false;
        };
        suggester.try_next(ground, &self.search, Effort::Rounds(ROUNDS_OF_A_CHANGE), cancel);
        true
    }

    /// Everything that is known now.
    pub(super) fn snapshot(&mut self) -> CharacterSnapshot {
        let mut takes: Vec<Take> = Vec::new();
        let solutions = self.search.alternatives();
        let found = solutions.into_iter().map(|solution| (solution.path, solution.iteration));
        let iterations = self.search.progress().iteration;
        let shown = self.shown.iter().map(|shown| (shown.path.clone(), iterations));
        let pinned = self.pinned.iter().map(|path| (path.clone(), 0));
        let kindred = self.kindred.paths(&self.search).map(|path| (path, iterations));
        let all: Vec<(Path, u64)> = found.chain(shown).chain(pinned).chain(kindred).collect();
        for (path, found_in) in all {
            let id = self.id(&path);
            if takes.iter().all(|take| take.id != id) {
                takes.push(self.take(&path, id, found_in));
                if self.seen.iter().all(|(seen, _)| *seen != id) {
                    self.seen.push_back((id, path));
                    self.seen.drain(..self.seen.len().saturating_sub(MAX_SEEN));
                }
            }
        }
        // A take that meets everything comes before one that scores better and does not.
        takes.sort_by(|a, b| {
            let is_short = |take: &Take| !self.is_acceptable(take.id);
            is_short(a).cmp(&is_short(b)).then(a.score.total_cmp(&b.score))
        });
        self.made.retain(|id, _| takes.iter().any(|take| take.id == *id));
        self.judged.retain(|id, _| takes.iter().any(|take| take.id == *id));
        let mut remarks = self.asked.remarks.clone();
        remarks.extend(self.infeasible.iter().cloned());
        remarks.extend(self.layers.remarks().iter().cloned());
        CharacterSnapshot {
            name: self.asked.name.clone(),
            version: self.version,
            state: self.state(),
            iterations,
            shown: self.shown.as_ref().map(|shown| shown.id),
            picked: self.shown.as_ref().map(|shown| shown.picked),
            better: self.better(&takes),
            takes,
            trace: self.trace.clone(),
            remarks,
            suggestions: self.suggester.as_ref().map_or_else(Vec::new, Suggester::suggestions),
        }
    }

    /// Whether the shown take is the picked one or was made of it by improvements.
    #[cfg(test)]
    pub(super) fn shown_descends_from(&self, picked: TakeId) -> bool {
        self.shown.as_ref().is_some_and(|shown| self.lineage.descends(shown.id, picked))
    }

    fn state(&self) -> SearchState {
        match self.infeasible.first() {
            Some(reason) => SearchState::Infeasible(reason.clone()),
            None if self.is_settled() => SearchState::Settled,
            None => SearchState::Searching,
        }
    }

    fn take(&mut self, path: &Path, id: TakeId, found_in: u64) -> Take {
        let judged = self.judged.entry(id).or_insert_with(|| self.search.judge(path)).clone();
        let terms = judged.as_ref().map(|judged| judged.terms).unwrap_or_default();
        let misses = judged
            .as_ref()
            .map(|judged| constraint_reports(&self.asked, &Misses::before_correction(judged)));
        let pieces = path.pieces(&self.ready.library.graph);
        let n_frames: usize = pieces.iter().map(|piece| piece.n_frames()).sum();
        Take {
            id,
            parent: self.lineage.parent(id),
            score: judged.map_or(f32::INFINITY, |judged| judged.terms.total()),
            terms,
            misses: misses.unwrap_or_default().into(),
            n_frames: u32::try_from(n_frames).unwrap_or(u32::MAX),
            found_in,
            is_pinned: self.pinned.contains(path),
            pieces: self.pieces(path).into(),
            by_hand: self.layers.of(id, &self.lineage),
            made: self.made.get(&id).map(|kept| kept.made.clone()),
        }
    }

    /// Whether a take that was judged is within every tolerance.
    fn is_acceptable(&self, id: TakeId) -> bool {
        let judged = self.judged.get(&id).and_then(Option::as_ref);
        judged.is_some_and(|judged| judged.is_acceptable(&self.search.problem().wishes))
    }

    fn better(&self, takes: &[Take]) -> Option<Better> {
        let shown = takes.iter().find(|take| Some(take.id) == self.shown.as_ref().map(|s| s.id))?;
        let best = takes.first().filter(|best| best.id != shown.id)?;
        let gain = if shown.score.is_finite() { 1.0 - best.score / shown.score } else { 1.0 };
        (gain >= WORTH_A_BADGE).then_some(Better { take: best.id, by_percent: 100.0 * gain })
    }

    fn show(&mut self, path: Path, is_provisional: bool) {
        let id = self.id(&path);
        self.shown = Some(Shown { path, id, picked: id, is_provisional, is_refining: false });
    }

    /// Shows the best where nothing was picked yet, or the user wants it.
    fn follow(&mut self) {
        let provisional = self.shown.as_ref().is_none_or(|shown| shown.is_provisional);
        if !provisional && !self.follow_best {
            return;
        }
        let Some(best) = self.search.alternatives().into_iter().next() else { return };
        let progress = self.search.progress();
        let goes_on = progress.iteration < FIRST_ROUNDS_AT_LEAST
            || (progress.first_acceptable.is_none() && progress.iteration < FIRST_ROUNDS_AT_MOST);
        let is_other = self.shown.as_ref().is_none_or(|shown| shown.path != best.path);
        if is_other {
            self.show(best.path, goes_on && provisional);
        } else if let Some(shown) = &mut self.shown {
            shown.is_provisional &= goes_on;
        }
    }

    fn note_news(&mut self) {
        let progress = self.search.progress();
        let (best, n, _) = self.news;
        // Alternatives come and go where one takes another's place.
        if progress.best < best || progress.n_alternatives > n {
            let n = progress.n_alternatives.max(n);
            self.news = (progress.best, n, progress.iteration);
        }
        let fell = self.trace.last().is_none_or(|last| progress.best < last.best);
        if fell && progress.best.is_finite() && self.trace.len() < MAX_TRACE {
            self.trace.push(BestAt { iteration: progress.iteration, best: progress.best });
        }
    }

    /// Remembers where the search for the present constraints stands.
    fn remember(&mut self) {
        if self.passing == Passing::By {
            return;
        }
        self.remembered.retain(|remembered| remembered.version != self.version);
        let shown = self.shown.as_ref().map(|shown| (shown.path.clone(), shown.id));
        let (version, search) = (self.version, self.search.clone());
        self.remembered.push(Remembered { version, search, shown });
        if self.remembered.len() > MAX_REMEMBERED {
            self.remembered.remove(0);
        }
    }

    fn pieces(&self, path: &Path) -> Vec<TakePiece> {
        self.ready.pieces(path)
    }

    fn id(&self, path: &Path) -> TakeId {
        TakeId::of(&self.pieces(path))
    }
}

#[cfg(test)]
pub(super) mod tests;
