//! Motions of all characters put together: where interactions are then, and what it costs.

use glam::Vec2;

use super::fit::{Fit, Sight};
use super::laid::Laid;
use super::nearness::nearness_cost;
use super::problem::CastProblem;
use super::track::corrected_track_m;
use crate::constraint::OtherBody;
use crate::planar::PlanarTransform;

/// Combinations that are gone on with while characters are added one by one.
const BEAM: usize = 64;

/// Every character's known motions, to be put together.
#[derive(Debug)]
pub(super) struct Stage<'a> {
    problem: &'a CastProblem,
    /// For each character its motions, best first.
    pub(super) laid: Vec<Vec<Laid>>,
    /// Where interactions are if nobody has a place of its own.
    places: &'a [PlanarTransform],
    frame_secs: f32,
    in_time: Vec<usize>,
    /// For each pair whether one has to do with the other.
    is_coupled: Vec<Vec<bool>>,
}

/// A motion of every character that takes part.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Combination {
    /// Which of its motions each character shows; `None` where it takes no part.
    pub(super) choices: Vec<Option<usize>>,
    /// The place of each interaction that suits these motions best.
    pub(super) places: Vec<PlanarTransform>,
    /// How each motion, as it is laid, is moved in the world.
    pub(super) moved: Vec<PlanarTransform>,
    /// The sum of all scores.
    pub(super) score: f32,
}

impl<'a> Stage<'a> {
    pub(super) fn new(
        problem: &'a CastProblem,
        laid: Vec<Vec<Laid>>,
        places: &'a [PlanarTransform],
        frame_secs: f32,
    ) -> Self {
        let n = laid.len();
        let in_time = problem.in_time();
        let is_coupled = vec![vec![false; n]; n];
        let mut stage = Self { problem, laid, places, frame_secs, in_time, is_coupled };
        let tracks: Vec<Vec<Vec<Vec2>>> = (0..n)
            .map(|c| (0..stage.laid[c].len()).map(|nth| stage.track_alone_m(c, nth)).collect())
            .collect();
        for (a, b) in (0..n).flat_map(|a| (0..a).map(move |b| (a, b))) {
            let interact = problem.interactions.iter();
            let coupled = interact.clone().any(|i| i.member(a).is_some() && i.member(b).is_some())
                || tracks[b].iter().any(|track| {
                    let other = problem.other_body((a, b), track.clone(), frame_secs);
                    tracks[a].iter().any(|track| nearness_cost(track, &other, frame_secs) > 0.0)
                });
            stage.is_coupled[a][b] = coupled;
            stage.is_coupled[b][a] = coupled;
        }
        stage
    }

    /// Characters in groups: whoever has to do with another, directly or not, is in one with it.
    pub(super) fn groups(&self) -> Vec<Vec<usize>> {
        let n = self.laid.len();
        let mut groups: Vec<Vec<usize>> = Vec::new();
        let mut is_taken = vec![false; n];
        for first in 0..n {
            if std::mem::replace(&mut is_taken[first], true) {
                continue;
            }
            let mut group = vec![first];
            let mut at = 0;
            while at < group.len() {
                let coupled = self.is_coupled[group[at]].iter().zip(&mut is_taken);
                for (other, (_, is_taken)) in
                    coupled.enumerate().filter(|(_, (coupled, is_taken))| **coupled && !**is_taken)
                {
                    *is_taken = true;
                    group.push(other);
                }
                at += 1;
            }
            group.sort_unstable();
            groups.push(group);
        }
        groups
    }

    /// Puts these motions together.
    pub(super) fn arrange(&self, choices: &[Option<usize>]) -> Combination {
        let laid = |c: usize| choices[c].map(|nth| &self.laid[c][nth]);
        let mut moved: Vec<Option<PlanarTransform>> = (0..choices.len())
            .map(|c| laid(c)?.is_placed.then_some(PlanarTransform::IDENTITY))
            .collect();
        let mut places = self.places.to_vec();
        let mut score: f32 = (0..choices.len()).filter_map(laid).map(|laid| laid.score).sum();
        for &nth in &self.in_time {
            let interaction = &self.problem.interactions[nth];
            let frame = interaction.frame as usize;
            let mut sights = Vec::with_capacity(interaction.members.len());
            for member in &interaction.members {
                let c = member.character;
                if let (Some(moved), Some(laid)) = (moved[c], laid(c)) {
                    let body = self.problem.characters[c].wishes.weights.body;
                    sights.push(Sight::new(
                        member.interaction_from_torso,
                        moved * laid.torsos[frame],
                        body * interaction.weight,
                        &interaction.tolerance,
                    ));
                }
            }
            if let Some(fit) = Fit::new(&sights) {
                let (place, cost) = fit.best();
                places[nth] = place;
                score += cost as f32;
            }
            // Who is nowhere yet is where the interaction is.
            for member in &interaction.members {
                let c = member.character;
                if let (None, Some(laid)) = (moved[c], laid(c)) {
                    let place = places[nth] * member.interaction_from_torso;
                    moved[c] = Some(place * laid.torsos[frame].inverse());
                }
            }
        }
        let moved = moved.into_iter().map(Option::unwrap_or_default).collect();
        let mut combination = Combination { choices: choices.to_vec(), places, moved, score };
        combination.score += self.nearness_cost(&combination);
        combination
    }

    /// The best combinations of motions of these characters, best first.
    pub(super) fn combinations(&self, characters: &[usize]) -> Vec<Combination> {
        let nobody = vec![None; self.laid.len()];
        let mut beam = vec![nobody];
        let mut combinations = Vec::new();
        for &c in characters {
            combinations = beam
                .iter()
                .flat_map(|choices| {
                    (0..self.laid[c].len()).map(move |nth| {
                        let mut choices = choices.clone();
                        choices[c] = Some(nth);
                        choices
                    })
                })
                .map(|choices| self.arrange(&choices))
                .collect();
            // Alone with nobody to meet, a character's motions are in their order already.
            if characters.len() > 1 || self.interacts(c) {
                combinations.sort_by(|a, b| a.score.total_cmp(&b.score));
            }
            combinations.truncate(BEAM);
            beam = combinations.iter().map(|c| c.choices.clone()).collect();
        }
        combinations
    }

    /// Where the character goes in `combination` once corrected.
    pub(super) fn track_m(&self, combination: &Combination, character: usize) -> Option<Vec<Vec2>> {
        let laid = &self.laid[character][combination.choices[character]?];
        let moved = combination.moved[character];
        let torsos: Vec<PlanarTransform> = laid.torsos.iter().map(|&t| moved * t).collect();
        let places = Some(combination.places.as_slice());
        let problem = self.problem.of_character(character, places, Vec::new());
        Some(corrected_track_m(&torsos, &problem.wishes))
    }

    /// The other bodies that `character` has to keep clear of in `combination`.
    pub(super) fn others_of(&self, combination: &Combination, character: usize) -> Vec<OtherBody> {
        let coupled = (0..self.laid.len()).filter(|&c| self.is_coupled[character][c]);
        coupled
            .filter_map(|other| {
                let track_m = self.track_m(combination, other)?;
                Some(self.problem.other_body((character, other), track_m, self.frame_secs))
            })
            .collect()
    }

    fn interacts(&self, character: usize) -> bool {
        self.problem.interactions.iter().any(|i| i.member(character).is_some())
    }

    fn track_alone_m(&self, character: usize, nth: usize) -> Vec<Vec2> {
        let mut choices = vec![None; self.laid.len()];
        choices[character] = Some(nth);
        self.track_m(&self.arrange(&choices), character).unwrap_or_default()
    }

    fn nearness_cost(&self, combination: &Combination) -> f32 {
        let n = self.laid.len();
        let pairs = (0..n).flat_map(|a| (0..a).map(move |b| (a, b)));
        let pairs: Vec<(usize, usize)> = pairs
            .filter(|&(a, b)| {
                let both = combination.choices[a].is_some() && combination.choices[b].is_some();
                both && self.is_coupled[a][b]
            })
            .collect();
        if pairs.is_empty() {
            return 0.0;
        }
        let tracks: Vec<Option<Vec<Vec2>>> = (0..n).map(|c| self.track_m(combination, c)).collect();
        let cost = |c: usize, other: usize| {
            let (Some(track), Some(others)) = (&tracks[c], &tracks[other]) else { return 0.0 };
            let other = self.problem.other_body((c, other), others.clone(), self.frame_secs);
            let weight = self.problem.characters[c].wishes.weights.environment;
            weight * nearness_cost(track, &other, self.frame_secs)
        };
        pairs.iter().map(|&(a, b)| cost(a, b) + cost(b, a)).sum()
    }
}
