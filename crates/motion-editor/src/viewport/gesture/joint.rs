//! Targets pulled from joints.

use egui::{Align2, Pos2, Stroke, Ui};
use glam::Vec3;
use motion_core::skeleton::JointRole;
use motion_scene::color::ColorRole;
use motion_session::ConstraintKind;
use motion_session::command::Command;
use motion_session::document::{CharacterIdx, ConstraintRef};
use motion_session::selection::Selectable;

use super::sight::Sight;
use super::snap::{HEIGHT_GRID_M, snapped};
use crate::state::EditorState;
use crate::state::moving::{Moving, rounded};
use crate::theme;

/// A joint further from the pointer than this is not meant, points.
const REACH_PT: f32 = 36.0;

/// The joint that the pointer means.
#[derive(Clone, Debug, PartialEq)]
pub struct AimedJoint {
    /// Whose.
    pub character: CharacterIdx,
    /// Its role where it has one, else its name.
    pub name: String,
    /// Where it is.
    pub at_m: Vec3,
    /// Where that is in the window.
    pub place: Pos2,
}

/// The joint of the shown takes that is nearest to the pointer.
pub fn aim(state: &EditorState, sight: &Sight, pointer: Pos2) -> Option<AimedJoint> {
    let mut nearest: Option<(f32, AimedJoint)> = None;
    for (nth, actor) in state.stage.actors.iter().enumerate() {
        let joints = actor.body_at(state.frame(), actor.look).world_from_joint;
        let roles = actor.skeleton.roles();
        for role in JointRole::ALL {
            let Some(joint) = roles.joint(*role) else { continue };
            let Some(world) = joints.get(joint.idx()) else { continue };
            let at_m = world.w_axis.truncate();
            let Some(place) = sight.place(at_m) else { continue };
            let distance = place.distance(pointer);
            if distance < REACH_PT && nearest.as_ref().is_none_or(|(best, _)| distance < *best) {
                let (character, name) = (CharacterIdx(nth), role.name().to_owned());
                nearest = Some((distance, AimedJoint { character, name, at_m, place }));
            }
        }
    }
    nearest.map(|(_, joint)| joint)
}

/// The dot and the name of the joint that is meant.
pub fn aimed_ui(ui: &Ui, joint: &AimedJoint) {
    let palette = theme::of(ui);
    let color = theme::role(ColorRole::JointTarget, palette.theme);
    let painter = ui.painter();
    painter.circle(joint.place, 5.0, color, Stroke::new(1.5, palette.base));
    painter.circle_stroke(joint.place, 9.0, Stroke::new(1.5, color));
    let words = spaced(&joint.name);
    super::plate_ui(ui, joint.place + egui::Vec2::new(15.0, -13.0), Align2::LEFT_CENTER, &words);
}

/// `LeftHand` as people write it: `Left hand`.
pub fn spaced(role: &str) -> String {
    let mut words = String::new();
    for letter in role.chars() {
        if letter.is_uppercase() && !words.is_empty() {
            words.push(' ');
            words.extend(letter.to_lowercase());
        } else {
            words.push(letter);
        }
    }
    words
}

/// A target on its way.
#[derive(Clone, Debug)]
pub struct Pull {
    what: Pulled,
    from_m: Vec3,
    grabbed: Pos2,
    /// Whether it goes straight up and down by itself.
    is_vertical: bool,
}

#[derive(Clone, Debug)]
enum Pulled {
    /// One that is made.
    New { character: CharacterIdx, frame: u32, joint: String },
    /// Some that are there.
    Known(Moving),
}

impl Pull {
    /// Pulls a new target from a joint.
    pub fn new(joint: AimedJoint, grabbed: Pos2, state: &mut EditorState) -> Self {
        let AimedJoint { character, name, at_m, .. } = joint;
        if state.session.active() != character {
            state.session.set_active(character);
            state.refresh();
        }
        state.begin_gesture("Add joint target");
        let is_vertical = name == JointRole::Head.name();
        let frame = state.frame_number() as u32;
        let what = Pulled::New { character, frame, joint: name };
        Self { what, from_m: at_m, grabbed, is_vertical }
    }

    /// Pulls a target that is there, with everything that is selected with it.
    pub fn known(at: &ConstraintRef, grabbed: Pos2, state: &mut EditorState) -> Option<Self> {
        let kind = state.session.document().constraint(at)?.kind.clone();
        let ConstraintKind::Joint { joint, position_m, .. } = kind else { return None };
        if !state.is_selected(at) {
            state.session.selection_mut().select(Selectable::Constraint(at.clone()));
        }
        let document = state.session.document();
        let moving = Moving::of(document, state.session.selection().constraints(document));
        state.begin_gesture("Move joint target");
        let is_vertical = joint == JointRole::Head.name();
        let from_m = Vec3::from_array(position_m.map(|x| x as f32));
        Some(Self { what: Pulled::Known(moving), from_m, grabbed, is_vertical })
    }

    /// What brings the target to the pointer. `is_turned_over`: up and down where it went in the
    /// plane of the picture, and the other way round.
    pub fn commands(
        &self,
        sight: &Sight,
        pointer: Pos2,
        is_turned_over: bool,
        is_snapping: bool,
        state: &EditorState,
    ) -> Vec<Command> {
        let is_vertical = self.is_vertical != is_turned_over;
        let to_m = sight.dragged(self.from_m, (self.grabbed, pointer), is_vertical);
        let from = self.from_m.to_array().map(f64::from);
        let mut to = to_m.to_array().map(f64::from);
        for axis in if is_vertical { 1..2 } else { 0..3 } {
            to[axis] = snapped(to[axis], HEIGHT_GRID_M, is_snapping);
        }
        // Nobody reaches below the floor.
        to[1] = to[1].max(0.0);
        match &self.what {
            Pulled::New { character, frame, joint } => {
                let position_m = to.map(rounded);
                let (character, frame) = (*character, *frame);
                let joint = joint.clone();
                let mut commands = vec![Command::AddJointTarget {
                    character,
                    frame,
                    joint,
                    position_m,
                    velocity_m_s: None,
                }];
                commands.extend(state.length_for(frame));
                commands
            }
            Pulled::Known(moving) => moving.moved([0, 1, 2].map(|axis| to[axis] - from[axis])),
        }
    }

    /// Whether something new is made.
    pub fn is_new(&self) -> bool {
        matches!(self.what, Pulled::New { .. })
    }
}

#[cfg(test)]
mod tests {
    #[test]
    fn roles_are_written_as_words() {
        for (role, expected) in
            [("Head", "Head"), ("LeftHand", "Left hand"), ("RightToeBase", "Right toe base")]
        {
            assert_eq!(super::spaced(role), expected);
        }
    }
}
