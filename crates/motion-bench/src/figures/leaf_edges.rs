//! The library's leaf edges against a double loop over all pairs of frames.

use std::cmp::Ordering;

use motion_bench::stopwatch::timed;
use motion_core::graph::MotionGraph;
use motion_core::ids::ClipId;
use rayon::prelude::*;

use super::Bench;
use super::plain_features::PlainFeatures;
use crate::table::Row;

/// Pairs within this of τ, in τ, may be in or out.
const BAND: f64 = 1e-5;

/// Costs agree to this, relative.
const COST_TOLERANCE: f64 = 1e-4;

/// A pair of rows, the first before the second, and its cost.
type Pair = (usize, usize, f64);

/// Compares every leaf edge of the library, bridges left out.
pub(crate) fn measure(bench: &mut Bench) -> anyhow::Result<Vec<Row>> {
    let library = bench.library()?;
    let (graph, clips) = (library.graph(), library.clips());
    let (features, _) = timed(|| PlainFeatures::new(clips, &graph.metric));
    let (expected, spent) = timed(|| double_loop(&features, graph));
    let (found, n_one_way) = pairs_of(graph, &features.frame_starts);
    let difference = Difference::new(&expected, &found, graph.tau);
    let Difference { n_missing, n_extra, n_in_band, worst } = difference;
    Ok(vec![Row {
        figure: "leaf edges against a double loop in f64".to_owned(),
        target: "same set, 1e-4",
        measured: format!("{} differ, {worst:.1e}", n_missing + n_extra + n_one_way),
        is_met: n_missing + n_extra + n_one_way == 0 && worst <= COST_TOLERANCE,
        spent,
        notes: vec![format!(
            "{} pairs of {} frames, each an edge both ways; {n_missing} missing, {n_extra} too many, \
             {n_one_way} one way only; {n_in_band} within 1e-5 τ of τ left out; normalisers differ \
             by {:.0e}",
            found.len(),
            features.n_rows(),
            features.normaliser_error
        )],
    }])
}

/// Every pair up to a little above τ, in order.
fn double_loop(features: &PlainFeatures, graph: &MotionGraph) -> Vec<Pair> {
    let clip_of = |row: usize| features.frame_starts.partition_point(|&start| start <= row);
    let min_jump = graph.min_jump as usize;
    let limit = graph.tau * (1.0 + 10.0 * COST_TOLERANCE);
    (0..features.n_rows())
        .into_par_iter()
        .flat_map_iter(|a| {
            let own_end = features.frame_starts[clip_of(a)];
            let near = move |b: &usize| *b >= own_end || b - a >= min_jump;
            (a + 1..features.n_rows())
                .filter(near)
                .filter_map(move |b| Some((a, b, features.cost_below(a, b, limit)?)))
        })
        .collect()
}

/// The graph's leaf edges as pairs, and how many have no partner in the other direction.
fn pairs_of(graph: &MotionGraph, frame_starts: &[usize]) -> (Vec<Pair>, usize) {
    let mut ways: [Vec<Pair>; 2] = [Vec::new(), Vec::new()];
    for pair in graph.forest.pairs() {
        let row = |clip: ClipId, frame: usize| frame_starts[clip.idx()] + frame;
        for edge in graph.leaf_edges(pair.from, pair.to) {
            let from = row(pair.from, edge.from_frame.idx());
            let to = row(pair.to, edge.to_frame.idx());
            let way = usize::from(from > to);
            ways[way].push((from.min(to), from.max(to), f64::from(edge.cost)));
        }
    }
    let [mut forward, mut back] = ways;
    for way in [&mut forward, &mut back] {
        way.sort_by_key(|pair| (pair.0, pair.1));
    }
    let n_one_way = both(&forward, &back).filter(|(a, b)| a.is_none() || b.is_none()).count();
    (forward, n_one_way)
}

/// What is different between two lists of pairs.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Difference {
    n_missing: usize,
    n_extra: usize,
    /// Pairs so near to τ that they may be in either list or both.
    n_in_band: usize,
    /// The largest relative difference of costs of pairs in both lists.
    worst: f64,
}

impl Difference {
    fn new(expected: &[Pair], found: &[Pair], tau: f64) -> Self {
        let mut new = Self { n_missing: 0, n_extra: 0, n_in_band: 0, worst: 0.0 };
        for (expected, found) in both(expected, found) {
            match (expected, found) {
                (Some(cost), _) if (cost - tau).abs() <= BAND * tau => new.n_in_band += 1,
                (Some(cost), Some(other)) if cost < tau => {
                    new.worst = new.worst.max((other - cost).abs() / cost.max(f64::MIN_POSITIVE));
                }
                (Some(cost), None) if cost < tau => new.n_missing += 1,
                (_, Some(_)) => new.n_extra += 1,
                _ => {}
            }
        }
        new
    }
}

/// Walks two ordered lists side by side: the cost of each pair in the one and in the other.
fn both<'a>(
    left: &'a [Pair],
    right: &'a [Pair],
) -> impl Iterator<Item = (Option<f64>, Option<f64>)> + 'a {
    let (mut i, mut j) = (0, 0);
    std::iter::from_fn(move || {
        let order = match (left.get(i), right.get(j)) {
            (None, None) => return None,
            (Some(_), None) => Ordering::Less,
            (None, Some(_)) => Ordering::Greater,
            (Some(a), Some(b)) => (a.0, a.1).cmp(&(b.0, b.1)),
        };
        let from_left = order.is_le().then(|| left[i].2);
        let from_right = order.is_ge().then(|| right[j].2);
        i += usize::from(order.is_le());
        j += usize::from(order.is_ge());
        Some((from_left, from_right))
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_kind_of_difference_is_counted() {
        let expected =
            [(0, 1, 0.5), (0, 2, 0.999_999), (1, 2, 0.2), (3, 9, 1.0005), (4, 5, 1.0002)];
        let found = [(0, 1, 0.500_05), (3, 9, 0.9), (7, 8, 0.1)];
        let difference = Difference::new(&expected, &found, 1.0);
        let Difference { n_missing, n_extra, n_in_band, worst } = difference;
        assert_eq!((n_missing, n_extra, n_in_band), (1, 2, 1), "{difference:?}");
        assert!((worst - 1e-4).abs() < 1e-9, "{worst}");
    }
}
