//! A motion of unknown origin set on the floor, and how high its soles are.

use motion_core::contacts::{self, Side};
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

/// Sets a motion on the floor that its own feet stand on, as `measure` finds it.
///
/// One motion cannot tell a thick sole from a floor that was captured too low. Within reason
/// (0.4 to 2.2 times the usual) the file is believed, and its feet stay as high as they are; beyond,
/// the body gets the usual soles, and the motion is moved up or down to stand on them.
pub fn set_on_floor(skeleton: &Skeleton, motion: Motion) -> Standing {
    let usual = usual_soles(skeleton);
    let mut motions = [motion];
    let found = calibrate_reported(skeleton, &mut motions);
    let [mut motion] = motions;
    let seen = contacts_seen(&found.tracks[0].contacts);
    // A foot that never stood tells nothing; the other one's sole is the best guess.
    let height_m = match (seen, found.soles.height_m) {
        ([true, true], both) => both,
        ([true, false], [left, _]) => [left; 2],
        ([false, true], [_, right]) => [right; 2],
        ([false, false], _) => return Standing { motion, soles: usual },
    };
    let mean = |pair: [f32; 2]| 0.5 * (pair[0] + pair[1]);
    let (seen_m, usual_m) = (mean(height_m), mean(usual.height_m));
    // The lowest a sole is ever reported is 0: then the floor was below the toe joints' lowest.
    if (BELIEVED[0] * usual_m..=BELIEVED[1] * usual_m).contains(&seen_m) {
        return Standing { motion, soles: Soles { height_m } };
    }
    for position in motion.root_positions_m_mut() {
        position.y += usual_m - seen_m;
    }
    Standing { motion, soles: Soles { height_m: height_m.map(|h| h + usual_m - seen_m) } }
}

/// Which feet were ever planted.
fn contacts_seen(frames: &[motion_core::ground::Contacts]) -> [bool; 2] {
    Side::BOTH.map(|side| frames.iter().any(|contacts| contacts.side(side)))
}

/// The lowest that both toe joints ever are, metres; 0 without feet. A look at how a motion stands
/// that needs no plants.
pub fn lowest_toe_m(skeleton: &Skeleton, motion: &Motion) -> f32 {
    let toes = Side::BOTH.into_iter().filter_map(|side| contacts::toe_joint(skeleton, side));
    let lowest = toes.flat_map(|toe| motion.joint_path_m(skeleton, toe)).map(|at| at.y);
    lowest.reduce(f32::min).unwrap_or(0.0)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::fixture::library;

    fn raised(by_m: f32) -> Standing {
        let library = library();
        let mut motion = library.clips.clips()[0].motion.clone();
        for position in motion.root_positions_m_mut() {
            position.y += by_m;
        }
        set_on_floor(library.clips.skeleton(), motion)
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
}
