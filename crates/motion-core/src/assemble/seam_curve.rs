//! The curves that spread what jumps at a cut over the frames around it (AF02, figure 4;
//! `docs/method.md`, A6).
//!
//! With d the first frame of the new piece, o = f − d, b and a the window's frames before and
//! after the cut, β and α the shares of the jump taken before and after it (α + β = 1):
//!
//! ```text
//! position curve   y(o) =  β (1 + o/b)²            −b ≤ o < 0
//!                       = −α (1 − o/a)²             0 ≤ o ≤ a
//! velocity curve   g(o) =  β o (1 + o/b)²          −b ≤ o < 0
//!                       = −α o (1 − o/a)²           0 ≤ o ≤ a
//! ```
//!
//! and 0 elsewhere. With b = a = s and halves for shares, y is the paper's curve: ½u² before the
//! cut and −½u² + 2u − 2 = −½(2 − u)² after it, u = (o + s)/s. What is added to the motion is
//! `y(o) · (jump of position) + g(o) · (jump of velocity per frame)`.
//!
//! Laws, each a test of the same name:
//!
//! 1. **the jump is closed**: y just before the cut minus y at the cut is 1; g is 0 at the cut.
//! 2. **zero with zero slope at the window's ends**, y and g alike.
//! 3. **equal slopes of y on both sides of the cut**, so that y itself adds no jump of velocity
//!    (for shares in proportion to the sides, as [`Window::shares`] gives them).
//! 4. **the velocity jump is closed**: slope of g just before the cut minus just after it is 1.
//! 5. **odd about the cut**: y(−o) = −y(o) for a window of equal sides.

/// The frames around a cut over which its jump is spread.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Window {
    /// Frames before the cut; the displacement is 0 that many frames before it.
    pub before: usize,
    /// Frames after the cut; the displacement is 0 that many frames after it.
    pub after: usize,
}

impl Window {
    /// The window of `side` frames each way around the cut at `cut` that leaves the first and
    /// the last frame and every frame of `hard` (sorted) as they are.
    pub fn within(cut: usize, side: usize, n_frames: usize, hard: &[usize]) -> Self {
        let next_hard = hard.partition_point(|&frame| frame < cut);
        let before = cut - next_hard.checked_sub(1).map_or(0, |idx| hard[idx]).min(cut);
        let last = hard.get(next_hard).copied().unwrap_or(usize::MAX).min(n_frames - 1);
        Self { before: side.min(before), after: side.min(last.saturating_sub(cut)) }
    }

    /// The shares of the jump that are taken before and after the cut: in proportion to the two
    /// sides, halves when they are equal. A window without frames takes nothing.
    pub fn shares(self) -> (f32, f32) {
        let whole = self.before + self.after;
        if whole == 0 {
            return (0.0, 0.0);
        }
        let before = self.before as f32 / whole as f32;
        (before, 1.0 - before)
    }
}

/// Curves of one window with the shares it splits the jump into.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SeamCurve {
    window: Window,
    share_before: f32,
    share_after: f32,
}

impl SeamCurve {
    /// The curve with shares in proportion to the window's sides.
    pub fn proportional(window: Window) -> Self {
        let (share_before, share_after) = window.shares();
        Self { window, share_before, share_after }
    }

    /// The paper's curve: a half on each side, however long. Where a side has no frames the
    /// other takes the whole jump.
    pub fn halves(window: Window) -> Self {
        let (share_before, share_after) = match (window.before, window.after) {
            (0, 0) => (0.0, 0.0),
            (0, _) => (0.0, 1.0),
            (_, 0) => (1.0, 0.0),
            _ => (0.5, 0.5),
        };
        Self { window, share_before, share_after }
    }

    /// The window.
    pub fn window(self) -> Window {
        self.window
    }

    /// The share of the jump that is taken before the cut.
    pub fn share_before(self) -> f32 {
        self.share_before
    }

    /// The share of the jump that is taken from the cut on.
    pub fn share_after(self) -> f32 {
        self.share_after
    }

    /// The position curve y, `offset` frames after the cut.
    #[inline]
    pub fn position(self, offset: f32) -> f32 {
        let (share, left) = self.at(offset);
        share * left * left
    }

    /// The velocity curve g in frames, `offset` frames after the cut.
    #[inline]
    pub fn velocity(self, offset: f32) -> f32 {
        let (share, left) = self.at(offset);
        share * offset * left * left
    }

    /// The signed share and how much of the window is left, 1 at the cut and 0 at the end.
    #[inline]
    fn at(self, offset: f32) -> (f32, f32) {
        let (share, side) = if offset < 0.0 {
            (self.share_before, self.window.before)
        } else {
            (-self.share_after, self.window.after)
        };
        if side == 0 {
            return (0.0, 0.0);
        }
        (share, (1.0 - offset.abs() / side as f32).max(0.0))
    }
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;

    const STEP: f32 = 1e-3;
    /// Just before the cut.
    const BEFORE: f32 = -1e-6;

    fn curves() -> impl Strategy<Value = SeamCurve> {
        (1usize..60, 1usize..60).prop_flat_map(|(before, after)| {
            let window = Window { before, after };
            prop_oneof![Just(SeamCurve::proportional(window)), Just(SeamCurve::halves(window)),]
        })
    }

    fn slope(curve: impl Fn(f32) -> f32, from: f32, to: f32) -> f32 {
        (curve(to) - curve(from)) / (to - from)
    }

    #[test]
    fn with_equal_sides_it_is_the_paper_s_curve() {
        let (s, curve) = (30.0, SeamCurve::proportional(Window { before: 30, after: 30 }));
        for offset in -40..=40 {
            let offset = offset as f32;
            let u = (offset + s) / s;
            let paper = match offset {
                o if o < -s || o > s => 0.0,
                o if o < 0.0 => 0.5 * u * u,
                _ => -0.5 * u * u + 2.0 * u - 2.0,
            };
            assert!((curve.position(offset) - paper).abs() < 1e-6, "offset {offset}");
        }
    }

    proptest! {
        #[test]
        fn the_jump_is_closed(curve in curves()) {
            let jump = curve.position(BEFORE) - curve.position(0.0);
            prop_assert!((jump - 1.0).abs() < 1e-4, "{jump}");
            prop_assert!(curve.velocity(BEFORE).abs() < 1e-5 && curve.velocity(0.0) == 0.0);
        }

        #[test]
        fn zero_with_zero_slope_at_the_window_s_ends(curve in curves()) {
            let Window { before, after } = curve.window();
            for (end, inwards) in [(-(before as f32), STEP), (after as f32, -STEP)] {
                for value in [curve.position(end), curve.velocity(end)] {
                    prop_assert_eq!(value, 0.0);
                }
                prop_assert!(slope(|o| curve.position(o), end, end + inwards).abs() < 5e-3);
                prop_assert!(slope(|o| curve.velocity(o), end, end + inwards).abs() < 5e-3);
                prop_assert_eq!(curve.position(end - 3.0 * inwards), 0.0);
            }
        }

        #[test]
        fn equal_slopes_of_y_on_both_sides_of_the_cut(before in 1usize..60, after in 1usize..60) {
            let curve = SeamCurve::proportional(Window { before, after });
            let left = slope(|o| curve.position(o), BEFORE - STEP, BEFORE);
            let right = slope(|o| curve.position(o), 0.0, STEP);
            prop_assert!((left - right).abs() < 3e-3, "{left} against {right}");
        }

        #[test]
        fn the_velocity_jump_is_closed(curve in curves()) {
            let left = slope(|o| curve.velocity(o), -STEP, BEFORE);
            let right = slope(|o| curve.velocity(o), 0.0, STEP);
            prop_assert!((left - right - 1.0).abs() < 1e-2, "{left} {right}");
        }

        #[test]
        fn odd_about_the_cut(side in 1usize..60, offset in 0.001f32..70.0) {
            let curve = SeamCurve::proportional(Window { before: side, after: side });
            prop_assert!((curve.position(-offset) + curve.position(offset)).abs() < 1e-6);
        }

        #[test]
        fn windows_leave_ends_and_hard_frames_alone(
            cut in 1usize..99, side in 0usize..60, mut hard in prop::collection::vec(0usize..100, 0..4),
        ) {
            hard.sort_unstable();
            let window = Window::within(cut, side, 100, &hard);
            let curve = SeamCurve::proportional(window);
            prop_assert!(window.before <= side && window.after <= side);
            for &frame in hard.iter().chain(&[0, 99]) {
                let offset = frame as f32 - cut as f32;
                prop_assert_eq!(curve.position(offset), 0.0, "frame {}", frame);
                prop_assert_eq!(curve.velocity(offset), 0.0, "frame {}", frame);
            }
        }
    }

    #[test]
    fn a_side_without_frames_leaves_the_whole_jump_to_the_other() {
        for curve in [SeamCurve::proportional, SeamCurve::halves] {
            let late = curve(Window { before: 0, after: 10 });
            assert_eq!((late.position(-1.0), late.position(0.0)), (0.0, -1.0));
            let early = curve(Window { before: 10, after: 0 });
            assert!((early.position(BEFORE) - 1.0).abs() < 1e-5, "all of it before the cut");
            assert_eq!(early.position(0.0), 0.0);
            let none = curve(Window { before: 0, after: 0 });
            assert_eq!((none.position(-1.0), none.position(0.0)), (0.0, 0.0));
        }
    }
}
