//! Motions that belong together.

use std::collections::HashSet;

use super::CastProblem;
use super::stage::{Combination, Stage};
use super::world::World;
use crate::path::Path;
use crate::planar::PlanarTransform;
use crate::score::{Judgement, judge};
use crate::search::Problem;

/// Motions of each character that are put together.
const N_PUT_TOGETHER: usize = 24;

/// A motion for every character, which belong together.
#[derive(Clone, Debug, PartialEq)]
pub struct CastSolution {
    /// How each character's motion is cut together.
    pub paths: Vec<Path>,
    /// What each motion is judged by, and corrected onto: the character's own problem, with the
    /// poses of its interactions at their places after its own poses, and with the others on their
    /// ways.
    pub problems: Vec<Problem>,
    /// How well each does that before correction.
    pub judgements: Vec<Judgement>,
    /// `world_from_interaction` of each interaction: the place that suits these motions best.
    pub places: Vec<PlanarTransform>,
    /// What each motion scores by itself, what is left to the places of interactions, and what
    /// nearness costs once the motions are corrected; lower is better.
    pub score: f32,
    /// The round that found each motion, counted from 1.
    pub iterations: Vec<u64>,
}

/// The best combinations in `world`, best first; in each, at least one motion is in none before it.
///
/// Characters who have nothing to do with each other have their k-th motions in the k-th
/// solution.
pub(super) fn solutions(world: &World, problem: &CastProblem, n_max: usize) -> Vec<CastSolution> {
    let stage = world.stage(problem, N_PUT_TOGETHER);
    let by_group: Vec<Vec<Combination>> = stage
        .groups()
        .iter()
        .map(|group| with_something_new(stage.combinations(group), n_max))
        .collect();
    if by_group.iter().any(Vec::is_empty) {
        return Vec::new();
    }
    let n = by_group.iter().map(Vec::len).max().unwrap_or(0);
    let whole = (0..n).map(|rank| {
        let mut choices = vec![None; stage.laid.len()];
        for combinations in &by_group {
            let known = combinations.get(rank).or_else(|| combinations.first());
            for (choice, of_group) in
                choices.iter_mut().zip(known.into_iter().flat_map(|c| &c.choices))
            {
                *choice = choice.or(*of_group);
            }
        }
        stage.arrange(&choices)
    });
    let mut solutions: Vec<CastSolution> =
        whole.filter_map(|combination| solution(world, problem, &stage, &combination)).collect();
    if by_group.len() != stage.laid.len() || !problem.interactions.is_empty() {
        solutions.sort_by(|a, b| a.score.total_cmp(&b.score));
    }
    solutions
}

fn with_something_new(combinations: Vec<Combination>, n_max: usize) -> Vec<Combination> {
    let mut seen: HashSet<(usize, usize)> = HashSet::new();
    let mut kept = Vec::new();
    for combination in combinations {
        if kept.len() == n_max {
            break;
        }
        let motions = combination.choices.iter().enumerate();
        let motions: Vec<(usize, usize)> =
            motions.filter_map(|(c, choice)| Some((c, (*choice)?))).collect();
        let is_new = motions.iter().any(|motion| !seen.contains(motion));
        if is_new {
            seen.extend(motions);
            kept.push(combination);
        }
    }
    kept
}

fn solution(
    world: &World,
    problem: &CastProblem,
    stage: &Stage<'_>,
    combination: &Combination,
) -> Option<CastSolution> {
    let n = world.searches.len();
    let (mut paths, mut problems, mut judgements, mut iterations) = (
        Vec::with_capacity(n),
        Vec::with_capacity(n),
        Vec::with_capacity(n),
        Vec::with_capacity(n),
    );
    for (character, search) in world.searches.iter().enumerate() {
        let laid = &stage.laid[character][combination.choices[character]?];
        let others = stage.others_of(combination, character);
        let asked = problem.of_character(character, Some(&combination.places), others);
        let library = search.library();
        judgements.push(judge(library.graph(), library.clips(), &asked.wishes, &laid.path)?);
        paths.push(laid.path.clone());
        problems.push(asked);
        iterations.push(laid.found_in);
    }
    let Combination { score, ref places, .. } = *combination;
    let places = places.clone();
    Some(CastSolution { paths, problems, judgements, places, score, iterations })
}
