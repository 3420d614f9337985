//! Changes tried one by one, the smallest first, until there are enough that help.

use std::collections::{BTreeSet, VecDeque};

use motion_core::cancel::CancelToken;
use motion_core::search::Search;

use super::candidate::Candidate;
use super::trial::{Effort, Ground, Outcome, named, outcome};
use super::{Case, Change, N_SAID, Suggestion};
use super::{length, palette, place, pose, style, time, tolerance};
use crate::command::apply_all;

/// So many changes are tried at most.
const MAX_TRIED: usize = 14;

/// Changes that are being tried.
#[derive(Clone, Debug, Default)]
pub(crate) struct Suggester {
    /// The smallest first.
    waiting: VecDeque<Candidate>,
    score_before: f32,
    missed_before: BTreeSet<String>,
    /// In the order of their sizes.
    helpful: Vec<(Candidate, Outcome)>,
}

impl Suggester {
    /// The changes that may help in a case.
    pub(crate) fn new(case: &Case<'_>) -> Self {
        let kinds = [
            length::candidates,
            place::candidates,
            time::candidates,
            tolerance::candidates,
            pose::candidates,
            style::candidates,
            palette::candidates,
        ];
        let mut all: Vec<Candidate> = kinds.iter().flat_map(|of_kind| of_kind(case)).collect();
        all.retain(|candidate| {
            !candidate.commands.is_empty() && apply_all(case.document, &candidate.commands).is_ok()
        });
        // Stable, so that equal sizes stay in the order of the kinds.
        all.sort_by(|a, b| a.size.total_cmp(&b.size));
        all.dedup_by(|a, b| a.commands == b.commands);
        let mut waiting: VecDeque<Candidate> = all.into();
        waiting.truncate(MAX_TRIED);
        Self {
            waiting,
            score_before: case.judgement.terms.total(),
            missed_before: named(case.asked, case.judgement),
            helpful: Vec::new(),
        }
    }

    /// How many changes wait to be tried.
    pub(crate) fn n_waiting(&self) -> usize {
        self.waiting.len()
    }

    /// Tries the next change. Where `cancel` is raised meanwhile, it waits on.
    pub(crate) fn try_next(
        &mut self,
        ground: &Ground<'_>,
        search: &Search,
        effort: Effort,
        cancel: &CancelToken,
    ) {
        let Some(candidate) = self.waiting.pop_front() else { return };
        let tried = outcome(ground, &candidate, search, effort, cancel);
        if cancel.is_cancelled() {
            self.waiting.push_front(candidate);
            return;
        }
        let misses_less = |outcome: &Outcome| {
            outcome.missed.len() < self.missed_before.len()
                && outcome.missed.is_subset(&self.missed_before)
        };
        if let Some(outcome) = tried.filter(misses_less) {
            if outcome.missed.is_empty() {
                let key = key_of(&candidate);
                self.waiting.retain(|waiting| key_of(waiting) != key);
            }
            self.helpful.push((candidate, outcome));
            if self.said().len() >= N_SAID && self.said().iter().all(|(_, o)| o.missed.is_empty()) {
                // What waits is larger.
                self.waiting.clear();
            }
        }
    }

    /// Those that help, the smallest first: what meets everything, or else what meets more.
    pub(crate) fn suggestions(&self) -> Vec<Suggestion> {
        let suggestion = |(candidate, outcome): &&(Candidate, Outcome)| {
            let (before, after) = (self.score_before, outcome.score);
            let mut sentence = format!("{}: score {}", candidate.words, percent(before, after));
            if !outcome.missed.is_empty() {
                let still: Vec<&str> = outcome.missed.iter().map(String::as_str).collect();
                sentence.push_str(&format!("; {} is still missed", still.join(" and ")));
            }
            Suggestion {
                change: candidate.change,
                sentence,
                score_before: before,
                score_after: after,
                commands: candidate.commands.clone(),
            }
        };
        self.said().iter().map(suggestion).collect()
    }

    fn said(&self) -> Vec<&(Candidate, Outcome)> {
        let is_enough = |(_, outcome): &&(Candidate, Outcome)| outcome.missed.is_empty();
        let any_is_enough = self.helpful.iter().any(|helpful| is_enough(&helpful));
        let mut seen = BTreeSet::new();
        let best = self.helpful.iter().filter(|helpful| !any_is_enough || is_enough(helpful));
        best.filter(|(candidate, _)| seen.insert(key_of(candidate))).take(N_SAID).collect()
    }
}

/// Of several changes that are alike in this the smallest is enough.
fn key_of(candidate: &Candidate) -> (Change, String) {
    (candidate.change, candidate.about.clone())
}

/// `−61 %`.
fn percent(before: f32, after: f32) -> String {
    let percent = if before > 0.0 { 100.0 * (after / before - 1.0) } else { 0.0 };
    match percent.round() as i64 {
        fewer if fewer < 0 => format!("−{} %", fewer.unsigned_abs()),
        0 => "unchanged".to_owned(),
        more => format!("+{more} %"),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn scores_are_said_in_percent() {
        for (before, after, expected) in
            [(10.0, 3.9, "−61 %"), (10.0, 12.0, "+20 %"), (10.0, 10.01, "unchanged")]
        {
            assert_eq!(percent(before, after), expected);
        }
    }
}
