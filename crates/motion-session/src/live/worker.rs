//! The worker's loop: hear the latest wish, do a little, say how things stand.
//!
//! After an edit the order is: the shown take corrected for the new constraints, which is a
//! snapshot at once; then it is refined a step; then a round for everything. So what is dragged
//! follows the pointer however long a round takes.

use std::path::Path;
use std::sync::Arc;
use std::time::Duration;

use motion_core::cancel::CancelToken;
use motion_io::diagnostic::FileError;
use motion_io::project_file::Project;

use super::character_search::{CharacterSearch, Passing};
use super::company::{Company, SettledTake};
use super::wish::{Request, Shared, Wish};
use super::{
    CharacterSnapshot, Phase, ReadyLibrary, SearchSnapshot, SearchState, Wake, kept_paths,
    wants_bridges,
};
use crate::document::CharacterIdx;
use crate::problem::{CharacterProblem, interactions_of, problem_of};
use crate::suggest::Ground;

/// How long the worker sleeps when nothing is to do; a wish wakes it.
const NAP: Duration = Duration::from_secs(3600);

/// Steps of refinement before the next snapshot.
const STEPS_PER_SNAPSHOT: usize = 2;

/// Runs until the wish is that it be over.
pub(super) fn run(shared: &Shared, wake: &Wake) {
    let mut worker = Worker::default();
    let publish = |worker: &mut Worker| {
        shared.snapshots.put(Arc::new(worker.snapshot()));
        wake();
    };
    let mut is_idle = true;
    loop {
        let token = shared.next_round();
        let wish = if is_idle { shared.wishes.wait(NAP) } else { shared.wishes.take() };
        if let Some(wish) = wish {
            if wish.is_over {
                return;
            }
            worker.hear(wish);
            worker.correct_shown();
            publish(&mut worker);
            // However fast wishes come, each lets the shown take come a little nearer.
            if worker.refine_shown(&CancelToken::new()) {
                worker.correct_shown();
                publish(&mut worker);
            }
            is_idle = false;
        } else {
            is_idle = !worker.work(&token);
            if !is_idle {
                // A round may have another take shown: one without a motion would have the body, and
                // all that can be done with it, gone until the next.
                worker.correct_shown();
                publish(&mut worker);
            }
        }
    }
}

#[derive(Default)]
struct Worker {
    wish: Wish,
    seats: Vec<Seat>,
    /// Whose turn it is to search.
    turn: usize,
    company: Company,
}

/// A character of the document.
#[derive(Default)]
struct Seat {
    name: String,
    search: Option<CharacterSearch>,
    /// Why what is asked cannot be searched.
    refusal: Option<String>,
    remarks: Vec<String>,
    n_picks: u64,
    n_likes: u64,
}

impl Worker {
    fn hear(&mut self, wish: Wish) {
        let old = std::mem::replace(&mut self.wish, wish);
        let number = |wish: &Wish| wish.request.as_ref().map(|request| request.number);
        if let Some(request) = self.wish.request.clone()
            && number(&old) != number(&self.wish)
        {
            self.take_up(&request);
        }
        for (nth, seat) in self.seats.iter_mut().enumerate() {
            let Some(search) = &mut seat.search else { continue };
            if self.wish.n_shakes != old.n_shakes {
                search.shake();
            }
            if let Some(pick) = self.wish.picks.get(&CharacterIdx(nth))
                && pick.nth != seat.n_picks
            {
                search.pick(pick.take);
                seat.n_picks = pick.nth;
            }
            if let Some(like) = self.wish.likes.get(&CharacterIdx(nth))
                && like.nth != seat.n_likes
            {
                search.more_like(like.take);
                seat.n_likes = like.nth;
            }
            search.follow_best(self.wish.follow_best);
        }
    }

    /// Brings every character's search to what the request asks.
    fn take_up(&mut self, request: &Request) {
        let project = request.document.to_project();
        let library = &request.library;
        let passing = match request.phase {
            Phase::Dragging => Passing::By,
            Phase::Settled => Passing::Not,
        };
        self.take_seats(project.characters.iter().map(|character| character.name.as_str()));
        let bridges = wants_bridges(&project);
        let alone: Vec<_> = project
            .characters
            .iter()
            .map(|character| {
                problem_of(&project, character, &library.library, bridges, &request.path)
            })
            .collect();
        let remark = self.meet(&project, &alone, library, &request.path);
        for (nth, (seat, asked)) in self.seats.iter_mut().zip(alone).enumerate() {
            let character = &project.characters[nth];
            let seed = seed_of(&project, nth);
            let (kept, mut remarks) = kept_paths(&request.document, &character.name, library);
            remarks.extend(remark.clone());
            if character.library.is_some() {
                remarks.push("the character's own library is not used here yet".to_owned());
            }
            seat.remarks = remarks;
            seat.refusal = None;
            let asked = match asked {
                Ok(alone) => self.company.asked_of(nth).unwrap_or(alone),
                Err(error) => {
                    seat.refusal = Some(format!("{}; {}", error.what, error.what_to_do));
                    continue;
                }
            };
            let refused = match &mut seat.search {
                Some(search) if search.ready().is(library) => {
                    let refused = search.ask(asked, seed, passing).err();
                    search.pin(&kept);
                    refused
                }
                _ => match CharacterSearch::new(library.clone(), asked, seed, &kept) {
                    Ok(search) => {
                        seat.search = Some(search);
                        None
                    }
                    Err(refusal) => Some(refusal),
                },
            };
            seat.refusal = refused;
            if let Some(search) = &mut seat.search {
                let takes = request.document.takes().iter();
                let own = takes.filter(|take| take.character == character.name);
                search.lay(own.filter_map(|take| Some((take.id(), take.by_hand.as_ref()?))));
            }
        }
    }

    /// Has the characters hear of each other, if all of them can be searched. Returns why their
    /// interactions cannot be, where that is so.
    fn meet(
        &mut self,
        project: &Project,
        alone: &[Result<CharacterProblem, FileError>],
        library: &ReadyLibrary,
        path: &Path,
    ) -> Option<String> {
        let known: Vec<&CharacterProblem> = alone.iter().filter_map(|a| a.as_ref().ok()).collect();
        if known.len() != alone.len() {
            self.company.part();
            return None;
        }
        let on_library: Vec<_> = known.iter().map(|asked| (*asked, &library.library)).collect();
        match interactions_of(project, &on_library, path) {
            Ok(interactions) => {
                let frame_secs = library.library.clips.fps().frame_secs() as f32;
                let alone = known.into_iter().cloned().collect();
                self.company.take_up(project, alone, interactions, frame_secs);
                None
            }
            Err(error) => {
                self.company.part();
                Some(format!("{}; {}", error.what, error.what_to_do))
            }
        }
    }

    /// Where all takes that are shown have settled, has who is in another's way hear of it. Returns
    /// whether somebody is asked anew.
    fn exchange(&mut self) -> bool {
        let Some(request) = self.wish.request.clone() else { return false };
        let takes: Option<Vec<SettledTake>> =
            self.seats.iter().map(|seat| seat.search.as_ref()?.settled_take()).collect();
        let Some(takes) = takes else { return false };
        let project = request.document.to_project();
        let asked_anew = self.company.exchange(&request.library.search, &takes);
        for &nth in &asked_anew {
            let (Some(asked), Some(search)) =
                (self.company.asked_of(nth), self.seats[nth].search.as_mut())
            else {
                continue;
            };
            self.seats[nth].refusal = search.ask(asked, seed_of(&project, nth), Passing::Not).err();
        }
        !asked_anew.is_empty()
    }

    /// Gives every character the seat that it had: by its name, or where nobody has that any more,
    /// by its place, for it was renamed then.
    fn take_seats<'n>(&mut self, names: impl Iterator<Item = &'n str>) {
        let names: Vec<&str> = names.collect();
        let mut old: Vec<Option<Seat>> =
            std::mem::take(&mut self.seats).into_iter().map(Some).collect();
        let mut seats: Vec<Option<Seat>> = Vec::with_capacity(names.len());
        for name in &names {
            let same = |seat: &&mut Option<Seat>| seat.as_ref().is_some_and(|s| s.name == *name);
            seats.push(old.iter_mut().find(same).and_then(Option::take));
        }
        let seat = |(nth, (seat, name)): (usize, (Option<Seat>, &&str))| {
            let seat = seat.or_else(|| old.get_mut(nth).and_then(Option::take)).unwrap_or_default();
            Seat { name: (*name).to_owned(), ..seat }
        };
        self.seats = seats.into_iter().zip(&names).enumerate().map(seat).collect();
    }

    /// Makes the motions that are looked at, where they are not made for what is asked now.
    fn correct_shown(&mut self) -> bool {
        let mut did = false;
        for search in self.seats.iter_mut().filter_map(|seat| seat.search.as_mut()) {
            did |= search.finish_one(true);
        }
        did
    }

    /// Refines the takes that are looked at by a few steps, after an edit.
    fn refine_shown(&mut self, token: &CancelToken) -> bool {
        let mut did = false;
        for search in self.seats.iter_mut().filter_map(|seat| seat.search.as_mut()) {
            for _ in 0..STEPS_PER_SNAPSHOT {
                if search.is_refining() && !token.is_cancelled() {
                    search.refine(token);
                    did = true;
                }
            }
        }
        did
    }

    /// A little work; returns whether there was any. What is looked at comes first, and is to be
    /// seen before anything else is done.
    fn work(&mut self, token: &CancelToken) -> bool {
        // Refining belongs to the edit, so it goes on where the search is paused.
        if self.correct_shown() || self.refine_shown(token) {
            return true;
        }
        let dragging =
            self.wish.request.as_ref().is_some_and(|request| request.phase == Phase::Dragging);
        let mut did = false;
        for search in self.seats.iter_mut().filter_map(|seat| seat.search.as_mut()) {
            did |= !dragging && search.finish_one(false);
        }
        if self.wish.is_paused || token.is_cancelled() || self.seats.is_empty() {
            return did;
        }
        if self.seats.len() > 1 && !dragging && self.exchange() {
            return true;
        }
        // One character's round at a time, in turn, so that all of them get on.
        for _ in 0..self.seats.len() {
            self.turn = (self.turn + 1) % self.seats.len();
            let seat = &mut self.seats[self.turn];
            if seat.refusal.is_some() {
                continue;
            }
            if let Some(search) = seat.search.as_mut().filter(|search| !search.is_settled()) {
                search.round(token);
                return true;
            }
        }
        did || self.suggest(token)
    }

    /// Tries a change for the first character whose search has settled on what misses something.
    fn suggest(&mut self, token: &CancelToken) -> bool {
        let Some(request) = self.wish.request.clone() else { return false };
        let settled = self.seats.iter_mut().enumerate().filter(|(_, seat)| seat.refusal.is_none());
        for (nth, seat) in settled {
            let Some(search) = seat.search.as_mut() else { continue };
            let ground = Ground {
                document: &request.document,
                character: CharacterIdx(nth),
                library: &request.library.library,
                project_path: &request.path,
                bridges: request.document.search().bridges.unwrap_or(true),
            };
            if search.suggest_one(&ground, token) {
                return true;
            }
        }
        false
    }

    fn snapshot(&mut self) -> SearchSnapshot {
        let is_paused = self.wish.is_paused;
        let characters: Vec<CharacterSnapshot> =
            self.seats.iter_mut().map(|seat| seat.snapshot(is_paused)).collect();
        SearchSnapshot {
            request: self.wish.request.as_ref().map_or(0, |request| request.number),
            state: together(&characters),
            characters,
        }
    }
}

impl Seat {
    fn snapshot(&mut self, is_paused: bool) -> CharacterSnapshot {
        let mut snapshot = match &mut self.search {
            Some(search) => search.snapshot(),
            None => CharacterSnapshot { name: self.name.clone(), ..CharacterSnapshot::default() },
        };
        snapshot.remarks.extend(self.remarks.iter().cloned());
        match (&self.refusal, &snapshot.state) {
            (Some(refusal), _) => snapshot.state = SearchState::Infeasible(refusal.clone()),
            (None, SearchState::Searching) if is_paused => snapshot.state = SearchState::Paused,
            _ => {}
        }
        snapshot
    }
}

/// The start of all chance for the character `nth`.
fn seed_of(project: &Project, nth: usize) -> u64 {
    project.search.seed.wrapping_add(nth as u64)
}

/// The state to be said of all characters: what needs the user first.
fn together(characters: &[CharacterSnapshot]) -> SearchState {
    let urgency = |state: &SearchState| match state {
        SearchState::Error(_) => 0,
        SearchState::Infeasible(_) => 1,
        SearchState::Searching => 2,
        SearchState::Paused => 3,
        SearchState::Building { .. } => 4,
        SearchState::Settled => 5,
        SearchState::Ready => 6,
        SearchState::NoGraph => 7,
    };
    let states = characters.iter().map(|character| &character.state);
    states.min_by_key(|state| urgency(state)).cloned().unwrap_or(SearchState::Ready)
}
