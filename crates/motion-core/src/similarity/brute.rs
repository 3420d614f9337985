//! The slow and obvious twin of [`distance_grid`](super::distance_grid): double loops in f64.

use super::distance_grid::{BLOCK, nearest, pairs_below};
use super::features::{FeatureSet, Metric};
use crate::cancel::CancelToken;
use rand::{RngExt, SeedableRng};

/// Clips of random walks in `n_dims` dimensions, so that there are near and far pairs.
fn random_walks(clip_lengths: &[usize], n_dims: usize, seed: u64) -> FeatureSet {
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
    FeatureSet { metric, n_dims, frame_starts, rows }
}

fn cost_f64(features: &FeatureSet, a: usize, b: usize) -> f64 {
    let pairs = features.row(a).iter().zip(features.row(b));
    pairs.map(|(&x, &y)| (f64::from(x) - f64::from(y)).powi(2)).sum()
}

#[test]
fn pairs_below_are_those_of_a_double_loop() {
    let features = random_walks(&[BLOCK - 7, 40, 300, 1, 90], 18, 1);
    let (tau, min_jump) = (0.8, 9);
    let found = pairs_below(&features, tau, min_jump, usize::MAX, &CancelToken::new(), &|_| ())
        .expect("not cancelled");
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
    let found = nearest(&features, &CancelToken::new(), &|_| ()).expect("not cancelled");
    for row in 0..features.n_rows() {
        let clip = features.clip_of_row(row).0;
        let others = (0..features.n_rows()).filter(|&b| features.clip_of_row(b).0 != clip);
        let least = others.map(|b| cost_f64(&features, row, b)).fold(f64::INFINITY, f64::min);
        let error = (found.other_clip[row] - least).abs();
        assert!(
            error <= 1e-4 * least + 1e-5,
            "row {row}: {} is not {least}",
            found.other_clip[row]
        );
    }
}

#[test]
fn a_full_budget_lowers_tau_and_keeps_the_cheapest() {
    let features = random_walks(&[BLOCK, 200, 77], 6, 3);
    let all = pairs_below(&features, 0.8, 9, usize::MAX, &CancelToken::new(), &|_| ())
        .expect("not cancelled");
    let budget = all.pairs.len() / 3;
    let some = pairs_below(&features, 0.8, 9, budget, &CancelToken::new(), &|_| ())
        .expect("not cancelled");
    assert!(some.tau < all.tau && some.pairs.len() <= budget, "{} of {budget}", some.pairs.len());
    let expected: Vec<_> = all.pairs.into_iter().filter(|p| f64::from(p.cost) < some.tau).collect();
    assert_eq!(some.pairs, expected, "exactly those under the lowered threshold");
}

#[test]
fn a_cancelled_search_for_pairs_says_so() {
    let cancel = CancelToken::new();
    cancel.cancel();
    let features = random_walks(&[50, 50], 6, 4);
    assert!(nearest(&features, &cancel, &|_| ()).is_err(), "nearest");
    assert!(pairs_below(&features, 1.0, 9, 10, &cancel, &|_| ()).is_err(), "pairs_below");
}
