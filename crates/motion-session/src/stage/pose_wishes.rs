//! Pose constraints as outlined ghosts: a body as a frame of a clip has it, where it is asked for.

use glam::{Mat4, Vec2, Vec3};
use motion_core::planar::PlanarTransform;
use motion_io::report_file::ConstraintReport;
use motion_scene::body::{Body, GHOST_ALPHA, Look};
use motion_scene::color::{ColorRole, Theme};
use motion_scene::label::{Anchor, LABEL_PT, Label, LabelPlace};
use motion_scene::line::Occlusion;
use motion_scene::mesh::MeshId;

use super::pick::{PickTarget, Picks};
use super::pose::pose_at;
use super::wishes;
use crate::live::ReadyLibrary;

/// A body in a pose that somebody asks for.
#[derive(Clone, Debug, PartialEq)]
pub struct PoseWish {
    /// Which of the character's constraints.
    pub constraint: usize,
    /// Its id.
    pub id: String,
    /// When.
    pub frame: u32,
    /// `clip:frame`, as people write it.
    pub source: String,
    /// What the body looks like.
    pub mesh: MeshId,
    /// Where every joint is.
    pub world_from_joint: Vec<Mat4>,
    /// The middle of the highest joint, metres: words stand above it.
    pub top_m: Vec3,
}

/// Over the highest joint, metres.
const OVER_HEAD_M: f32 = 0.2;

/// Every joint of a body as it is in a frame of a clip, its torso brought to `at_m` (x, z) and to
/// look along `heading_rad`; what is left out stays as the clip has it. A frame past the end is the
/// last. `None` where the library has no such clip.
pub fn placed_pose(
    ready: &ReadyLibrary,
    clip: &str,
    frame: u32,
    at_m: Option<Vec2>,
    heading_rad: Option<f32>,
) -> Option<Vec<Mat4>> {
    let clips = &ready.library.clips;
    let clip = clips.clip(clips.by_id(clip)?);
    let frame = (frame as usize).min(clip.n_frames().checked_sub(1)?);
    let from = *clip.track.world_from_torso.get(frame)?;
    let to = PlanarTransform::new(
        heading_rad.unwrap_or(from.heading_rad()),
        at_m.unwrap_or(from.ground_m()),
        from.translation_m().y,
    );
    let turn = Mat4::from_quat(to.rotation() * from.rotation().inverse());
    let placed = Mat4::from_translation(to.translation_m())
        * turn
        * Mat4::from_translation(-from.translation_m());
    let joints = pose_at(&ready.skeleton, &clip.motion, frame as f64);
    Some(joints.into_iter().map(|world| placed * world).collect())
}

/// Where the torso of a clip's frame is and looks, as [`placed_pose`] counts it: `(x, z)` and
/// radians.
pub fn place_in_clip(ready: &ReadyLibrary, clip: &str, frame: u32) -> Option<(Vec2, f32)> {
    let clips = &ready.library.clips;
    let clip = clips.clip(clips.by_id(clip)?);
    let frame = (frame as usize).min(clip.n_frames().checked_sub(1)?);
    let torso = clip.track.world_from_torso.get(frame)?;
    Some((torso.ground_m(), torso.heading_rad()))
}

/// The highest of a body's joints.
pub fn top_of_m(world_from_joint: &[Mat4]) -> Vec3 {
    let joints = world_from_joint.iter().map(|world| world.w_axis.truncate());
    joints.reduce(|top, at| if at.y > top.y { at } else { top }).unwrap_or_default()
}

impl PoseWish {
    /// Its ghost with an outline's colour of its own, and its words: `Walk:40 · f 80 · miss 4 cm`.
    pub(super) fn staged(
        &self,
        character: usize,
        misses: &[ConstraintReport],
        theme: Theme,
        picks: &mut Picks,
    ) -> (Body, Label) {
        let color = ColorRole::Pose.color(theme);
        // Denser than other times of the motion: it is asked for, not only shown.
        let look = Look::Ghost(color.with_alpha(1.6 * GHOST_ALPHA));
        let mut body = Body::new(self.mesh, self.world_from_joint.clone(), look);
        body.pick = picks.name(PickTarget::Pose { character, constraint: self.constraint });
        let miss = misses.iter().find(|miss| miss.constraint == self.id);
        let label = Label {
            text: format!("{} · f {}{}", self.source, self.frame, wishes::miss_text(miss)),
            place: LabelPlace::World(self.top_m + Vec3::Y * OVER_HEAD_M),
            anchor: Anchor::Below,
            clear_m: 0.0,
            occlusion: Occlusion::Shown,
            size_pt: LABEL_PT,
            color: ColorRole::Text.color(theme),
            plate: Some(ColorRole::TextPlate.color(theme).with_alpha(0.82)),
        };
        (body, label)
    }
}
