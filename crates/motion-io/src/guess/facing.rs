//! Where the rest pose looks, from its hips and back.

use glam::{Mat3, Quat, Vec3};
use motion_core::skeleton::{JointRole, Skeleton};

use super::Guess;

/// A rest pose within this of standing along the axes is taken to stand along them: hips and
/// backs are never quite straight.
const SNAP_RAD: f32 = 0.5;

/// Joints that are closer than this share of the body are at one place.
const APART_SHARE: f32 = 0.01;

/// The turn that makes the rest pose stand along +Y and look along +Z, with its left at +X.
///
/// Up is from the hips to the neck, left from the right thigh (or arm) to the left one. Unsure
/// (and no turn) where these are not recognised.
pub fn canonical_from_rest(skeleton: &Skeleton) -> Guess<Quat> {
    use JointRole::{
        Head, Hips, LeftArm, LeftUpLeg, Neck, RightArm, RightUpLeg, Spine, Spine1, Spine2,
    };
    let positions = skeleton.rest_positions_m();
    let at = |role| skeleton.by_role(role).map(|joint| positions[joint.idx()]);
    let hips = at(Hips).unwrap_or(positions[0]);
    let direction = |a: Option<Vec3>, b: Option<Vec3>| (a? - b?).try_normalize();

    let up = [Neck, Head, Spine2, Spine1, Spine]
        .into_iter()
        .find_map(|role| direction(at(role), Some(hips)));
    // Thighs that begin at one point say nothing, whatever their last digits.
    let are_apart = |a: Option<Vec3>, b: Option<Vec3>| {
        let size = positions.iter().map(|at| at.distance(hips)).fold(0.0, f32::max);
        a.zip(b).is_some_and(|(a, b)| a.distance(b) > APART_SHARE * size)
    };
    let thighs = (at(LeftUpLeg), at(RightUpLeg));
    let left = direction(thighs.0, thighs.1)
        .filter(|_| are_apart(thighs.0, thighs.1))
        .or_else(|| direction(at(LeftArm), at(RightArm)));
    let unsure = Guess { value: Quat::IDENTITY, sure: false };
    let (Some(up), Some(left)) = (up, left) else { return unsure };
    let Some(left) = left.reject_from_normalized(up).try_normalize() else { return unsure };
    let rest_from_canonical = Mat3::from_cols(left, up, left.cross(up));
    let exact = Quat::from_mat3(&rest_from_canonical.transpose());
    let nearest = right_angled()
        .into_iter()
        .min_by(|a, b| exact.angle_between(*a).total_cmp(&exact.angle_between(*b)));
    let value = nearest.filter(|turn| exact.angle_between(*turn) < SNAP_RAD).unwrap_or(exact);
    Guess { value, sure: true }
}

/// The 24 turns that bring axes to axes; the first is exactly none.
fn right_angled() -> Vec<Quat> {
    let quarter = std::f32::consts::FRAC_PI_2;
    let tilts = [
        Quat::IDENTITY,
        Quat::from_rotation_x(quarter),
        Quat::from_rotation_x(-quarter),
        Quat::from_rotation_x(2.0 * quarter),
        Quat::from_rotation_z(quarter),
        Quat::from_rotation_z(-quarter),
    ];
    tilts
        .into_iter()
        .flat_map(|tilt| {
            (0..4).map(move |turns| {
                if turns == 0 { tilt } else { Quat::from_rotation_y(turns as f32 * quarter) * tilt }
            })
        })
        .collect()
}

#[cfg(test)]
mod tests {
    use motion_core::rotation::angle_between_rad;

    use super::*;
    use crate::guess::test_body::{body, turned};

    #[test]
    fn a_pose_that_faces_z_is_left_alone() {
        assert_eq!(canonical_from_rest(&body(1.0)), Guess { value: Quat::IDENTITY, sure: true });
        let leaning = turned(&body(1.0), Quat::from_rotation_x(0.2));
        assert_eq!(canonical_from_rest(&leaning).value, Quat::IDENTITY);
    }

    #[test]
    fn every_right_angled_pose_is_brought_back() {
        let turns = right_angled();
        assert_eq!(turns.len(), 24);
        for turn in turns {
            let found = canonical_from_rest(&turned(&body(1.0), turn.inverse())).value;
            assert!(angle_between_rad(found, turn) < 1e-3, "{turn}: {found}");
        }
    }

    #[test]
    fn an_oblique_pose_is_turned_exactly() {
        let turn = Quat::from_rotation_y(0.7);
        let found = canonical_from_rest(&turned(&body(1.0), turn.inverse())).value;
        // The test body's neck is 0.02 rad before its hips.
        assert!(angle_between_rad(found, turn) < 0.03, "{found}");
    }
}
