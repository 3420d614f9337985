//! Lines that are held to what they miss.
//!
//! The score is a sum: a motion that is a little beside a checkpoint may score better than one within tolerance with
//! one more cut, and so a search can be full of good motions of which none is acceptable. While that is so, some
//! lines go on from the best motions with more weight on those wishes that they miss, more and more, as breakout
//! search does with clauses (Morris 1993). What they find is scored by what is really asked.

use std::sync::Arc;

use rand::RngExt;
use rayon::prelude::*;

use super::best::ScoreCounts;
use super::line::descend;
use super::rng::stream;
use super::route::Route;
use super::target::Target;
use super::{N_LINES, Search};
use crate::cancel::CancelToken;
use crate::score::{Judgement, Wishes, has_style};

/// Lines that are pressed side by side. Fixed, since it takes part in the outcome.
const N_PRESSED: u64 = 8;

/// Rounds that a search has for itself first.
const FREE_ROUNDS: u64 = 4;

/// What is missed counts so many times as much each time …
const PRESSURE: f32 = 3.0;

/// … and a line begins anew when it was pressed so often.
const MAX_TIMES: u32 = 4;

/// The best so many motions are gone on from.
const N_BEGUN_AT: usize = 8;

/// A line under pressure: its route is scored by its own wishes.
#[derive(Clone, Debug)]
pub(super) struct Pressed {
    wishes: Wishes,
    target: Arc<Target>,
    route: Route,
    n_times: u32,
}

/// What a round has brought.
#[derive(Debug, Default)]
pub(super) struct PressedRound {
    pub(super) lines: Vec<Option<Pressed>>,
    /// The best motion, by what is really asked, that is within every tolerance.
    pub(super) accepted: Option<Route>,
    pub(super) counts: ScoreCounts,
}

impl Search {
    /// A step of every line under pressure; none where the search does well by itself. `None` if cancelled.
    pub(super) fn press(&self, round: u64, cancel: &CancelToken) -> Option<PressedRound> {
        let kept = self.alternatives.kept();
        if round <= FREE_ROUNDS || kept.iter().any(|kept| self.is_kept_acceptable(kept)) {
            return Some(PressedRound::default());
        }
        let mut known: Vec<&Route> = kept.iter().map(|kept| &kept.route).collect();
        known.extend(self.lines.iter().filter_map(|line| line.route()));
        known.extend(self.best.iter().map(|(route, _)| route));
        known.sort_by(|a, b| a.score.total_cmp(&b.score));
        known.dedup_by(|a, b| a.path == b.path);
        known.truncate(N_BEGUN_AT);
        let numbers: Vec<u64> = (0..N_PRESSED).collect();
        let stepped: Vec<_> = numbers
            .into_par_iter()
            .with_max_len(1)
            .map(|number| (!cancel.is_cancelled()).then(|| self.press_line(number, round, &known)))
            .collect();
        let mut all = PressedRound::default();
        for stepped in stepped {
            let (line, accepted, counts) = stepped?;
            all.lines.push(line);
            all.counts.add(counts);
            let best = all.accepted.as_ref().map_or(f32::INFINITY, |best| best.score);
            all.accepted = accepted.filter(|route| route.score < best).or(all.accepted);
        }
        Some(all)
    }

    fn press_line(
        &self,
        number: u64,
        round: u64,
        known: &[&Route],
    ) -> (Option<Pressed>, Option<Route>, ScoreCounts) {
        let mut rng = stream(self.seed, round, N_LINES + 1 + number);
        let mut counts = ScoreCounts::default();
        let before = self.pressed.get(number as usize).cloned().flatten();
        let line = match before {
            None if known.is_empty() => None,
            None => {
                let n = known.len();
                let rank = rng.random_range(0..n).min(rng.random_range(0..n));
                self.press_on(known[rank], &self.problem.wishes, 1)
            }
            Some(line) => {
                let scope = (self.problem.allowed_clips.as_slice(), self.problem.bridges);
                let (library, target) = (&self.library, &line.target);
                // What is not soon better is pressed on: it need not be shown to be a minimum.
                let to_beat = 0.0;
                match descend(library, target, scope, &line.route, to_beat, &mut rng, &mut counts) {
                    Some(route) => Some(Pressed { route, ..line }),
                    None if line.n_times == MAX_TIMES => None,
                    None => self.press_on(&line.route, &line.wishes, line.n_times + 1),
                }
            }
        };
        let route = line
            .as_ref()
            .and_then(|line| Route::new(&self.library, &self.target, line.route.path.clone()));
        let accepted = route.filter(|route| self.is_acceptable(route));
        (line, accepted, counts)
    }

    /// A line at `route` with more weight on what it misses; `None` where it misses nothing.
    fn press_on(&self, route: &Route, wishes: &Wishes, n_times: u32) -> Option<Pressed> {
        let judged = self.judge(&route.path)?;
        let wishes = pressed(wishes, &judged)?;
        let target = Target::new(&self.library, &wishes);
        let route = Route::new(&self.library, &target, route.path.clone())?;
        Some(Pressed { wishes, target: Arc::new(target), route, n_times })
    }
}

/// The wishes with more weight on those that are missed; `None` where none is that has a weight.
fn pressed(wishes: &Wishes, judged: &Judgement) -> Option<Wishes> {
    let mut new = wishes.clone();
    let factor = |is_met: bool| if is_met { 1.0 } else { PRESSURE };
    if let Some(length) = &mut new.length {
        length.weight *= factor(judged.has_length(wishes));
    }
    for (wish, error) in new.body.iter_mut().zip(&judged.body) {
        wish.weight *= factor(error.is_within(&wish.tolerance));
    }
    for (wish, &error) in new.joints.iter_mut().zip(&judged.joints) {
        wish.weight *= factor(wish.is_within_tolerance(error));
    }
    for (wish, (_, error)) in new.poses.iter_mut().zip(&judged.poses) {
        wish.weight *= factor(error.is_within(&wish.tolerance));
    }
    for (wish, &lacking) in new.styles.iter_mut().zip(&judged.styles) {
        wish.weight *= factor(has_style(lacking));
    }
    for (wish, &error) in new.follows.iter_mut().zip(&judged.follows) {
        wish.weight *= factor(wish.is_within_tolerance(error));
    }
    new.weights.environment *= factor(judged.is_clear());
    (new != *wishes).then_some(new)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::cast::testing::{checkpoint, library, problem};

    /// A search with a checkpoint that counts so little that the score gives it up.
    fn given_up(seed: u64) -> Search {
        let aside = checkpoint(60, 0.5, 1.9, 10.0);
        let mut body = vec![checkpoint(0, 0.0, 0.0, 0.0), aside, checkpoint(119, 0.0, 3.7, 0.0)];
        body[1].weight = 0.05;
        body[1].tolerance.heading_rad = f32::INFINITY;
        Search::new(library(), problem(body), seed).expect("a problem")
    }

    fn rounds(search: &mut Search, n: usize) {
        for _ in 0..n {
            assert!(search.step(&CancelToken::new()), "not cancelled");
        }
    }

    #[test]
    fn what_the_score_gives_up_is_met_all_the_same_and_comes_first() {
        let (mut n_met, mut n_given_up) = (0, 0);
        for seed in 1..9 {
            let mut search = given_up(seed);
            rounds(&mut search, 60);
            // Eight clips of four seconds cannot do everything.
            if search.progress().first_acceptable.is_none() {
                continue;
            }
            n_met += 1;
            let is_acceptable = |path: &crate::path::Path| {
                let judged = search.judge(path).expect("long enough");
                judged.is_acceptable(&search.problem().wishes)
            };
            let found = search.alternatives();
            let best = search.best().expect("a motion");
            n_given_up += usize::from(!is_acceptable(&best.path));
            assert!(is_acceptable(&found[0].path), "seed {seed}");
            let well: Vec<bool> = found.iter().map(|found| is_acceptable(&found.path)).collect();
            assert!(well.is_sorted_by(|a, b| a >= b), "{well:?}");
            for group in found.chunk_by(|a, b| is_acceptable(&a.path) == is_acceptable(&b.path)) {
                assert!(group.is_sorted_by(|a, b| a.score <= b.score), "seed {seed}");
            }
        }
        assert!(n_met >= 4 && n_given_up >= 2, "{n_met} {n_given_up}");
    }

    #[test]
    fn only_what_is_missed_is_pressed() {
        let search = given_up(1);
        let wishes = &search.problem.wishes;
        let mut first = search.clone();
        rounds(&mut first, 1);
        let path = first.best().expect("a motion").path;
        let mut judged = search.judge(&path).expect("long enough");
        judged.n_frames = 120;
        for error in &mut judged.body {
            (error.position_m, error.heading_rad, error.frames) = (0.0, 0.0, 0);
        }
        assert!(pressed(wishes, &judged).is_none(), "nothing is missed");
        judged.body[1].position_m = 0.31;
        judged.n_frames = 150;
        let new = pressed(wishes, &judged).expect("something is missed");
        let factors: Vec<f32> =
            new.body.iter().zip(&wishes.body).map(|(new, old)| new.weight / old.weight).collect();
        assert_eq!(factors, [1.0, PRESSURE, 1.0]);
        assert_eq!(new.length.map(|length| length.weight), Some(PRESSURE));
        assert_eq!(new.weights, wishes.weights);
    }

    #[test]
    fn pressing_is_the_same_on_any_number_of_threads() {
        let run = |n_threads| {
            let pool = rayon::ThreadPoolBuilder::new().num_threads(n_threads).build();
            pool.expect("a pool").install(|| {
                let mut search = given_up(2);
                rounds(&mut search, 20);
                (search.progress(), search.alternatives())
            })
        };
        assert_eq!(run(3), run(1));
    }
}
