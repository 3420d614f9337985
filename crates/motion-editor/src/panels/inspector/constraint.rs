//! The fields of a constraint: every value of every kind can be typed.

use egui::{Button, Ui};
use motion_core::skeleton::JointRole;
use motion_scene::color::ColorRole;
use motion_session::ConstraintKind;
use motion_session::command::Command as C;
use motion_session::document::ConstraintRef;

use super::field::{
    Number, choice_row_ui, colored_line_ui, line_ui, number_row_ui, parts_row_ui, text_row_ui,
    tick_row_ui,
};
use super::heading_ui;
use super::path::{PathFields, path_ui};
use super::pick_row::pick_row_ui;
use super::tolerance::tolerance_ui;
use super::velocity::velocity_ui;
use crate::mark::Mark;
use crate::state::EditorState;
use crate::state::moving::rounded;
use crate::theme;
use crate::viewport::gesture::joint::spaced;

/// Everything that can be said of a constraint.
pub(super) fn constraint_ui(ui: &mut Ui, mark: &Mark, state: &mut EditorState) {
    let palette = theme::of(ui);
    heading_ui(ui, &mark.title(), "");
    let miss = if mark.is_off() { ColorRole::Miss } else { ColorRole::Text };
    let miss = theme::role(miss, palette.theme);
    colored_line_ui(ui, "Shown take", &mark.miss_text(), miss);
    let at = &mark.at;
    match &mark.constraint.kind {
        ConstraintKind::Body { frame, position_m, heading_deg, height_m } => {
            frame_ui(ui, at, *frame, state);
            place_ui(ui, at, *position_m, state);
            heading_row_ui(ui, at, *heading_deg, state);
            height_ui(ui, at, *height_m, state);
        }
        ConstraintKind::Joint { frame, joint, position_m, velocity_m_s } => {
            if let Some(joint) = pick_row_ui(ui, "Joint", joint, &joints(state)) {
                state.apply(&C::SetJoint { at: at.clone(), joint });
            }
            frame_ui(ui, at, *frame, state);
            let parts = [("x ", "x"), ("y ", "y (height)"), ("z ", "z")]
                .map(|(letter, name)| (letter, Number { unit: "", ..Number::metres(name) }));
            parts_row_ui(ui, "Place, m", parts, *position_m, state, |position_m| {
                vec![C::MoveJointTarget { at: at.clone(), position_m }]
            });
            velocity_ui(ui, at, *velocity_m_s, state);
        }
        ConstraintKind::Pose { frame, clip, clip_frame, position_m, heading_deg, height_m } => {
            source_ui(ui, at, (clip, *clip_frame), state);
            frame_ui(ui, at, *frame, state);
            if tick_row_ui(ui, "Any place", position_m.is_none()) {
                let position_m = match position_m {
                    Some(_) => None,
                    None => Some(body_at_m(state, *frame)),
                };
                state.apply(&C::SetPlace { at: at.clone(), position_m });
            }
            if let Some(position_m) = position_m {
                place_ui(ui, at, *position_m, state);
            }
            heading_row_ui(ui, at, *heading_deg, state);
            height_ui(ui, at, *height_m, state);
        }
        ConstraintKind::Style { from, to, tag } => {
            let mut tags: Vec<String> =
                state.clips.iter().flat_map(|clip| clip.tags.iter().cloned()).collect();
            tags.sort_unstable();
            tags.dedup();
            let chosen = match tags.is_empty() {
                true => text_row_ui(ui, "Style", tag),
                false => choice_row_ui(ui, "Style", tag, &tags),
            };
            if let Some(tag) = chosen {
                state.style_tag = Some(tag.clone());
                state.apply(&C::SetTag { at: at.clone(), tag });
            }
            span_ui(ui, at, (*from, *to), state);
        }
        ConstraintKind::Path { from, to, points_m, heading } => {
            let span = (*from, *to);
            span_ui(ui, at, span, state);
            path_ui(ui, at, &PathFields { span, points_m, heading: *heading }, state);
        }
        ConstraintKind::Lock { from, to, pieces } => {
            for piece in pieces {
                line_ui(ui, &piece.clip, &format!("f {}–{}", piece.from, piece.to));
            }
            span_ui(ui, at, (*from, *to), state);
        }
    }
    let weight = mark.constraint.weight.unwrap_or(1.0);
    number_row_ui(ui, Number::weight("Weight"), weight, state, |value| {
        vec![C::SetWeight { at: at.clone(), weight: (value != 1.0).then_some(value) }]
    });
    let tolerance = mark.constraint.tolerance.as_ref();
    tolerance_ui(ui, at, &mark.constraint.kind, tolerance, state);
    ui.add_space(theme::GRID);
    let remove = match mark.constraint.kind {
        ConstraintKind::Lock { .. } => "Unlock",
        _ => "Delete",
    };
    if ui.add(Button::new(remove).fill(palette.raised)).clicked() {
        state.apply(&C::Remove { at: at.clone() });
    }
}

/// Every joint of the library's body: the parts that every body has first, then its own names.
fn joints(state: &EditorState) -> Vec<(String, String)> {
    let Some(library) = state.session.library() else { return Vec::new() };
    let skeleton = &library.skeleton;
    let has_role = |role: &&JointRole| skeleton.by_role(**role).is_some();
    let roles = JointRole::ALL.iter().filter(has_role);
    let roles = roles.map(|role| (role.name().to_owned(), spaced(role.name())));
    let mut joints: Vec<(String, String)> = roles.collect();
    for joint in skeleton.joints() {
        if !joints.iter().any(|(known, _)| *known == joint.name) {
            joints.push((joint.name.clone(), joint.name.clone()));
        }
    }
    joints
}

/// Which frame of which clip.
fn source_ui(ui: &mut Ui, at: &ConstraintRef, (clip, frame): (&str, u32), state: &mut EditorState) {
    let clips: Vec<(String, String)> =
        state.clips.iter().map(|clip| (clip.id.clone(), clip.id.clone())).collect();
    let last = |state: &EditorState, clip: &str| {
        let known = state.clips.iter().find(|known| known.id == clip);
        known.map_or(999_999, |known| known.n_frames.saturating_sub(1) as u32)
    };
    let set = |clip: &str, clip_frame| C::SetPoseSource {
        at: at.clone(),
        clip: clip.to_owned(),
        clip_frame,
    };
    if let Some(new) = pick_row_ui(ui, "Clip", clip, &clips) {
        let frame = frame.min(last(state, &new));
        state.apply(&set(&new, frame));
    }
    let range = (0.0, f64::from(last(state, clip)));
    let number = Number { range, ..Number::frames("Frame of the clip") };
    number_row_ui(ui, number, f64::from(frame), state, |value| {
        vec![set(clip, value.round() as u32)]
    });
}

/// Where the shown motion is at a frame.
fn body_at_m(state: &EditorState, frame: u32) -> [f64; 2] {
    let actor = state.stage.actors.get(state.session.active().0);
    let at_m = actor.map(|actor| actor.root_at_m(f64::from(frame))).unwrap_or_default();
    [at_m.x, at_m.z].map(|metres| rounded(f64::from(metres)))
}

fn frame_ui(ui: &mut Ui, at: &ConstraintRef, frame: u32, state: &mut EditorState) {
    let fps = state.fps();
    let secs = Number { unit: " s", speed: 0.01, decimals: 2, ..Number::frames("Time") };
    let parts = [("", Number::frames("Frame")), ("", secs)];
    let values = [f64::from(frame), f64::from(frame) / fps];
    parts_row_ui(ui, "Frame", parts, values, state, |[new, secs]| {
        let frame = if new == values[0] { secs * fps } else { new };
        vec![C::Retime { at: at.clone(), frame: frame.round() as u32 }]
    });
}

fn place_ui(ui: &mut Ui, at: &ConstraintRef, position_m: [f64; 2], state: &mut EditorState) {
    let parts = [("x ", Number::metres("x")), ("z ", Number::metres("z"))];
    parts_row_ui(ui, "Place", parts, position_m, state, |position_m| {
        vec![C::Move { at: at.clone(), position_m }]
    });
}

fn heading_row_ui(
    ui: &mut Ui,
    at: &ConstraintRef,
    heading_deg: Option<f64>,
    state: &mut EditorState,
) {
    if let Some(deg) = heading_deg {
        number_row_ui(ui, Number::degrees("Heading"), deg, state, |value| {
            vec![C::Turn { at: at.clone(), heading_deg: Some(value) }]
        });
    }
    if tick_row_ui(ui, "Any heading", heading_deg.is_none()) {
        let heading_deg = heading_deg.is_none().then_some(0.0);
        state.apply(&C::Turn { at: at.clone(), heading_deg });
    }
}

fn height_ui(ui: &mut Ui, at: &ConstraintRef, height_m: Option<f64>, state: &mut EditorState) {
    let number = Number::metres("Ground height");
    number_row_ui(ui, number, height_m.unwrap_or_default(), state, |value| {
        vec![C::Raise { at: at.clone(), height_m: Some(value) }]
    });
}

fn span_ui(ui: &mut Ui, at: &ConstraintRef, (from, to): (u32, u32), state: &mut EditorState) {
    let parts = [("", Number::frames("From")), ("to ", Number::frames("To"))];
    let values = [f64::from(from), f64::from(to)];
    parts_row_ui(ui, "Frames", parts, values, state, |[new_from, new_to]| {
        let (mut from, mut to) = (new_from.round() as u32, new_to.round() as u32);
        // The end that is typed stops at the other.
        if new_from == values[0] {
            to = to.max(from);
        } else {
            from = from.min(to);
        }
        vec![C::RetimeSpan { at: at.clone(), from, to }]
    });
}
