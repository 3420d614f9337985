//! The unit of length, from the size of the body.

use motion_core::skeleton::Skeleton;

use super::Guess;

/// Units that motion files come in.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum LengthUnit {
    /// 1 m.
    Metre,
    /// 0.01 m.
    Centimetre,
    /// 0.001 m.
    Millimetre,
    /// 0.0254 m.
    Inch,
    /// 1/0.45 inch, of the public CMU conversions: 0.056444 m.
    Cmu,
}

impl LengthUnit {
    /// Every unit.
    pub const ALL: [Self; 5] =
        [Self::Metre, Self::Centimetre, Self::Millimetre, Self::Inch, Self::Cmu];

    /// Metres of one unit.
    pub fn metres(self) -> f64 {
        match self {
            Self::Metre => 1.0,
            Self::Centimetre => 0.01,
            Self::Millimetre => 0.001,
            Self::Inch => 0.0254,
            Self::Cmu => 0.0254 / 0.45,
        }
    }

    /// What a person calls it.
    pub fn name(self) -> &'static str {
        match self {
            Self::Metre => "metres",
            Self::Centimetre => "centimetres",
            Self::Millimetre => "millimetres",
            Self::Inch => "inches",
            Self::Cmu => "the CMU unit (0.056444 m)",
        }
    }
}

/// Hip heights in file units, the end not included, and what they mean. Between the ranges no
/// unit makes a person; within them the body is 0.35 to 1.8 m high at the hips.
const RANGES: [(f32, f32, LengthUnit); 5] = [
    (0.35, 1.8, LengthUnit::Metre),
    (14.0, 22.0, LengthUnit::Cmu),
    (22.0, 55.0, LengthUnit::Inch),
    (55.0, 180.0, LengthUnit::Centimetre),
    (350.0, 1800.0, LengthUnit::Millimetre),
];

/// Hip height of a person for whom no range fits, metres.
const USUAL_HIP_HEIGHT_M: f32 = 0.93;

/// The unit of a skeleton whose lengths are in file units.
///
/// Unsure where the hip height fits no range; then the unit that makes the likeliest person.
pub fn guess_unit(skeleton_in_units: &Skeleton) -> Guess<LengthUnit> {
    let height = hip_height_units(skeleton_in_units);
    let fitting = RANGES.iter().find(|(low, high, _)| (*low..*high).contains(&height));
    if let Some(&(_, _, unit)) = fitting {
        return Guess { value: unit, sure: true };
    }
    if height <= 0.0 {
        return Guess { value: LengthUnit::Centimetre, sure: false };
    }
    let misfit = |unit: LengthUnit| (height * unit.metres() as f32 / USUAL_HIP_HEIGHT_M).ln().abs();
    let nearest = LengthUnit::ALL.into_iter().min_by(|&a, &b| misfit(a).total_cmp(&misfit(b)));
    Guess { value: nearest.unwrap_or(LengthUnit::Centimetre), sure: false }
}

/// How high the hips of a standing body are, in the skeleton's units, from bone lengths alone:
/// the rest pose may be anything.
///
/// Thigh and shin make 87 % of it. Without recognised legs it is 53 % of the body's height, taken
/// from the largest extent of the rest pose.
pub fn hip_height_units(skeleton: &Skeleton) -> f32 {
    if let Some(leg) = skeleton.leg_length_m().filter(|&leg| leg > 0.0) {
        return 1.15 * leg;
    }
    let mut low = glam::Vec3::INFINITY;
    let mut high = glam::Vec3::NEG_INFINITY;
    for (position, joint) in skeleton.rest_positions_m().into_iter().zip(skeleton.joints()) {
        let end = position + joint.end_site_m.unwrap_or_default();
        low = low.min(position).min(end);
        high = high.max(position).max(end);
    }
    0.53 * (high - low).max_element()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::guess::test_body::body;

    #[test]
    fn every_unit_is_recognised_for_small_and_large_people() {
        for hip_height_m in [0.75, 0.93, 1.1] {
            for unit in LengthUnit::ALL {
                let scale = hip_height_m / 0.93 / unit.metres() as f32;
                let guess = guess_unit(&body(scale));
                assert_eq!(guess.value, unit, "{hip_height_m} m");
                // In the CMU unit a child is below the range that the contract names.
                assert!(guess.sure || hip_height_m < 0.8, "{hip_height_m} m in {unit:?}");
            }
        }
    }

    #[test]
    fn the_edges_of_the_cmu_range_are_the_contracts() {
        let unit = |height: f32| guess_unit(&body(height / hip_height_units(&body(1.0)))).value;
        assert_eq!(unit(14.01), LengthUnit::Cmu);
        assert_eq!(unit(21.99), LengthUnit::Cmu);
        assert_eq!(unit(22.01), LengthUnit::Inch);
    }

    #[test]
    fn an_odd_size_is_a_guess_and_said_to_be() {
        assert!(!guess_unit(&body(6.0)).sure);
        assert!(!guess_unit(&body(1e5)).sure);
        assert!(!guess_unit(&body(0.0)).sure);
    }
}
