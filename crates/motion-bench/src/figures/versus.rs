//! Ours against the paper's search and against A*: the same problems, seeds, score and time.

use std::time::Duration;

use motion_bench::stopwatch::Spent;
use motion_core::search::SearchKind;

use super::Bench;
use super::quantile::median;
use super::runs::add;
use super::trials::{Clock, Trial, Until, follow};
use crate::table::Row;

/// When scores are compared, seconds.
const AT_S: [f64; 3] = [0.1, 0.5, 2.0];

/// Scores nearer than this are equal.
const EQUAL: f64 = 0.005;

/// A speed is at most said to be so many times another.
const MAX_RATIO: f64 = 1000.0;

/// How a rival did against ours on a problem.
struct Duel {
    /// Whether the rival's median score was better at some time.
    is_worse: bool,
    /// How many times sooner ours reached what the rival had at the end; medians.
    faster: f64,
}

/// Median scores at several times, and how much sooner ours had what the rivals had at the end.
pub(crate) fn measure(bench: &mut Bench) -> anyhow::Result<Vec<Row>> {
    let (library, all) = (bench.library()?, bench.asked()?);
    let mut spent = Spent::default();
    let mut notes = vec![format!(
        "median scores after {} s of the processor's time for gaitway | af02 | astar; how many times \
         sooner ours had what the other had at the end",
        AT_S.map(|s| s.to_string()).join(", ")
    )];
    let mut duels: [Vec<Duel>; 2] = [Vec::new(), Vec::new()];
    for asked in all.iter() {
        let mut by_kind: Vec<Vec<Trial>> = Vec::new();
        for kind in SearchKind::ALL {
            let mut trials = Vec::new();
            for seed in 1..=bench.effort.n_duels {
                let until = Until::BothTimes(Duration::from_secs_f64(AT_S[AT_S.len() - 1]));
                let trial = follow(&library, &asked.problem, (seed, kind), until)?;
                add(&mut spent, trial.spent);
                trials.push(trial);
            }
            by_kind.push(trials);
        }
        let scores: Vec<[f64; 3]> =
            by_kind.iter().map(|trials| AT_S.map(|s| at(trials, s))).collect();
        for (nth, duels) in duels.iter_mut().enumerate() {
            duels.push(duel(&by_kind[0], &by_kind[nth + 1]));
        }
        let text = scores.iter().map(|scores| scores.map(|score| format!("{score:.2}")).join(" "));
        let faster = duels.each_ref().map(|duels| duels.last().map_or(0.0, |duel| duel.faster));
        let line = format!(
            "{:<3} {}; {:.1}×, {:.1}×",
            asked.name,
            text.collect::<Vec<_>>().join(" | "),
            faster[0],
            faster[1]
        );
        eprintln!("{line}");
        notes.push(line);
    }
    let row = |nth: usize, notes| {
        let rival = SearchKind::ALL[nth + 1].name();
        let n_worse = duels[nth].iter().filter(|duel| duel.is_worse).count();
        let faster: Vec<f64> = duels[nth].iter().map(|duel| duel.faster).collect();
        let least = faster.iter().copied().fold(f64::INFINITY, f64::min);
        Row {
            figure: format!("against {rival}: worse in the median, times sooner"),
            target: if nth == 0 { "never, 3×" } else { "never" },
            measured: format!(
                "{n_worse} of {}, median {:.1}× (least {least:.1}×)",
                faster.len(),
                median(&faster)
            ),
            is_met: n_worse == 0 && (nth > 0 || median(&faster) >= 3.0),
            spent,
            notes,
        }
    };
    Ok(vec![row(0, notes), row(1, Vec::new())])
}

/// The median score after so many seconds of the processor's time.
fn at(trials: &[Trial], secs: f64) -> f64 {
    let scores: Vec<f64> =
        trials.iter().map(|trial| trial.score_at(Clock::Processor, secs)).collect();
    median(&scores)
}

fn duel(ours: &[Trial], rivals: &[Trial]) -> Duel {
    let is_worse = AT_S.iter().any(|&s| at(ours, s) > at(rivals, s) + EQUAL);
    let final_score = at(rivals, AT_S[AT_S.len() - 1]);
    let when = |trials: &[Trial]| {
        let reached: Vec<f64> =
            trials.iter().map(|trial| trial.reached_s(Clock::Processor, final_score)).collect();
        median(&reached)
    };
    let (own, other) = (when(ours), when(rivals));
    // A rival without any motion is beaten by any.
    let faster =
        if final_score.is_infinite() || other.is_infinite() { MAX_RATIO } else { other / own };
    Duel { is_worse, faster: faster.min(MAX_RATIO) }
}
