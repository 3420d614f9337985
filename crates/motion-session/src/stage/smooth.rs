//! Paths without jitter, for cameras.

use glam::Vec3;

/// A path under a Gaussian of `sigma` frames, its ends held: no frame of a camera that follows it
/// hurries to the next. A `sigma` of 0 (or no number) changes nothing.
pub fn smoothed(path: &[Vec3], sigma: f64) -> Vec<Vec3> {
    let Some(last) = path.len().checked_sub(1) else { return Vec::new() };
    if sigma.is_nan() || sigma <= 0.0 {
        return path.to_vec();
    }
    // What is further away than three sigma does not count, nor what is no frame.
    let half = (3.0 * sigma).ceil().min(last as f64 + 1.0) as usize;
    let weights: Vec<f64> =
        (0..=half).map(|offset| (-0.5 * (offset as f64 / sigma).powi(2)).exp()).collect();
    let total = 2.0 * weights.iter().sum::<f64>() - weights[0];
    let at = |frame: usize| {
        let weighted = |near: Vec3, offset: usize| near.as_dvec3() * weights[offset];
        let mut sum = weighted(path[frame], 0);
        for offset in 1..=half {
            sum += weighted(path[frame.saturating_sub(offset)], offset);
            sum += weighted(path[(frame + offset).min(last)], offset);
        }
        (sum / total).as_vec3()
    };
    (0..=last).map(at).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn even_motion_stays_and_jitter_goes() {
        let jitter = |f: usize| if f.is_multiple_of(2) { 0.05 } else { -0.05 };
        let path: Vec<Vec3> =
            (0..120).map(|f| Vec3::new(0.02 * f as f32, jitter(f), 0.0)).collect();
        let smooth = smoothed(&path, 10.0);
        for f in 40..80 {
            assert!((smooth[f].x - path[f].x).abs() < 1e-4, "frame {f}: {}", smooth[f]);
            assert!(smooth[f].y.abs() < 1e-3, "frame {f}: {}", smooth[f]);
        }
        let steps = smooth.windows(2).map(|pair| pair[1] - pair[0]);
        let jerks = steps.clone().zip(steps.skip(1)).map(|(a, b)| a.distance(b));
        assert!(jerks.fold(0.0, f32::max) < 0.002, "no step differs from the next");
    }

    #[test]
    fn any_path_will_do() {
        assert!(smoothed(&[], 3.0).is_empty());
        assert_eq!(smoothed(&[Vec3::ONE], 1e9), [Vec3::ONE]);
        assert_eq!(smoothed(&[Vec3::X, Vec3::Y], 0.0), [Vec3::X, Vec3::Y]);
        assert_eq!(smoothed(&[Vec3::X, Vec3::Y], f64::NAN), [Vec3::X, Vec3::Y]);
    }
}
