//! What changes by hand are called.

use motion_core::by_hand::Limb;
use motion_session::document::HandChange;

use crate::viewport::gesture::joint::spaced;

/// What a hand or a foot is called.
pub fn limb_name(limb: Limb) -> &'static str {
    match limb {
        Limb::LeftHand => "Left hand",
        Limb::RightHand => "Right hand",
        Limb::LeftFoot => "Left foot",
        Limb::RightFoot => "Right foot",
    }
}

/// What is changed: `Left hand`, `Head`.
pub fn what(change: &HandChange) -> String {
    match change {
        HandChange::Joint { joint, .. } => spaced(joint),
        HandChange::Hand { limb, .. } => limb_name(*limb).to_owned(),
    }
}

/// By how much, as people say it: `12 cm`, `30°`.
pub fn how_much(change: &HandChange) -> String {
    let length = |v: &[f64; 3]| v.iter().map(|x| x * x).sum::<f64>().sqrt();
    match change {
        HandChange::Joint { turn_deg, .. } => format!("{:.0}°", length(turn_deg)),
        HandChange::Hand { shift_m, .. } => format!("{:.0} cm", 100.0 * length(shift_m)),
    }
}

#[cfg(test)]
mod tests {
    use motion_core::by_hand::Space;

    use super::*;

    #[test]
    fn changes_are_said_with_units() {
        let turn =
            HandChange::Joint { joint: "LeftForeArm".to_owned(), turn_deg: [0.0, 30.0, 0.0] };
        assert_eq!((what(&turn).as_str(), how_much(&turn).as_str()), ("Left fore arm", "30°"));
        let (limb, space) = (Limb::RightFoot, Space::World);
        let shift = HandChange::Hand { limb, shift_m: [0.03, 0.04, 0.0], space };
        assert_eq!((what(&shift).as_str(), how_much(&shift).as_str()), ("Right foot", "5 cm"));
    }
}
