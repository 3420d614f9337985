//! Round places and headings, and how a heading comes from two places.

/// With Shift places are brought to a grid of this, metres.
pub const GRID_M: f64 = 0.25;
/// Heights, which are smaller matters, to one of this.
pub const HEIGHT_GRID_M: f64 = 0.05;
/// And headings to multiples of this, degrees.
pub const GRID_DEG: f64 = 15.0;
/// An arrow has a direction when the pointer is further away than this, metres.
const MIN_ARROW_M: f64 = 0.15;

/// A value, or the nearest multiple of `step` where it snaps.
pub fn snapped(value: f64, step: f64, is_snapping: bool) -> f64 {
    if is_snapping { (value / step).round() * step } else { value }
}

/// From a place towards another, 0 along +Z and 90 along +X, whole degrees; `None` where they are
/// too near.
pub fn heading_deg(from: [f64; 2], to: [f64; 2], is_snapping: bool) -> Option<f64> {
    let [x, z] = [to[0] - from[0], to[1] - from[1]];
    let deg = (x.hypot(z) > MIN_ARROW_M).then(|| x.atan2(z).to_degrees())?;
    Some(snapped(deg, GRID_DEG, is_snapping).round() + 0.0)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn headings_grow_to_the_left() {
        for (to, is_snapping, expected) in [
            ([0.0, 1.0], false, Some(0.0)),
            ([1.0, 0.0], false, Some(90.0)),
            ([-1.0, 0.0], false, Some(-90.0)),
            ([1.0, 0.9], true, Some(45.0)),
            ([0.1, 0.1], false, None),
        ] {
            assert_eq!(heading_deg([0.0, 0.0], to, is_snapping), expected, "{to:?}");
        }
    }

    #[test]
    fn values_snap_only_when_asked() {
        assert_eq!(snapped(0.4, GRID_M, true), 0.5);
        assert_eq!(snapped(0.4, GRID_M, false), 0.4);
    }
}
