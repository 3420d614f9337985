//! A motion of unknown origin set on the floor, and how high its soles are.

use motion_core::contacts::Side;
use motion_core::floor::{Soles, calibrate_reported};
use motion_core::motion::Motion;
use motion_core::skeleton::{JointRole, Skeleton};

/// A toe joint is this high above its sole, as a share of the leg.
const TOE_SHARE: f32 = 0.035;
/// An ankle, where there is no toe joint.
const ANKLE_SHARE: f32 = 0.10;
/// A sole between these multiples of the usual one is believed; what is beyond is a floor that was
/// captured too high or too low.
const BELIEVED: [f32; 2] = [0.4, 2.2];
/// The leg of a body whose legs are not recognised, metres.
const USUAL_LEG_M: f32 = 0.85;

/// A motion whose floor is at height 0.
#[derive(Clone, Debug, PartialEq)]
pub struct Standing {
    /// The motion, lowered or raised.
    pub motion: Motion,
    /// How high its toe joints are when their feet stand on the floor.
    pub soles: Soles,
}

/// The soles of a body of which nothing else is known: a share of its leg.
pub fn usual_soles(skeleton: &Skeleton) -> Soles {
    let leg_m = skeleton.leg_length_m().filter(|leg| *leg > 0.0).unwrap_or(USUAL_LEG_M);
    let sole_m = |side| {
        let toe = match side {
            Side::Left => JointRole::LeftToeBase,
            Side::Right => JointRole::RightToeBase,
        };
        leg_m * if skeleton.by_role(toe).is_some() { TOE_SHARE } else { ANKLE_SHARE }
    };
    Soles { height_m: Side::BOTH.map(sole_m) }
}

/// Sets a motion on the floor that its own feet stand on, as `measure` finds it. `known` are the
/// soles of the body that is to be seen, where it has some of its own.
///
/// One motion cannot tell a thick sole from a floor that was captured too low. Within reason
/// (0.4 to 2.2 times the usual) the file is believed, and its feet stay as high as they are; beyond,
/// the body gets the usual soles, and the motion is moved up or down to stand on them.
pub fn set_on_floor(skeleton: &Skeleton, motion: Motion, known: Option<Soles>) -> Standing {
    let usual = usual_soles(skeleton);
    let mut motions = [motion];
    let found = calibrate_reported(skeleton, &mut motions);
    let [mut motion] = motions;
    // A foot that never stood tells nothing; the other one's sole is the best guess. Where none
    // did, the lowest toe joint is as high as is found here.
    let [left, right] = found.soles.height_m;
    let seen = contacts_seen(&found.tracks[0].contacts);
    let height_m = match seen {
        [true, true] | [false, false] => [left, right],
        [true, false] => [left; 2],
        [false, true] => [right; 2],
    };
    let mean = |pair: [f32; 2]| 0.5 * (pair[0] + pair[1]);
    let (seen_m, usual_m) = (mean(height_m), mean(usual.height_m));
    let believed = BELIEVED[0] * usual_m..=BELIEVED[1] * usual_m;
    let (lift_m, soles) = match known {
        Some(known) => (mean(known.height_m) - seen_m, known),
        None if believed.contains(&seen_m) => (0.0, Soles { height_m }),
        None => {
            let lift_m = usual_m - seen_m;
            (lift_m, Soles { height_m: height_m.map(|height| height + lift_m) })
        }
    };
    for position in motion.root_positions_m_mut() {
        position.y += lift_m;
    }
    Standing { motion, soles }
}

/// Which feet were ever planted.
fn contacts_seen(frames: &[motion_core::ground::Contacts]) -> [bool; 2] {
    Side::BOTH.map(|side| frames.iter().any(|contacts| contacts.side(side)))
}

#[cfg(test)]
mod tests {
    use motion_core::contacts;

    use super::*;
    use crate::fixture::library;

    /// The lowest that both toe joints ever are.
    fn lowest_toe_m(skeleton: &Skeleton, motion: &Motion) -> f32 {
        let toes = Side::BOTH.into_iter().filter_map(|side| contacts::toe_joint(skeleton, side));
        let lowest = toes.flat_map(|toe| motion.joint_path_m(skeleton, toe)).map(|at| at.y);
        lowest.reduce(f32::min).unwrap_or(0.0)
    }

    fn raised(by_m: f32) -> Standing {
        let library = library();
        let mut motion = library.clips.clips()[0].motion.clone();
        for position in motion.root_positions_m_mut() {
            position.y += by_m;
        }
        set_on_floor(library.clips.skeleton(), motion, None)
    }

    #[test]
    fn soles_are_a_share_of_the_leg() {
        let soles = usual_soles(library().clips.skeleton());
        assert!((soles.height_m[0] - 0.035 * 0.83).abs() < 1e-3, "{soles:?}");
    }

    #[test]
    fn wherever_the_floor_was_feet_come_to_stand_on_theirs() {
        let library = library();
        for by_m in [-0.5, -0.02, 0.0, 0.01, 0.4] {
            let standing = raised(by_m);
            let low_m = lowest_toe_m(library.clips.skeleton(), &standing.motion);
            let sole_m = 0.5 * (standing.soles.height_m[0] + standing.soles.height_m[1]);
            assert!((low_m - sole_m).abs() < 0.05, "{by_m}: toes at {low_m}, soles {sole_m}");
            assert!((0.005..0.08).contains(&sole_m), "{by_m}: {sole_m}");
        }
    }

    #[test]
    fn known_soles_are_stood_on() {
        let library = library();
        let motion = library.clips.clips()[0].motion.clone();
        let known = Soles { height_m: [0.11; 2] };
        let standing = set_on_floor(library.clips.skeleton(), motion, Some(known));
        assert_eq!(standing.soles, known);
        let low_m = lowest_toe_m(library.clips.skeleton(), &standing.motion);
        assert!((low_m - 0.11).abs() < 0.05, "{low_m}");
    }
}
