//! How long a unit of the file is.

use std::path::Path;

use motion_core::skeleton::Skeleton;

use crate::diagnostic::Warnings;
use crate::guess::{self, Guess, LengthUnit};

/// Between its lowest and its highest joint a person is so high, metres: from a child's to a
/// giant's.
const PERSON_M: std::ops::Range<f64> = 0.4..2.6;

/// The same of a grown-up.
const USUAL_M: f64 = 1.55;

/// Metres of one unit, and the unit where it is one that people use.
///
/// Metres, as the format says, where that makes a person; else what [`guess::guess_unit`] says,
/// where that does; else whatever makes a grown-up, with a warning.
pub(crate) fn guess_metres(
    skeleton_in_units: &Skeleton,
    path: &Path,
    warnings: &mut Warnings,
) -> (f64, Option<Guess<LengthUnit>>) {
    let height = height_units(skeleton_in_units);
    let metre = Guess { value: LengthUnit::Metre, sure: true };
    if PERSON_M.contains(&height) || height <= 0.0 {
        return (1.0, Some(metre));
    }
    let unit = guess::guess_unit(skeleton_in_units);
    if unit.sure && PERSON_M.contains(&(height * unit.value.metres())) {
        return (unit.value.metres(), Some(unit));
    }
    let metres = USUAL_M / height;
    let what = format!(
        "the body is {height:.2} units high without its scalp, which is no person in any unit; one \
         is taken for {metres:.3} m (--scale says otherwise)"
    );
    warnings.warn(path, None, what);
    (metres, None)
}

/// From the lowest to the highest joint of the standing rest pose, file units.
fn height_units(skeleton: &Skeleton) -> f64 {
    let upright = guess::canonical_from_rest(skeleton).value;
    let heights = skeleton.rest_positions_m().into_iter().map(|at| f64::from((upright * at).y));
    let (low, high) = heights
        .fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), y| (low.min(y), high.max(y)));
    high - low
}
