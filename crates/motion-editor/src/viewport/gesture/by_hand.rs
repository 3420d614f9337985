//! Hands and feet of the shown take moved, and its other joints turned.

use egui::{Pos2, Stroke, Ui, Vec2};
use glam::{Quat, Vec3};
use motion_core::by_hand::{Limb, Space};
use motion_core::rotation;
use motion_core::skeleton::Skeleton;
use motion_scene::camera::OrbitCamera;
use motion_scene::color::ColorRole;
use motion_session::command::Command;
use motion_session::document::by_hand::{MAX_SHIFT_M, MAX_TURN_DEG};
use motion_session::document::{HandChange, HandEdit, StoredTake};

use super::joint::AimedJoint;
use super::sight::Sight;
use crate::state::EditorState;
use crate::theme;

/// A turn follows the pointer by so much a point: half a turn in the width of a hand.
const RAD_PER_PT: f32 = 0.01;

/// A hand, a foot or a joint on its way.
#[derive(Clone, Debug)]
pub struct HandPull {
    what: Pulled,
    grabbed: Pos2,
    /// The take, as it was when it was grabbed: the search may show another one meanwhile.
    take: StoredTake,
    /// The edit that is changed; none where one is made.
    id: Option<String>,
    edit: HandEdit,
}

#[derive(Clone, Copy, Debug)]
enum Pulled {
    /// Moved from here.
    Limb { from_m: Vec3, before_m: Vec3, world_from_shift: Quat },
    /// Turned from this attitude in the world, in which it is turned by so much already.
    Joint { world_from_joint: Quat, before_rad: Vec3 },
}

/// The hand or foot that is the end of a limb of that name.
pub fn limb_of(name: &str, skeleton: &Skeleton) -> Option<Limb> {
    Limb::ALL.into_iter().find(|limb| limb.end_role().name() == name && limb.is_on(skeleton))
}

impl HandPull {
    /// Grabs a joint of the shown take; the edit that is fully there at the playhead is changed,
    /// and where there is none one is made.
    pub fn begin(joint: &AimedJoint, grabbed: Pos2, state: &mut EditorState) -> Option<Self> {
        if state.session.active() != joint.character {
            state.activate(joint.character);
        }
        if state.is_playing() {
            state.stop();
        }
        let actor = state.stage.actors.get(joint.character.0)?.clone();
        let take = state.hand_take()?;
        let limb = limb_of(&joint.name, &actor.skeleton);
        let new = match limb {
            Some(limb) => HandChange::Hand { limb, shift_m: [0.0; 3], space: Space::World },
            None => HandChange::Joint { joint: joint.name.clone(), turn_deg: [0.0; 3] },
        };
        let known = state.edit_at(&new, state.hand_frame());
        let known = known.map(|(id, edit)| (id.to_owned(), edit.clone()));
        let (id, edit) = match known {
            Some((id, edit)) => (Some(id), edit),
            None => (None, state.new_edit(new)),
        };
        let what = match &edit.change {
            HandChange::Hand { shift_m, space, .. } => {
                let world_from_shift = match space {
                    Space::World => Quat::IDENTITY,
                    Space::Torso => state.heading_by_hand(),
                };
                let before_m = Vec3::from_array(shift_m.map(|x| x as f32));
                Pulled::Limb { from_m: joint.at_m, before_m, world_from_shift }
            }
            HandChange::Joint { turn_deg, .. } => {
                let index = actor.skeleton.find(&joint.name)?;
                let body = actor.body_at(state.frame(), actor.look);
                let world = body.world_from_joint.get(index.idx())?;
                let world_from_joint = world.to_scale_rotation_translation().1;
                let before_rad = Vec3::from_array(turn_deg.map(|deg| deg.to_radians() as f32));
                Pulled::Joint { world_from_joint, before_rad }
            }
        };
        state.begin_gesture("Change by hand");
        let layer = take.by_hand.clone().unwrap_or_default();
        state.select_edit(id.clone().unwrap_or_else(|| layer.next_id(edit.change.kind())));
        Some(Self { what, grabbed, take, id, edit })
    }

    /// What brings it to the pointer; a hand straight up and down where `is_vertical`.
    pub fn commands(&self, sight: &Sight, pointer: Pos2, is_vertical: bool) -> Vec<Command> {
        let mut edit = self.edit.clone();
        match (&mut edit.change, self.what) {
            (
                HandChange::Hand { shift_m, .. },
                Pulled::Limb { from_m, before_m, world_from_shift },
            ) => {
                let way = (self.grabbed, pointer);
                let by_m = sight.dragged(from_m, way, is_vertical) - from_m;
                let shift = before_m + world_from_shift.inverse() * by_m;
                // What is farther than anybody reaches goes on in the direction of the wish.
                let shift = shift.clamp_length_max(MAX_SHIFT_M as f32 * 0.999);
                *shift_m = shift.to_array().map(to_tenth_mm);
            }
            (
                HandChange::Joint { turn_deg, .. },
                Pulled::Joint { world_from_joint, before_rad },
            ) => {
                let by = turned(&sight.camera, pointer - self.grabbed);
                let turn = turn_after(by, world_from_joint, before_rad);
                let most = (MAX_TURN_DEG as f32).to_radians() * 0.999;
                let turn = turn.clamp_length_max(most);
                *turn_deg = turn.to_array().map(|rad| to_hundredth(rad.to_degrees()));
            }
            _ => {}
        }
        let take = self.take.clone();
        vec![match &self.id {
            Some(id) => Command::ChangeByHand { take, id: id.clone(), edit },
            None => Command::AddByHand { take, edit },
        }]
    }
}

/// A ball that the pointer rolls: across about what is up in the picture, up and down about what is
/// to its right. What is nearest to the eye goes with the pointer.
fn turned(camera: &OrbitCamera, by_pt: Vec2) -> Quat {
    let world_from_view = camera.world_from_view_rotation();
    let about = Vec3::new(by_pt.y, by_pt.x, 0.0) * RAD_PER_PT;
    rotation::exp(world_from_view * about)
}

/// The turn in a joint's own frame that has it, turned by `before_rad` and so at
/// `world_from_joint`, turned by `by` in the world: `exp(turn) = exp(before) · q⁻¹ · by · q`.
fn turn_after(by: Quat, world_from_joint: Quat, before_rad: Vec3) -> Vec3 {
    let in_joint = world_from_joint.inverse() * by * world_from_joint;
    rotation::log(rotation::exp(before_rad) * in_joint)
}

fn to_tenth_mm(metres: f32) -> f64 {
    (f64::from(metres) * 1e4).round() / 1e4 + 0.0
}

fn to_hundredth(value: f32) -> f64 {
    (f64::from(value) * 100.0).round() / 100.0 + 0.0
}

/// Small dots on what can be moved, so that the tool shows what it is for.
pub fn handles_ui(ui: &Ui, sight: &Sight, state: &EditorState) {
    let active = state.session.active().0;
    let Some(actor) = state.stage.actors.get(active) else { return };
    let palette = theme::of(ui);
    let color = theme::role(ColorRole::JointTarget, palette.theme);
    let joints = actor.body_at(state.frame(), actor.look).world_from_joint;
    for limb in Limb::ALL.into_iter().filter(|limb| limb.is_on(&actor.skeleton)) {
        let joint = actor.skeleton.by_role(limb.end_role());
        let world = joint.and_then(|joint| joints.get(joint.idx()));
        let place = world.and_then(|world| sight.place(world.w_axis.truncate()));
        let Some(place) = place.filter(|place| sight.rect.contains(*place)) else { continue };
        ui.painter().circle(place, 3.5, color, Stroke::new(1.0, palette.base));
    }
}

#[cfg(test)]
mod tests {
    use motion_scene::camera::StandardView;

    use super::*;

    #[test]
    fn what_is_near_the_eye_goes_with_the_pointer() {
        for view in [StandardView::Front, StandardView::Left, StandardView::ThreeQuarter] {
            let camera = OrbitCamera::standard(view, Vec3::ZERO, 5.0);
            let view = camera.world_from_view_rotation();
            let near = view * Vec3::Z;
            for by in [Vec2::new(20.0, 0.0), Vec2::new(0.0, 20.0), Vec2::new(-10.0, 30.0)] {
                let moved = view.inverse() * (turned(&camera, by) * near - near);
                assert!(moved.x * by.x >= 0.0 && moved.y * by.y <= 0.0, "{by:?}: {moved}");
                assert!((moved.truncate().length() - by.length() * RAD_PER_PT).abs() < 0.01);
            }
        }
    }

    #[test]
    fn a_turn_is_that_of_the_world_in_the_joints_own_frame() {
        let base = rotation::exp(Vec3::new(0.3, -1.2, 0.5));
        let before_rad = Vec3::new(0.1, 0.4, -0.2);
        let now = base * rotation::exp(before_rad);
        let by = rotation::exp(Vec3::new(-0.5, 0.2, 0.7));
        let after = base * rotation::exp(turn_after(by, now, before_rad));
        assert!(rotation::angle_between_rad(after, by * now) < 1e-4);
    }
}
