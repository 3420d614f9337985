//! What motions are compared by: their joints in the world at every few frames.

use super::library::SearchLibrary;
use super::route::Route;
use crate::bodies::LANES;

/// Frames between those that are looked at: nothing that a body does is over sooner.
const STRIDE: u32 = 6;

/// Long motions are looked at no less often than at so many frames.
const ENOUGH_FRAMES: u32 = 64;

/// The joints of a motion in the world, metres, at every few frames.
#[derive(Clone, Debug)]
pub(crate) struct Sketch {
    /// Frames between those that are looked at: [`STRIDE`] times a power of two.
    stride: u32,
    n_joints: usize,
    /// Per frame, joints filled up to a multiple of [`LANES`] with what is the same in all motions.
    width: usize,
    /// For each frame all x, then all y, then all z.
    values: Vec<f32>,
}

impl Sketch {
    /// Of a motion that is laid out.
    pub(crate) fn of(library: &SearchLibrary, route: &Route) -> Self {
        let n_joints = library.clips().skeleton().n_joints();
        let width = n_joints.next_multiple_of(LANES);
        let stride = stride_of(route.n_frames);
        let frames = (0..route.n_frames).step_by(stride as usize);
        let mut values = vec![0.0; frames.len() * 3 * width];
        for (frame, values) in frames.zip(values.chunks_exact_mut(3 * width)) {
            let span = route.span_at(frame);
            let clip_frame = span.from + frame - span.starts_at;
            let torso = span.world_from_clip * library.torsos(span.clip)[clip_frame as usize];
            let joints = library.bodies(span.clip).columns(clip_frame);
            let (xs, rest) = values.split_at_mut(width);
            let (ys, zs) = rest.split_at_mut(width);
            let (cos, sin) = (torso.cos(), torso.sin());
            for nth in 0..n_joints {
                let (x, z) = (joints.x[nth], joints.z[nth]);
                xs[nth] = cos * x + sin * z + torso.x_m;
                ys[nth] = joints.y[nth] + torso.level_m;
                zs[nth] = cos * z - sin * x + torso.z_m;
            }
        }
        Self { stride, n_joints, width, values }
    }

    /// Whether the mean distance of joints at equal times, over the frames that both motions have, is less than
    /// `limit_m`.
    pub(crate) fn is_nearer(&self, other: &Self, limit_m: f32) -> bool {
        let stride = self.stride.max(other.stride);
        let (ours, theirs) = (self.frames(stride), other.frames(stride));
        let n = ours.len().min(theirs.len());
        let enough_m = limit_m * (n * self.n_joints) as f32;
        let mut sum_m = 0.0;
        for (ours, theirs) in ours.zip(theirs) {
            sum_m += distances_m(self.width, ours, theirs);
            if sum_m >= enough_m {
                return false;
            }
        }
        true
    }

    /// Every frame that is a multiple of `stride`, itself one of this sketch's.
    fn frames(&self, stride: u32) -> impl ExactSizeIterator<Item = &[f32]> {
        let step = (stride / self.stride) as usize;
        self.values.chunks_exact(3 * self.width).step_by(step)
    }
}

fn stride_of(n_frames: u32) -> u32 {
    STRIDE << (n_frames / STRIDE / ENOUGH_FRAMES).max(1).ilog2()
}

/// The sum of the joints' distances at one frame.
#[inline]
fn distances_m(width: usize, a: &[f32], b: &[f32]) -> f32 {
    let mut sums = [0.0f32; LANES];
    for first in (0..width).step_by(LANES) {
        for (lane, sum) in sums.iter_mut().enumerate() {
            let off = |axis: usize| a[axis * width + first + lane] - b[axis * width + first + lane];
            let (x, y, z) = (off(0), off(1), off(2));
            *sum += (x * x + y * y + z * z).sqrt();
        }
    }
    sums.into_iter().sum()
}

#[cfg(test)]
mod tests {
    use glam::Vec3;
    use proptest::prelude::*;

    use super::*;

    /// A sketch of `n_frames` frames whose three joints walk along x, `beside_m` aside of it.
    fn walk(n_frames: u32, beside_m: f32) -> (Sketch, Vec<[Vec3; 3]>) {
        let stride = stride_of(n_frames);
        let at = |frame: u32| {
            let x_m = 0.04 * frame as f32;
            [0.1, 0.9, 1.6].map(|y_m| Vec3::new(x_m, y_m, beside_m * y_m))
        };
        let width = LANES;
        let mut values = Vec::new();
        for frame in (0..n_frames).step_by(stride as usize) {
            for axis in 0..3 {
                let own = at(frame).map(|joint| joint[axis]);
                values.extend((0..width).map(|nth| own.get(nth).copied().unwrap_or(0.0)));
            }
        }
        (Sketch { stride, n_joints: 3, width, values }, (0..n_frames).map(at).collect())
    }

    proptest! {
        #[test]
        fn motions_are_compared_at_their_common_frames(
            (n_a, n_b) in (1u32..900, 1u32..900),
            (beside_a_m, beside_b_m) in (-1f32..1.0, -1f32..1.0),
            limit_m in 0.01f32..1.5,
        ) {
            let ((a, joints_a), (b, joints_b)) = (walk(n_a, beside_a_m), walk(n_b, beside_b_m));
            let pairs = joints_a.iter().zip(&joints_b);
            let (sum_m, n) = pairs.fold((0.0, 0), |(sum_m, n), (a, b)| {
                let apart_m: f32 = a.iter().zip(b).map(|(a, b)| a.distance(*b)).sum();
                (sum_m + apart_m, n + 3)
            });
            let mean_m = sum_m / n as f32;
            // The joints are as far apart at all times, so that it does not matter at which they are looked at.
            prop_assume!((mean_m - limit_m).abs() > 1e-3);
            prop_assert_eq!(a.is_nearer(&b, limit_m), mean_m < limit_m);
            prop_assert_eq!(b.is_nearer(&a, limit_m), mean_m < limit_m);
        }
    }

    #[test]
    fn long_motions_are_looked_at_less_often() {
        for (n_frames, stride) in
            [(1, 6), (383, 6), (767, 6), (768, 12), (3_072, 48), (36_000, 384)]
        {
            assert_eq!(stride_of(n_frames), stride, "{n_frames}");
            assert!(n_frames < 384 || n_frames / stride >= ENOUGH_FRAMES, "{n_frames}");
        }
    }
}
