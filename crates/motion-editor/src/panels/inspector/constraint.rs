//! The fields of a constraint: every value of every kind can be typed.

use egui::{Button, Ui};
use motion_core::skeleton::JointRole;
use motion_scene::color::ColorRole;
use motion_session::ConstraintKind;
use motion_session::Tolerance;
use motion_session::command::Command as C;
use motion_session::document::ConstraintRef;

use super::field::{
    Number, choice_row_ui, colored_line_ui, line_ui, number_row_ui, text_row_ui, tick_row_ui,
};
use super::heading_ui;
use crate::mark::Mark;
use crate::state::EditorState;
use crate::theme;

/// What a softened constraint begins with: what counts 1 anyway.
const TOLERANCE: (f64, f64, f64) = (0.3, 10.0, 10.0);

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
        ConstraintKind::Joint { frame, joint, position_m, .. } => {
            line_ui(ui, "Joint", &crate::viewport::gesture::joint::spaced(joint));
            frame_ui(ui, at, *frame, state);
            for (axis, name) in ["x", "y (height)", "z"].into_iter().enumerate() {
                number_row_ui(ui, Number::metres(name), position_m[axis], state, |value| {
                    let mut position_m = *position_m;
                    position_m[axis] = value;
                    vec![C::MoveJointTarget { at: at.clone(), position_m }]
                });
            }
            if JointRole::from_name(joint).is_none() {
                line_ui(ui, "Known as", joint);
            }
        }
        ConstraintKind::Pose { frame, clip, clip_frame, position_m, heading_deg, height_m } => {
            line_ui(ui, "Clip", clip);
            line_ui(ui, "Frame of the clip", &format!("f {clip_frame}"));
            frame_ui(ui, at, *frame, state);
            if let Some(position_m) = position_m {
                place_ui(ui, at, *position_m, state);
            } else {
                line_ui(ui, "Place", "any");
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
                state.apply(&C::SetTag { at: at.clone(), tag });
            }
            span_ui(ui, at, (*from, *to), state);
        }
        ConstraintKind::Path { from, to, points_m, .. } => {
            line_ui(ui, "Points", &points_m.len().to_string());
            span_ui(ui, at, (*from, *to), state);
        }
        ConstraintKind::Lock { from, to, pieces } => {
            line_ui(ui, "Pieces", &pieces.len().to_string());
            span_ui(ui, at, (*from, *to), state);
        }
    }
    let weight = mark.constraint.weight.unwrap_or(1.0);
    number_row_ui(ui, Number::weight("Weight"), weight, state, |value| {
        vec![C::SetWeight { at: at.clone(), weight: (value != 1.0).then_some(value) }]
    });
    tolerance_ui(ui, at, mark.constraint.tolerance.as_ref(), state);
    ui.add_space(theme::GRID);
    if ui.add(Button::new("Delete").fill(palette.raised)).clicked() {
        state.apply(&C::Remove { at: at.clone() });
    }
}

fn frame_ui(ui: &mut Ui, at: &ConstraintRef, frame: u32, state: &mut EditorState) {
    let fps = state.fps();
    let retimed = |frame: f64| vec![C::Retime { at: at.clone(), frame: frame.round() as u32 }];
    number_row_ui(ui, Number::frames("Frame"), f64::from(frame), state, retimed);
    let secs = Number { unit: " s", speed: 0.01, decimals: 2, ..Number::frames("Time") };
    let of_secs = |secs: f64| retimed(secs * fps);
    number_row_ui(ui, secs, f64::from(frame) / fps, state, of_secs);
}

fn place_ui(ui: &mut Ui, at: &ConstraintRef, position_m: [f64; 2], state: &mut EditorState) {
    for (axis, name) in ["x", "z"].into_iter().enumerate() {
        number_row_ui(ui, Number::metres(name), position_m[axis], state, |value| {
            let mut position_m = position_m;
            position_m[axis] = value;
            vec![C::Move { at: at.clone(), position_m }]
        });
    }
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
    number_row_ui(ui, Number::frames("From"), f64::from(from), state, |value| {
        let from = (value.round() as u32).min(to);
        vec![C::RetimeSpan { at: at.clone(), from, to }]
    });
    number_row_ui(ui, Number::frames("To"), f64::from(to), state, |value| {
        let to = (value.round() as u32).max(from);
        vec![C::RetimeSpan { at: at.clone(), from, to }]
    });
}

/// How far off is still well, in what people see: centimetres, degrees, frames.
fn tolerance_ui(
    ui: &mut Ui,
    at: &ConstraintRef,
    tolerance: Option<&Tolerance>,
    state: &mut EditorState,
) {
    if tick_row_ui(ui, "Near is enough", tolerance.is_some()) {
        let (position_m, heading_deg, frames) = TOLERANCE;
        let (position_m, heading_deg) = (Some(position_m), Some(heading_deg));
        let frames = Some(frames);
        let new = Tolerance { position_m, heading_deg, frames, ..Tolerance::default() };
        let tolerance = tolerance.is_none().then_some(new);
        state.apply(&C::SetTolerance { at: at.clone(), tolerance });
    }
    let Some(known) = tolerance else { return };
    let set = |new: Tolerance| vec![C::SetTolerance { at: at.clone(), tolerance: Some(new) }];
    let cm = Number {
        name: "Place within",
        unit: " cm",
        speed: 0.5,
        decimals: 0,
        range: (0.0, 10_000.0),
    };
    let now_cm = 100.0 * known.position_m.unwrap_or(TOLERANCE.0);
    number_row_ui(ui, cm, now_cm, state, |value| {
        set(Tolerance { position_m: Some(value / 100.0), ..known.clone() })
    });
    let degrees = Number { range: (0.0, 180.0), ..Number::degrees("Heading within") };
    number_row_ui(ui, degrees, known.heading_deg.unwrap_or(TOLERANCE.1), state, |value| {
        set(Tolerance { heading_deg: Some(value), ..known.clone() })
    });
    let frames = Number::frames("Time within");
    number_row_ui(ui, frames, known.frames.unwrap_or(TOLERANCE.2), state, |value| {
        set(Tolerance { frames: Some(value), ..known.clone() })
    });
}
