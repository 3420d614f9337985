//! A few numbers a frame whose distances are never more than the cost: what prunes.
//!
//! An orthonormal projection never lengthens a vector, so `‖P(x − y)‖² ≤ ‖x − y‖² = C`: what is
//! too far apart in it is too far apart. What it leaves of a vector, `Rx = x − PᵀPx`, counts by its
//! length: `‖P(x − y)‖² + (‖Rx‖ − ‖Ry‖)² ≤ C`. The axes are those along which a sample of the frames
//! varies most (principal components), found by orthogonal iteration; they decide how much is
//! pruned and never what is found.

use super::features::FeatureSet;

/// Dimensions that are kept. On motion capture 16 of 102 hold about nine tenths of the variance.
const N_AXES: usize = 16;

/// Numbers a frame: one along each axis, and the length of what the axes leave.
pub(super) const N_COORDS: usize = N_AXES + 1;

/// Frames that the axes are found from.
const N_SAMPLES: usize = 8192;

/// Rounds of orthogonal iteration; the axes only have to be good.
const N_ROUNDS: usize = 8;

/// Frame numbers below `n_rows` in an order without rhythm, each at most once: steps of the
/// golden ratio.
pub(crate) fn spread_rows(n_rows: usize, n_samples: usize) -> Vec<usize> {
    if n_samples >= n_rows {
        return (0..n_rows).collect();
    }
    const GOLDEN: u64 = 0x9E37_79B9_7F4A_7C15;
    let at = |nth: u64| {
        let share = u128::from(nth.wrapping_mul(GOLDEN));
        ((share * n_rows as u128) >> 64) as usize
    };
    let mut rows: Vec<usize> = (0..n_samples as u64).map(at).collect();
    rows.sort_unstable();
    rows.dedup();
    rows
}

/// An orthonormal projection, and the length of what it leaves: [`N_COORDS`] numbers.
pub(super) struct Projection {
    n_dims: usize,
    /// Axis after axis; axes that the data has no use for are zero.
    axes: Vec<f64>,
}

impl Projection {
    /// The projection that keeps most of the variance of `features`.
    pub(super) fn of(features: &FeatureSet) -> Self {
        let n_dims = features.n_dims;
        let rows = spread_rows(features.n_rows(), N_SAMPLES);
        // A start that no data is orthogonal to: one bit pattern a number.
        let mut axes: Vec<f64> = (0..N_AXES * n_dims)
            .map(|at| {
                let bits = (at as u64 + 1).wrapping_mul(0xD134_2543_DE82_EF95) >> 40;
                bits as f64 / f64::from(1u32 << 24) - 0.5
            })
            .collect();
        orthonormalise(&mut axes, n_dims);
        for _ in 0..N_ROUNDS {
            let mut next = vec![0.0; axes.len()];
            for &row in &rows {
                let x = features.row(row);
                for (axis, next) in
                    axes.chunks_exact(n_dims.max(1)).zip(next.chunks_exact_mut(n_dims.max(1)))
                {
                    let along = dot(axis, x);
                    for (sum, &value) in next.iter_mut().zip(x) {
                        *sum += along * f64::from(value);
                    }
                }
            }
            orthonormalise(&mut next, n_dims);
            axes = next;
        }
        Self { n_dims, axes }
    }

    /// The coordinates of a row, rounded to f32.
    pub(super) fn project(&self, row: &[f32]) -> [f32; N_COORDS] {
        let mut projected = [0.0; N_COORDS];
        let mut rest: Vec<f64> = row.iter().map(|&x| f64::from(x)).collect();
        for (value, axis) in projected.iter_mut().zip(self.axes.chunks_exact(self.n_dims.max(1))) {
            let along = dot(axis, row);
            *value = along as f32;
            for (x, a) in rest.iter_mut().zip(axis) {
                *x -= along * a;
            }
        }
        projected[N_AXES] = rest.iter().map(|x| x * x).sum::<f64>().sqrt() as f32;
        projected
    }
}

fn dot(axis: &[f64], row: &[f32]) -> f64 {
    axis.iter().zip(row).map(|(a, &x)| a * f64::from(x)).sum()
}

/// Gram–Schmidt, twice; an axis that depends on those before it becomes zero.
fn orthonormalise(axes: &mut [f64], n_dims: usize) {
    if n_dims == 0 {
        return;
    }
    for nth in 0..axes.len() / n_dims {
        let (before, rest) = axes.split_at_mut(nth * n_dims);
        let axis = &mut rest[..n_dims];
        let length = |axis: &[f64]| axis.iter().map(|x| x * x).sum::<f64>().sqrt();
        let at_first = length(axis);
        for _ in 0..2 {
            for other in before.chunks_exact(n_dims) {
                let along: f64 = other.iter().zip(&*axis).map(|(a, b)| a * b).sum();
                for (x, &o) in axis.iter_mut().zip(other) {
                    *x -= along * o;
                }
            }
        }
        let left = length(axis);
        let scale = if left > 1e-9 * at_first { 1.0 / left } else { 0.0 };
        axis.iter_mut().for_each(|x| *x *= scale);
    }
}

#[cfg(test)]
mod tests {
    use super::super::brute::random_walks;
    use super::*;

    #[test]
    fn projected_distances_are_never_more_than_costs() {
        for n_dims in [3, 18, 40] {
            let features = random_walks(&[300, 200], n_dims, 5);
            let projection = Projection::of(&features);
            for a in (0..500).step_by(7) {
                for b in (0..500).step_by(11) {
                    let (p, q) =
                        (projection.project(features.row(a)), projection.project(features.row(b)));
                    let bound: f64 = p.iter().zip(q).map(|(x, y)| f64::from(x - y).powi(2)).sum();
                    let cost = features.cost(a, b);
                    assert!(bound <= cost * (1.0 + 1e-5) + 1e-9, "{bound} is above {cost}");
                    if n_dims <= N_AXES {
                        assert!(bound >= cost * (1.0 - 1e-4) - 1e-6, "nothing is lost: {bound}");
                    }
                }
            }
        }
    }

    #[test]
    fn spread_rows_are_different_rows() {
        assert_eq!(spread_rows(5, 9), [0, 1, 2, 3, 4]);
        let rows = spread_rows(1_000_000, 4096);
        assert_eq!(rows.len(), 4096);
        let widest = rows.windows(2).map(|pair| pair[1] - pair[0]).max();
        assert!(widest < Some(1000), "{widest:?} frames without one");
    }
}
