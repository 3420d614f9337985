//! A change tried: what is asked then, searched for a little from what is known.

use std::collections::BTreeSet;
use std::path::Path;
use std::time::Duration;

use motion_core::cancel::CancelToken;
use motion_core::score::Judgement;
use motion_core::search::Search;

use super::candidate::Candidate;
use crate::Library;
use crate::budget::with_deadline;
use crate::command::apply_all;
use crate::document::{CharacterIdx, Document};
use crate::problem::{CharacterProblem, problem_of};
use crate::unmet::missed::{Missed, missed};

/// How long a change is tried.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Effort {
    /// So many rounds: the same every time.
    Rounds(u64),
    /// So long.
    Time(Duration),
}

/// What changes are made to, and what they are tried on.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Ground<'a> {
    pub(crate) document: &'a Document,
    pub(crate) character: CharacterIdx,
    pub(crate) library: &'a Library,
    pub(crate) project_path: &'a Path,
    /// Whether bridges may be used.
    pub(crate) bridges: bool,
}

/// What a change has brought.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Outcome {
    pub(super) score: f32,
    /// What is missed even so, by kind and id.
    pub(super) missed: BTreeSet<String>,
}

/// Tries a change from what `search` knows. `None` where it cannot be asked or no motion is found, or
/// `cancel` was raised.
pub(super) fn outcome(
    ground: &Ground<'_>,
    candidate: &Candidate,
    search: &Search,
    effort: Effort,
    cancel: &CancelToken,
) -> Option<Outcome> {
    let document = apply_all(ground.document, &candidate.commands).ok()?;
    let project = document.to_project();
    let character = project.characters.get(ground.character.0)?;
    let asked =
        problem_of(&project, character, ground.library, ground.bridges, ground.project_path)
            .ok()?;
    let mut trial = search.rescored(asked.problem.clone(), &[]).ok()?;
    let limit = match effort {
        Effort::Time(limit) => Some(limit),
        Effort::Rounds(_) => None,
    };
    let mut n_rounds = 0;
    with_deadline(cancel, limit, |token| {
        let is_over = |n| matches!(effort, Effort::Rounds(most) if n >= most);
        while !is_over(n_rounds) && trial.step(token) {
            n_rounds += 1;
        }
    });
    if cancel.is_cancelled() {
        return None;
    }
    // What was the best before may meet it as it is.
    let found = trial.alternatives().into_iter().chain(search.best());
    let outcomes = found.filter_map(|solution| {
        let judgement = trial.judge(&solution.path)?;
        let score = judgement.terms.total();
        Some(Outcome { score, missed: named(&asked, &judgement) })
    });
    let outcomes = outcomes.filter(|outcome| outcome.score.is_finite());
    // The best, since that is what would be looked at; where it is not enough, what misses least is no
    // promise.
    outcomes.min_by(|a, b| a.score.total_cmp(&b.score))
}

/// What a motion misses, by kind and id: numbers change with what is asked, names do not.
pub(super) fn named(asked: &CharacterProblem, judgement: &Judgement) -> BTreeSet<String> {
    let ids = &asked.ids;
    let all = missed(&asked.problem.wishes, judgement);
    let name = |missed: &Missed| {
        let of = |kind: &str, ids: &[String], nth: usize| {
            format!("{kind} {:?}", ids.get(nth).map_or("", String::as_str))
        };
        match *missed {
            Missed::Body(nth) => of("body constraint", &ids.body, nth),
            Missed::Joint(nth) => of("joint constraint", &ids.joints, nth),
            Missed::Pose(nth) => of("pose", &ids.poses, nth),
            Missed::Lock(nth) => of("locked stretch", &ids.locks, nth),
            Missed::Style(nth) => of("style", &ids.styles, nth),
            Missed::Follow(nth) => of("path", &ids.follows, nth),
            Missed::Obstacles => "an obstacle".to_owned(),
            Missed::Others => "another character".to_owned(),
            Missed::Length => "the length".to_owned(),
        }
    };
    all.iter().map(name).collect()
}
