//! The cost in f32: quick, and how far it may lie from the true one is known.

/// How far [`rough_cost`] of vectors of `n_dims` numbers may lie from the true cost, as a share of
/// itself: each difference and each square is rounded once, each running sum at every step. Twice
/// what that comes to.
pub(super) fn rounding(n_dims: usize) -> f32 {
    (n_dims.div_ceil(LANES) + 12) as f32 * f32::EPSILON
}

const LANES: usize = 8;

/// `Σ (x − y)²`, right to within [`rounding`] of itself.
#[inline(always)]
pub(super) fn rough_cost(x: &[f32], y: &[f32]) -> f32 {
    let mut lanes = [0.0f32; LANES];
    let (chunks_x, chunks_y) = (x.chunks_exact(LANES), y.chunks_exact(LANES));
    let rest = chunks_x.remainder().iter().zip(chunks_y.remainder());
    let rest: f32 = rest.map(|(x, y)| (x - y) * (x - y)).sum();
    for (x, y) in chunks_x.zip(chunks_y) {
        for lane in 0..LANES {
            let difference = x[lane] - y[lane];
            lanes[lane] += difference * difference;
        }
    }
    let [a, b, c, d, e, f, g, h] = lanes;
    ((a + b) + (c + d)) + ((e + f) + (g + h)) + rest
}

#[cfg(test)]
mod tests {
    use super::super::brute::random_walks;
    use super::*;

    #[test]
    fn it_is_as_near_as_it_says() {
        for n_dims in [1, 7, 102, 400] {
            let features = random_walks(&[200, 100], n_dims, 7);
            for a in (0..300).step_by(3) {
                for b in (0..300).step_by(5) {
                    let rough = f64::from(rough_cost(features.row(a), features.row(b)));
                    let cost = features.cost(a, b);
                    let error = (rough - cost).abs();
                    assert!(
                        error <= 0.5 * f64::from(rounding(n_dims)) * cost,
                        "{rough} for {cost}"
                    );
                }
            }
        }
    }
}
