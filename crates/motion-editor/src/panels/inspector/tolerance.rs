//! How far off is near enough, in what people see: centimetres, degrees, frames.

use egui::Ui;
use motion_session::command::Command as C;
use motion_session::document::ConstraintRef;
use motion_session::{ConstraintKind, Tolerance};

use super::field::{Number, number_row_ui, tick_row_ui};
use crate::state::EditorState;

/// What a softened constraint begins with: what counts 1 anyway.
const TOLERANCE: (f64, f64, f64) = (0.3, 10.0, 10.0);

/// What of a constraint can be off.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Parts {
    /// Place, heading and time.
    Body,
    /// The place.
    Place,
    /// Nothing that anybody could say in numbers.
    None,
}

fn parts_of(kind: &ConstraintKind) -> Parts {
    match kind {
        ConstraintKind::Body { .. } => Parts::Body,
        ConstraintKind::Joint { .. } | ConstraintKind::Path { .. } => Parts::Place,
        ConstraintKind::Pose { .. }
        | ConstraintKind::Style { .. }
        | ConstraintKind::Lock { .. } => Parts::None,
    }
}

/// How far off is still well, in what people see: centimetres, degrees, frames.
pub(super) fn tolerance_ui(
    ui: &mut Ui,
    at: &ConstraintRef,
    kind: &ConstraintKind,
    tolerance: Option<&Tolerance>,
    state: &mut EditorState,
) {
    let parts = parts_of(kind);
    if parts == Parts::None && tolerance.is_none() {
        return;
    }
    if tick_row_ui(ui, "Near is enough", tolerance.is_some()) {
        let (position_m, heading_deg, frames) = TOLERANCE;
        let of_body = |value| (parts == Parts::Body).then_some(value);
        let (heading_deg, frames) = (of_body(heading_deg), of_body(frames));
        let position_m = Some(position_m);
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
    if parts != Parts::Body && known.heading_deg.is_none() && known.frames.is_none() {
        return;
    }
    let degrees = Number { range: (0.0, 180.0), ..Number::degrees("Heading within") };
    number_row_ui(ui, degrees, known.heading_deg.unwrap_or(TOLERANCE.1), state, |value| {
        set(Tolerance { heading_deg: Some(value), ..known.clone() })
    });
    let frames = Number::frames("Time within");
    number_row_ui(ui, frames, known.frames.unwrap_or(TOLERANCE.2), state, |value| {
        set(Tolerance { frames: Some(value), ..known.clone() })
    });
}
