//! Where the field is asked: planes along each axis, closer together where detail is.

use glam::Vec3;

/// A box in which the grid is finer.
#[derive(Clone, Copy, Debug)]
pub(super) struct Detail {
    pub(super) low_m: Vec3,
    pub(super) high_m: Vec3,
    pub(super) step_m: f32,
}

/// Corners of boxes ("cells"), a product of three lists of coordinates.
#[derive(Clone, Debug)]
pub(super) struct Grid {
    /// Ascending, at least two on each axis.
    pub(super) axes_m: [Vec<f32>; 3],
    /// Where the body is its own mirror image, the plane's x: then cells begin with the column
    /// whose middle it is.
    pub(super) mirror_x_m: Option<f32>,
}

/// More corners than this are not taken memory for.
const MAX_CORNERS: f64 = 6e6;

/// How fast steps grow away from detail.
const GROWTH: f32 = 0.3;

impl Grid {
    /// A grid with steps of `step_m` over a box, whose middle plane is at `middle_x_m`.
    ///
    /// Steps are as wide as they must be for the number of corners to stay below a limit, however
    /// large the box.
    pub(super) fn new(
        bounds_m: [Vec3; 2],
        middle_x_m: f32,
        is_mirrored: bool,
        step_m: f32,
        details: &[Detail],
    ) -> Self {
        let mut factor = 1.0_f32;
        loop {
            let grid =
                Self::with_factor(bounds_m, middle_x_m, is_mirrored, step_m, details, factor);
            match grid {
                Some(grid) if grid.n_corners() <= MAX_CORNERS => return grid,
                _ => factor *= 1.25,
            }
        }
    }

    fn n_corners(&self) -> f64 {
        self.axes_m.iter().map(|axis| axis.len() as f64).product()
    }

    fn with_factor(
        [low, high]: [Vec3; 2],
        middle_x_m: f32,
        is_mirrored: bool,
        step_m: f32,
        details: &[Detail],
        factor: f32,
    ) -> Option<Self> {
        let step_at = |axis: usize, at: f32| {
            let fine = details.iter().map(|detail| {
                let mut off = (detail.low_m[axis] - at).max(at - detail.high_m[axis]);
                if axis == 0 {
                    // Both sides alike, so that the planes mirror each other.
                    let image = 2.0 * middle_x_m - at;
                    off = off.min((detail.low_m[0] - image).max(image - detail.high_m[0]));
                }
                detail.step_m + GROWTH * off.max(0.0)
            });
            factor * fine.fold(step_m, f32::min)
        };
        let walk = |axis: usize, from: f32, to: f32| {
            let mut planes = vec![from];
            let mut at = from;
            while at < to {
                // Half a step ahead, so that going and coming back see the same steps.
                let step = step_at(axis, at + 0.5 * step_at(axis, at)).max(1e-6 + at.abs() * 1e-5);
                at += step;
                planes.push(at);
                if planes.len() > 2_000_000 {
                    return None;
                }
            }
            planes.push(at + step_at(axis, at).max(1e-6 + at.abs() * 1e-5));
            Some(planes)
        };
        let pad = 2.0 * step_m * factor;
        let half = 0.5 * step_at(0, middle_x_m);
        let reach = (high.x - middle_x_m).max(middle_x_m - low.x) + pad;
        let right = walk(0, middle_x_m + half, middle_x_m + reach.max(2.0 * half))?;
        let mut xs: Vec<f32> = if is_mirrored {
            vec![middle_x_m - half]
        } else {
            right.iter().rev().map(|x| 2.0 * middle_x_m - x).collect()
        };
        xs.extend(right);
        let ys = walk(1, low.y - pad, high.y + pad)?;
        let zs = walk(2, low.z - pad, high.z + pad)?;
        let mirror_x_m = is_mirrored.then_some(middle_x_m);
        Some(Self { axes_m: [xs, ys, zs], mirror_x_m })
    }

    /// How many corners along each axis.
    pub(super) fn size(&self) -> [usize; 3] {
        std::array::from_fn(|axis| self.axes_m[axis].len())
    }

    /// Where a corner is.
    pub(super) fn corner_m(&self, at: [usize; 3]) -> Vec3 {
        Vec3::from_array(std::array::from_fn(|axis| self.axes_m[axis][at[axis]]))
    }
}
