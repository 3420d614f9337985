//! Meetings of characters: everybody's pose at the place where he is to stand, and who belongs
//! together.

use glam::{Mat4, Vec2, Vec3};
use motion_core::ground::GroundTrack;
use motion_core::motion::Motion;
use motion_core::planar::PlanarTransform;
use motion_io::project_file::{Interaction, Placement};
use motion_scene::body::{Body, GHOST_ALPHA, Look};
use motion_scene::color::{ColorRole, Theme};
use motion_scene::label::{Anchor, LABEL_PT, Label, LabelPlace};
use motion_scene::line::{Line, Occlusion};
use motion_scene::mesh::MeshId;
use motion_scene::scene::Scene;

use super::pick::{PickTarget, Picks};

/// A meeting as it is to be seen.
#[derive(Clone, Debug, PartialEq)]
pub struct MeetingWish {
    /// Its place among the project's.
    pub interaction: usize,
    /// When.
    pub frame: u32,
    /// Who, in order.
    pub names: Vec<String>,
    /// Where everybody is to stand.
    pub places: Vec<PlanarTransform>,
    /// What bodies look like, and where every joint of every member is; nothing for who has no body
    /// in a pose yet.
    pub bodies: Vec<(MeshId, Option<Vec<Mat4>>)>,
}

/// Over the floor, so that lines do not fight with it for the same depth, metres.
const LIFT_M: f32 = 0.006;

/// Where members stand in the world, when the first stands at `anchor`.
pub fn placed(relative: &[Placement], anchor: PlanarTransform) -> Vec<PlanarTransform> {
    let local: Vec<PlanarTransform> = relative.iter().map(transform_of).collect();
    let Some(first) = local.first().copied() else { return Vec::new() };
    let world_from_common = anchor * first.inverse();
    local.into_iter().map(|member| world_from_common * member).collect()
}

/// A placement as a transform.
pub fn transform_of(placement: &Placement) -> PlanarTransform {
    let [x, z] = placement.position_m;
    let heading_rad = placement.heading_deg.to_radians() as f32;
    PlanarTransform::new(heading_rad, Vec2::new(x as f32, z as f32), 0.0)
}

/// Where a motion's body is and looks at a frame; its last where it is over.
pub fn torso_at(motion: &Motion, frame: u32) -> Option<PlanarTransform> {
    let levels = vec![0.0; motion.n_frames()];
    let track = GroundTrack::new(motion, &levels, Vec::new());
    let torsos = &track.world_from_torso;
    torsos.get(frame as usize).or(torsos.last()).copied()
}

/// What members are called together: `A meets B`.
pub fn title(interaction: &Interaction) -> String {
    let names: Vec<&str> = interaction.members.iter().map(|m| m.character.as_str()).collect();
    names.join(" meets ")
}

impl MeetingWish {
    /// Puts it on the stage.
    pub(super) fn add_to(&self, scene: &mut Scene, theme: Theme, picks: &mut Picks) {
        let color = ColorRole::Pose.color(theme);
        for (member, (mesh, joints)) in self.bodies.iter().enumerate() {
            let Some(joints) = joints else { continue };
            let look = Look::Ghost(color.with_alpha(1.6 * GHOST_ALPHA));
            let mut body = Body::new(*mesh, joints.clone(), look);
            let interaction = self.interaction;
            body.pick = picks.name(PickTarget::Meeting { interaction, member });
            scene.bodies.push(body);
        }
        let on_floor = |place: &PlanarTransform| place.translation_m().with_y(LIFT_M);
        let points_m: Vec<Vec3> = self.places.iter().map(on_floor).collect();
        let interaction = self.interaction;
        let pick = picks.name(PickTarget::Meeting { interaction, member: 0 });
        let dots = points_m.iter().map(|at| Line::new(vec![*at], color, 8.0));
        scene.lines.extend(dots.map(|dot| Line { pick, ..dot }));
        let n = points_m.len().max(1) as f32;
        let middle_m = points_m.iter().sum::<Vec3>() / n;
        scene.lines.push(Line { pick, ..Line::new(points_m, color, 2.0) });
        scene.labels.push(Label {
            text: format!("{} · f {}", self.names.join(" meets "), self.frame),
            place: LabelPlace::World(middle_m),
            anchor: Anchor::Below,
            clear_m: 0.0,
            occlusion: Occlusion::Shown,
            size_pt: LABEL_PT,
            color: ColorRole::Text.color(theme),
            plate: Some(ColorRole::TextPlate.color(theme).with_alpha(0.82)),
        });
    }
}

#[cfg(test)]
mod tests {
    use std::f32::consts::{FRAC_PI_2, PI};

    use super::*;

    #[test]
    fn members_stand_to_each_other_as_asked_wherever_the_first_is() {
        let at = |x: f64, z: f64, heading_deg: f64| Placement {
            position_m: [x, z],
            heading_deg,
            extra: Default::default(),
        };
        // The second a metre ahead of the first and looking at him, in a frame of their own.
        let relative = [at(5.0, 5.0, 0.0), at(5.0, 6.0, 180.0)];
        let anchor = PlanarTransform::new(FRAC_PI_2, Vec2::new(2.0, 0.0), 0.0);
        let [first, second] = placed(&relative, anchor)[..] else { panic!("two members") };
        assert!(first.ground_m().distance(Vec2::new(2.0, 0.0)) < 1e-5);
        // Ahead of who looks along +X is +X.
        assert!(second.ground_m().distance(Vec2::new(3.0, 0.0)) < 1e-5, "{second:?}");
        let turn = (second.heading_rad() - first.heading_rad()).rem_euclid(2.0 * PI);
        assert!((turn - PI).abs() < 1e-5);
    }
}
