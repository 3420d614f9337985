//! Frames to pixels and back.

/// How frames lie along the timeline. Frame `f` is a column from `x_of(f)` to `x_of(f + 1)`; marks
/// stand at its left edge, where the frame begins.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Axis {
    /// Where the lane begins, points.
    pub left_pt: f32,
    /// How wide it is, points.
    pub width_pt: f32,
    /// The frame at its left edge; may lie between two.
    pub first: f64,
    /// How far apart frames are, points; above 0.
    pub pt_per_frame: f64,
}

/// Frames are never further apart than this, points.
pub const MAX_PT_PER_FRAME: f64 = 48.0;
/// Nor nearer than this share of what shows the whole motion.
const MIN_SHARE: f64 = 0.5;
/// What is nearer to a mark than this snaps to it, points.
pub const SNAP_PT: f32 = 6.0;
/// Free room beside the whole motion, points.
const MARGIN_PT: f64 = 20.0;
/// Numbers on the ruler are at least so far apart, points.
const MIN_TICK_PT: f64 = 56.0;

impl Axis {
    /// All of `n_frames` (at least 1) in view.
    pub fn fit(left_pt: f32, width_pt: f32, n_frames: usize) -> Self {
        let room = (f64::from(width_pt) - 2.0 * MARGIN_PT).max(1.0);
        let pt_per_frame = (room / n_frames.max(1) as f64).min(MAX_PT_PER_FRAME);
        Self { left_pt, width_pt, first: -MARGIN_PT / pt_per_frame, pt_per_frame }
    }

    /// Whether it is as [`Axis::fit`] makes it: all of `n_frames` in view.
    pub fn shows_all(&self, n_frames: usize) -> bool {
        *self == Self::fit(self.left_pt, self.width_pt, n_frames)
    }

    /// Where a frame begins, points.
    pub fn x_of(&self, frame: f64) -> f32 {
        self.left_pt + ((frame - self.first) * self.pt_per_frame) as f32
    }

    /// The moment at a place; a whole number where a frame begins.
    pub fn frame_at(&self, x_pt: f32) -> f64 {
        self.first + f64::from(x_pt - self.left_pt) / self.pt_per_frame
    }

    /// The moment at the right edge.
    pub fn last_in_view(&self) -> f64 {
        self.first + f64::from(self.width_pt) / self.pt_per_frame
    }

    /// Comes nearer (`factor` above 1) or goes away; what is under `x_pt` stays there.
    pub fn zoom_at(&mut self, x_pt: f32, factor: f64, n_frames: usize) {
        let kept = self.frame_at(x_pt);
        let least = Self::fit(0.0, self.width_pt, n_frames).pt_per_frame * MIN_SHARE;
        self.pt_per_frame =
            (self.pt_per_frame * factor).clamp(least.min(MAX_PT_PER_FRAME), MAX_PT_PER_FRAME);
        self.first = kept - f64::from(x_pt - self.left_pt) / self.pt_per_frame;
        self.keep_in_sight(n_frames);
    }

    /// Moves what is shown along with a pointer.
    pub fn pan(&mut self, by_pt: f32, n_frames: usize) {
        self.first -= f64::from(by_pt) / self.pt_per_frame;
        self.keep_in_sight(n_frames);
    }

    /// Some of the motion is always to be seen.
    fn keep_in_sight(&mut self, n_frames: usize) {
        let width = f64::from(self.width_pt) / self.pt_per_frame;
        let (least, most) = (-0.75 * width, n_frames as f64 - 0.25 * width);
        self.first = self.first.clamp(least.min(most), most.max(least));
    }

    /// Moves so little that a moment comes into view.
    pub fn reveal(&mut self, frame: f64) {
        let width = f64::from(self.width_pt) / self.pt_per_frame;
        let margin = (MARGIN_PT / self.pt_per_frame).min(0.25 * width);
        if frame < self.first + margin {
            self.first = frame - margin;
        } else if frame > self.first + width - margin {
            self.first = frame - width + margin;
        }
    }

    /// The whole frame meant at a place: one of `marks` within [`SNAP_PT`] (the nearest), unless
    /// `is_free`; else the frame whose beginning is nearest. Always one of `0..n_frames`.
    pub fn snap(&self, x_pt: f32, marks: &[usize], is_free: bool, n_frames: usize) -> usize {
        let last = n_frames.saturating_sub(1);
        let off = |mark: usize| (self.x_of(mark as f64) - x_pt).abs();
        let near = marks
            .iter()
            .copied()
            .filter(|mark| !is_free && *mark <= last && off(*mark) <= SNAP_PT)
            .min_by(|a, b| off(*a).total_cmp(&off(*b)));
        near.unwrap_or_else(|| (self.frame_at(x_pt).round().max(0.0) as usize).min(last))
    }

    /// How many frames apart numbers on the ruler are: round ones, in seconds where frames are
    /// close together.
    pub fn tick_step(&self, fps: f64) -> usize {
        let second = fps.round().max(1.0) as usize;
        let frames = [1, 2, 5, 10].into_iter().filter(|step| *step < second);
        let seconds = [1, 2, 5, 10, 30, 60, 300, 600].map(|secs| secs * second);
        let mut steps = frames.chain((second >= 20).then_some(second / 2)).chain(seconds);
        let fits = |step: &usize| *step as f64 * self.pt_per_frame >= MIN_TICK_PT;
        steps.find(fits).unwrap_or(3600 * second)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// 10 points a frame, from frame −2 on.
    fn axis() -> Axis {
        Axis { left_pt: 100.0, width_pt: 500.0, first: -2.0, pt_per_frame: 10.0 }
    }

    #[test]
    fn frames_and_places() {
        for (frame, x) in [(-2.0, 100.0), (0.0, 120.0), (0.5, 125.0), (48.0, 600.0)] {
            assert_eq!(axis().x_of(frame), x);
            assert_eq!(axis().frame_at(x), frame);
        }
        assert_eq!(axis().last_in_view(), 48.0);
    }

    #[test]
    fn the_whole_motion_fits() {
        for (width, n_frames) in [(500.0, 240), (500.0, 1), (1500.0, 100_000), (10.0, 240)] {
            let axis = Axis::fit(40.0, width, n_frames);
            assert!(axis.x_of(0.0) >= 40.0, "{width} {n_frames}");
            assert!(axis.pt_per_frame > 0.0 && axis.pt_per_frame <= MAX_PT_PER_FRAME);
            if width > 100.0 {
                assert!(axis.x_of(n_frames as f64) <= 40.0 + width + 0.1, "{width} {n_frames}");
            }
        }
    }

    #[test]
    fn zoom_keeps_what_is_under_the_pointer() {
        for (x, factor) in [(100.0, 2.0), (350.0, 2.0), (350.0, 0.8), (599.0, 1.3)] {
            let mut axis = axis();
            let before = axis.frame_at(x);
            axis.zoom_at(x, factor, 40);
            assert!((axis.frame_at(x) - before).abs() < 1e-6, "{x} {factor}");
        }
    }

    #[test]
    fn zoom_and_pan_have_ends() {
        let mut axis = axis();
        for _ in 0..100 {
            axis.zoom_at(300.0, 1.5, 40);
        }
        assert_eq!(axis.pt_per_frame, MAX_PT_PER_FRAME);
        for _ in 0..200 {
            axis.zoom_at(300.0, 0.7, 40);
        }
        let whole = Axis::fit(0.0, 500.0, 40).pt_per_frame;
        assert!((axis.pt_per_frame - whole * 0.5).abs() < 1e-9);
        for by in [1e6, -2e6] {
            axis.pan(by, 40);
            let (from, to) = (axis.x_of(0.0), axis.x_of(40.0));
            assert!(to > axis.left_pt && from < axis.left_pt + axis.width_pt, "{from} {to}");
        }
    }

    #[test]
    fn snapping_table() {
        let marks = [10, 11, 39, 70];
        // Frame 10 is at 220, 11 at 230.
        for (x, is_free, expected) in [
            (223.0, false, 10),
            (226.0, false, 11),
            (236.0, false, 11),
            (237.0, false, 12),
            (223.0, true, 10),
            (236.0, true, 12),
            (0.0, false, 0),
            (514.0, false, 39),
            (900.0, false, 39),
        ] {
            assert_eq!(axis().snap(x, &marks, is_free, 40), expected, "{x} {is_free}");
        }
        assert_eq!(axis().snap(300.0, &[], false, 0), 0, "no motion at all");
        assert_eq!(axis().snap(f32::NAN, &[], true, 40), 0);
    }

    #[test]
    fn numbers_on_the_ruler_are_round() {
        for (pt_per_frame, fps, expected) in [
            (48.0, 30.0, 2),
            (12.0, 30.0, 5),
            (6.0, 30.0, 10),
            (4.0, 30.0, 15),
            (2.0, 30.0, 30),
            (1.0, 30.0, 60),
            (0.01, 30.0, 9000),
            (1.0, 120.0, 60),
            (30.0, 1.0, 2),
            (1e-9, 30.0, 108_000),
        ] {
            let axis = Axis { pt_per_frame, ..axis() };
            assert_eq!(axis.tick_step(fps), expected, "{pt_per_frame} {fps}");
        }
    }

    #[test]
    fn the_playhead_is_brought_into_view() {
        for frame in [-10.0, 0.0, 30.0, 47.9, 400.0] {
            let mut axis = axis();
            axis.reveal(frame);
            let x = axis.x_of(frame);
            assert!((100.0..=600.0).contains(&x), "{frame}: {x}");
        }
        let mut still = axis();
        still.reveal(20.0);
        assert_eq!(still, axis());
    }
}
