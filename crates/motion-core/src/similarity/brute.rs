//! The slow and obvious twin of [`distance_grid`](super::distance_grid): double loops in f64.

use super::directed::DirectedEdges;
use super::distance_grid::{self, BLOCK, PairQuery, nearest, pairs_below};
use super::families::Families;
use super::features::{FeatureSet, Metric};
use super::kept_edges::{KeptQuery, kept_edges};
use super::shard::Shard;
use crate::cancel::CancelToken;
use crate::ids::ClipId;
use rand::{RngExt, SeedableRng};

/// Clips of random walks in `n_dims` dimensions, so that there are near and far pairs.
pub(super) fn random_walks(clip_lengths: &[usize], n_dims: usize, seed: u64) -> FeatureSet {
    let mut rng = rand_pcg::Pcg64Mcg::seed_from_u64(seed);
    let mut frame_starts = vec![0];
    let mut rows = Vec::new();
    for &length in clip_lengths {
        let mut at: Vec<f32> = (0..n_dims).map(|_| rng.random_range(-1.0..1.0)).collect();
        for _ in 0..length {
            for x in &mut at {
                *x = *x * 0.98 + rng.random_range(-0.15f32..0.15);
            }
            rows.extend_from_slice(&at);
        }
        frame_starts.push(frame_starts[frame_starts.len() - 1] + length);
    }
    let metric = Metric { columns: vec![], change: vec![], derivative_change: vec![] };
    let clip_frames: Vec<u32> = clip_lengths.iter().map(|&length| length as u32).collect();
    let families = Families::none(&clip_frames);
    FeatureSet { metric, n_dims, frame_starts, rows, families }
}

fn cost_f64(features: &FeatureSet, a: usize, b: usize) -> f64 {
    let pairs = features.row(a).iter().zip(features.row(b));
    pairs.map(|(&x, &y)| (f64::from(x) - f64::from(y)).powi(2)).sum()
}

#[test]
fn pairs_below_are_those_of_a_double_loop() {
    let features = random_walks(&[BLOCK - 7, 40, 300, 1, 90], 18, 1);
    let (tau, min_jump) = (0.8, 9);
    let query = PairQuery::all(tau, min_jump as u32);
    let found =
        pairs_below(&features, &query, &CancelToken::new(), &|_| ()).expect("not cancelled");
    let mut expected = Vec::new();
    for a in 0..features.n_rows() {
        for b in a + 1..features.n_rows() {
            let same = features.clip_of_row(a).0 == features.clip_of_row(b).0;
            if (!same || b - a >= min_jump) && cost_f64(&features, a, b) < tau {
                expected.push((a as u32, b as u32));
            }
        }
    }
    assert!(expected.len() > 500, "the data must have near pairs: {}", expected.len());
    let labels: Vec<(u32, u32)> = found.pairs.iter().map(|p| (p.a, p.b)).collect();
    assert_eq!(labels, expected, "the same set in the same order");
    for pair in &found.pairs {
        let exact = cost_f64(&features, pair.a as usize, pair.b as usize);
        assert!((f64::from(pair.cost) - exact).abs() <= 1e-6 * exact, "{pair:?} is not {exact}");
    }
}

#[test]
fn nearest_is_that_of_a_double_loop() {
    let features = random_walks(&[BLOCK + 30, 200, 77], 18, 2);
    let found = nearest(&features, 9, &CancelToken::new(), &|_| ()).expect("not cancelled");
    for row in 0..features.n_rows() {
        let clip = features.clip_of_row(row).0;
        let others = (0..features.n_rows()).filter(|&b| features.clip_of_row(b).0 != clip);
        let least = others.map(|b| cost_f64(&features, row, b)).fold(f64::INFINITY, f64::min);
        let error = (found.other_family[row] - least).abs();
        assert!(
            error <= 1e-4 * least + 1e-5,
            "row {row}: {} is not {least}",
            found.other_family[row]
        );
    }
}

#[test]
fn a_full_budget_lowers_tau_and_keeps_the_cheapest() {
    let features = random_walks(&[BLOCK, 200, 77], 6, 3);
    let query = PairQuery::all(0.8, 9);
    let all = pairs_below(&features, &query, &CancelToken::new(), &|_| ()).expect("not cancelled");
    let budget = all.pairs.len() / 3;
    let query = PairQuery { max_pairs: budget, ..query };
    let some = pairs_below(&features, &query, &CancelToken::new(), &|_| ()).expect("not cancelled");
    assert!(some.tau < all.tau && some.pairs.len() <= budget, "{} of {budget}", some.pairs.len());
    let expected: Vec<_> = all.pairs.into_iter().filter(|p| f64::from(p.cost) < some.tau).collect();
    assert_eq!(some.pairs, expected, "exactly those under the lowered threshold");
}

#[test]
fn a_cancelled_search_for_pairs_says_so() {
    let cancel = CancelToken::new();
    cancel.cancel();
    let features = random_walks(&[50, 50], 6, 4);
    assert!(nearest(&features, 9, &cancel, &|_| ()).is_err(), "nearest");
    let query = PairQuery::all(1.0, 9);
    assert!(pairs_below(&features, &query, &cancel, &|_| ()).is_err(), "pairs_below");
}

/// Random walks of which some are copies of one take, one of them in the mirror.
fn copies(seed: u64) -> FeatureSet {
    let lengths = [120, 150, 90, 120, 1, 80];
    let mut features = random_walks(&lengths, 6, seed);
    let ids = ["a", "a~slow", "b", "a@mirror", "c", "b~1"];
    features.families = Families::of_ids(ids, &lengths.map(|n| n as u32));
    features
}

/// What [`kept_edges`] promises, by looking at everything.
fn kept_slowly(
    features: &FeatureSet,
    tau: f64,
    min_jump: u32,
    n_kept: usize,
) -> Vec<Vec<(u32, f32)>> {
    let n_rows = features.n_rows();
    let place = |row: usize| {
        let (clip, frame) = features.clip_of_row(row);
        (clip, frame as u32)
    };
    let is_cut =
        |a: usize, b: usize| !features.families.is_same_moment(place(a), place(b), min_jump);
    let beside = |row: usize| {
        let (clip, _) = features.clip_of_row(row);
        let (start, end) =
            (features.frame_starts[clip.idx()], features.frame_starts[clip.idx() + 1]);
        row.saturating_sub(1).max(start)..(row + 2).min(end)
    };
    let of_row = |a: usize| {
        let mut edges: Vec<(bool, f32, u32)> = (0..n_rows)
            .filter(|&b| is_cut(a, b) && features.cost(a, b) < tau)
            .map(|b| {
                let cost = features.cost(a, b);
                let mut around = beside(a).flat_map(|x| beside(b).map(move |y| (x, y)));
                let is_other = around.any(|(x, y)| is_cut(x, y) && features.cost(x, y) < cost);
                (is_other, cost as f32, b as u32)
            })
            .collect();
        edges.sort_by(|x, y| (x.0.cmp(&y.0)).then(x.1.total_cmp(&y.1)).then(x.2.cmp(&y.2)));
        edges.truncate(n_kept);
        let mut kept: Vec<(u32, f32)> = edges.into_iter().map(|(_, cost, b)| (b, cost)).collect();
        kept.sort_by_key(|&(b, _)| b);
        kept
    };
    (0..n_rows).map(of_row).collect()
}

fn lists(edges: &DirectedEdges) -> Vec<Vec<(u32, f32)>> {
    (0..edges.n_rows()).map(|row| edges.of(row).collect()).collect()
}

#[test]
fn kept_edges_are_those_of_a_double_loop() {
    for (seed, tau, n_kept) in [(1, 0.4, 5), (2, 0.8, 32), (3, 2.0, 8)] {
        let features = copies(seed);
        let query = KeptQuery { tau, min_jump: 9, n_kept, shard: Shard::WHOLE, known: None };
        let found = kept_edges(&features, &query, &CancelToken::new(), &|_| ()).expect("edges");
        let expected = kept_slowly(&features, tau, 9, n_kept);
        assert!(expected.iter().any(|kept| kept.len() == n_kept), "some lists are full");
        assert_eq!(lists(&found), expected, "seed {seed}");
    }
}

#[test]
fn shares_of_kept_edges_make_the_whole() {
    let features = copies(4);
    let of = |shard| {
        let query = KeptQuery { tau: 0.8, min_jump: 9, n_kept: 8, shard, known: None };
        lists(&kept_edges(&features, &query, &CancelToken::new(), &|_| ()).expect("edges"))
    };
    let mut together = vec![Vec::new(); features.n_rows()];
    for nth in 0..3 {
        for (all, share) in together.iter_mut().zip(of(Shard::new(nth, 3).expect("a share"))) {
            all.extend(share);
        }
    }
    assert_eq!(together, of(Shard::WHOLE));
}

#[test]
fn known_edges_are_not_found_again_and_change_nothing() {
    let features = copies(5);
    let (n_old, old_end) = (3, features.frame_starts[3]);
    let ask = |features: &FeatureSet, known| {
        let query = KeptQuery { tau: 0.8, min_jump: 9, n_kept: 8, shard: Shard::WHOLE, known };
        kept_edges(features, &query, &CancelToken::new(), &|_| ()).expect("edges")
    };
    let mut old = features.clone();
    old.frame_starts.truncate(n_old + 1);
    old.rows.truncate(old_end * features.n_dims);
    let of_old = ask(&old, None);
    let known = DirectedEdges::collect(features.n_rows(), |row, kept| {
        if row < old_end {
            kept.extend(of_old.of(row));
        }
    });
    assert_eq!(lists(&ask(&features, Some((&known, n_old)))), lists(&ask(&features, None)));
}

#[test]
fn copies_of_a_take_are_no_neighbours_and_no_cuts() {
    let features = copies(6);
    let found = nearest(&features, 9, &CancelToken::new(), &|_| ()).expect("not cancelled");
    let family = |row: usize| features.families.family(features.clip_of_row(row).0);
    for row in 0..features.n_rows() {
        let others = (0..features.n_rows()).filter(|&b| family(b) != family(row));
        let least = others.map(|b| cost_f64(&features, row, b)).fold(f64::INFINITY, f64::min);
        assert!((found.other_family[row] - least).abs() <= 1e-4 * least + 1e-5, "row {row}");
    }
    let pairs = pairs_below(&features, &PairQuery::all(2.0, 9), &CancelToken::new(), &|_| ())
        .expect("not cancelled");
    let place = |row: u32| {
        let (clip, frame) = features.clip_of_row(row as usize);
        (clip, frame as u32)
    };
    let is_same = |a, b| features.families.is_same_moment(place(a), place(b), 9);
    assert!(pairs.pairs.iter().all(|pair| !is_same(pair.a, pair.b)));
    let in_mirror =
        |p: &distance_grid::NearPair| (place(p.a).0, place(p.b).0) == (ClipId(0), ClipId(3));
    assert!(pairs.pairs.iter().any(in_mirror), "a mirror image is another moment");
}
