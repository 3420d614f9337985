//! How the members of a meeting stand to the first of them.

use glam::{Vec2, Vec3};
use motion_core::planar::PlanarTransform;
use motion_session::command::Command;
use motion_session::stage::meeting_wishes::transform_of;
use motion_session::{Interaction, Member, Placement};

use crate::state::moving::{rounded, wrapped_deg};

/// Where a member stands as the first sees it, metres ahead and to the left, and by how much it is
/// turned from how the first looks, degrees.
pub fn beside_first(interaction: &Interaction, member: usize) -> ([f64; 2], f64) {
    let place = |nth: usize| interaction.relative.get(nth).map(transform_of).unwrap_or_default();
    let seen = place(0).inverse() * place(member);
    // X is to the left of who looks along Z.
    let at = seen.ground_m();
    let heading_deg = wrapped_deg(f64::from(seen.heading_rad().to_degrees()));
    ([rounded(f64::from(at.y)), rounded(f64::from(at.x))], heading_deg)
}

/// The meeting with a member elsewhere beside the first; nothing where there is no such member.
pub fn with_beside(
    interaction: &Interaction,
    member: usize,
    [ahead_m, left_m]: [f64; 2],
    heading_deg: f64,
) -> Option<Command> {
    let first = interaction.relative.first().map(transform_of)?;
    let at = Vec2::new(left_m as f32, ahead_m as f32);
    let beside = PlanarTransform::new(heading_deg.to_radians() as f32, at, 0.0);
    let place = first * beside;
    let mut relative = interaction.relative.clone();
    let known = relative.get_mut(member)?;
    let at = place.ground_m();
    known.position_m = [rounded(f64::from(at.x)), rounded(f64::from(at.y))];
    known.heading_deg = wrapped_deg(f64::from(place.heading_rad().to_degrees()));
    Some(changed(interaction, interaction.frame, interaction.members.clone(), relative))
}

/// The meeting at another frame, with other members or places.
pub fn changed(
    interaction: &Interaction,
    frame: u32,
    members: Vec<Member>,
    relative: Vec<Placement>,
) -> Command {
    Command::ChangeInteraction { id: interaction.id.clone(), frame, members, relative }
}

/// A place on the floor as somebody there sees it, metres ahead and to the left.
pub fn seen_from(torso: PlanarTransform, at_m: [f64; 2]) -> [f64; 2] {
    let at = torso.inverse().apply(Vec3::new(at_m[0] as f32, 0.0, at_m[1] as f32));
    [f64::from(at.z), f64::from(at.x)]
}

#[cfg(test)]
mod tests {
    use super::*;

    fn meeting() -> Interaction {
        let member = |character: &str| Member {
            character: character.to_owned(),
            clip: "walk".to_owned(),
            clip_frame: 0,
            extra: Default::default(),
        };
        let at = |x: f64, z: f64, heading_deg: f64| Placement {
            position_m: [x, z],
            heading_deg,
            extra: Default::default(),
        };
        Interaction {
            id: "interaction-1".to_owned(),
            frame: 40,
            weight: None,
            members: vec![member("A"), member("B")],
            relative: vec![at(2.0, 1.0, 90.0), at(3.0, 1.0, -90.0)],
            extra: Default::default(),
        }
    }

    #[test]
    fn members_are_seen_by_the_first() {
        let meeting = meeting();
        assert_eq!(beside_first(&meeting, 1), ([1.0, 0.0], 180.0), "a metre ahead, face to face");
        let moved = with_beside(&meeting, 1, [2.0, 0.5], 90.0);
        let Some(Command::ChangeInteraction { relative, frame: 40, .. }) = moved else {
            panic!("{moved:?}")
        };
        // To the left of who looks along +X is −Z.
        assert_eq!((relative[1].position_m, relative[1].heading_deg), ([4.0, 0.5], 180.0));
        assert_eq!(with_beside(&meeting, 7, [0.0, 0.0], 0.0), None);
    }

    #[test]
    fn places_are_seen_from_where_somebody_stands() {
        let torso = PlanarTransform::new(std::f32::consts::FRAC_PI_2, Vec2::new(1.0, 0.0), 0.0);
        let [ahead, left] = seen_from(torso, [3.0, -1.0]);
        assert!((ahead - 2.0).abs() < 1e-5 && (left - 1.0).abs() < 1e-5, "{ahead} {left}");
    }
}
