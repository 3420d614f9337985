//! How many different motions there are to choose from after a second.

use motion_bench::problems::ASKS;
use motion_bench::stopwatch::{Spent, timed};
use motion_core::search::DISTINCT_M;
use motion_core::skeleton::Skeleton;

use super::Bench;
use super::quantile::median;
use super::runs::{Made, add};
use crate::table::Row;

/// Counts finished motions that are apart from all better ones.
///
/// The search has its own rule for paths; this is the definition, read off the motions as they
/// would be written: mean distance of joints at equal times, at least [`DISTINCT_M`].
pub(crate) fn measure(bench: &mut Bench) -> anyhow::Result<Vec<Row>> {
    let library = bench.library()?;
    let runs = bench.runs()?;
    let skeleton = library.clips().skeleton();
    let mut spent = runs.searching;
    let mut by_problem = Vec::new();
    let mut counts = Vec::new();
    let mut n_known = 0;
    let mut counting = Spent::default();
    for ask in ASKS {
        let of = runs.runs.iter().filter(|run| run.ask.name == ask.name);
        let minima: Vec<f64> = of.clone().map(|run| run.progress.n_minima as f64).collect();
        n_known += of.clone().map(|run| run.progress.n_alternatives).sum::<usize>();
        let (n, once) = timed(|| -> Vec<f64> {
            of.map(|run| n_distinct(skeleton, &run.motions) as f64).collect()
        });
        add(&mut counting, once);
        by_problem.push(format!(
            "{} {}/{} of {}",
            &ask.name[..2],
            least(&n),
            median(&n),
            median(&minima)
        ));
        counts.extend(n);
    }
    add(&mut spent, counting);
    let n_least = least(&counts);
    Ok(vec![Row {
        figure: "distinct alternatives after 1 s, least".to_owned(),
        target: "5",
        measured: format!("{n_least} (median {})", median(&counts)),
        is_met: n_least >= 5.0,
        spent,
        notes: vec![
            format!(
                "by problem, least/median of so many minima reached: {}",
                by_problem.join(", ")
            ),
            format!(
                "counted among finished motions; the search itself said {:.1} on average",
                n_known as f64 / runs.runs.len() as f64
            ),
        ],
    }])
}

fn least(values: &[f64]) -> f64 {
    values.iter().copied().fold(f64::INFINITY, f64::min)
}

/// Motions, best first, that are apart from all that were counted before.
fn n_distinct(skeleton: &Skeleton, motions: &[Made]) -> usize {
    let mut counted: Vec<Vec<glam::Vec3>> = Vec::new();
    for made in motions {
        let joints = made.assembled.motion.joint_positions_m(skeleton);
        let apart = |other: &Vec<glam::Vec3>| {
            let n = joints.len().min(other.len());
            let sum: f64 = joints.iter().zip(other).map(|(a, b)| f64::from(a.distance(*b))).sum();
            sum / n as f64 >= f64::from(DISTINCT_M)
        };
        if counted.iter().all(apart) {
            counted.push(joints);
        }
    }
    counted.len()
}
