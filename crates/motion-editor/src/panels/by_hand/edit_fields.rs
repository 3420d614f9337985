//! The numbers of the selected change by hand.

use egui::Ui;
use motion_session::command::Command;
use motion_session::document::by_hand::{MAX_EASE_FRAMES, MAX_SHIFT_M, MAX_TURN_DEG};
use motion_session::document::{HandChange, HandEdit};

use super::heading_ui;
use crate::hand_words::what;
use crate::panels::inspector::field::{Number, number_row_ui};
use crate::state::EditorState;

const LAST_FRAME: f64 = 999_999.0;

/// The fields, where a change is selected.
pub(super) fn edit_fields_ui(ui: &mut Ui, state: &mut EditorState) {
    let Some((id, edit)) = state.selected_edit() else { return };
    let (id, edit) = (id.to_owned(), edit.clone());
    let Some(take) = state.hand_take() else { return };
    let with =
        |edit: HandEdit| vec![Command::ChangeByHand { take: take.clone(), id: id.clone(), edit }];
    heading_ui(ui, &what(&edit.change), "");
    let (from, to) = (f64::from(edit.from), f64::from(edit.to));
    number_row_ui(ui, frames("From", (0.0, to)), from, state, |frame| {
        with(HandEdit { from: frame.round() as u32, ..edit.clone() })
    });
    number_row_ui(ui, frames("To", (from, LAST_FRAME)), to, state, |frame| {
        with(HandEdit { to: frame.round() as u32, ..edit.clone() })
    });
    let most = (0.0, f64::from(MAX_EASE_FRAMES));
    number_row_ui(ui, frames("Ease in", most), f64::from(edit.ease_in), state, |frames| {
        with(HandEdit { ease_in: frames.round() as u32, ..edit.clone() })
    });
    number_row_ui(ui, frames("Ease out", most), f64::from(edit.ease_out), state, |frames| {
        with(HandEdit { ease_out: frames.round() as u32, ..edit.clone() })
    });
    for axis in 0..3 {
        let (field, value) = match &edit.change {
            HandChange::Hand { shift_m, .. } => (centimetres(axis), 100.0 * shift_m[axis]),
            HandChange::Joint { turn_deg, .. } => (degrees(axis), turn_deg[axis]),
        };
        number_row_ui(ui, field, value, state, |value| {
            with(HandEdit { change: with_axis(&edit.change, axis, value), ..edit.clone() })
        });
    }
}

/// The change with another value along or about an axis.
fn with_axis(change: &HandChange, axis: usize, value: f64) -> HandChange {
    let mut new = change.clone();
    match &mut new {
        HandChange::Hand { shift_m, .. } => shift_m[axis] = 0.01 * value,
        HandChange::Joint { turn_deg, .. } => turn_deg[axis] = value,
    }
    new
}

fn frames(name: &'static str, range: (f64, f64)) -> Number<'static> {
    Number { name, unit: " f", speed: 0.25, decimals: 0, range }
}

fn centimetres(axis: usize) -> Number<'static> {
    let name = ["Shift x", "Shift y (up)", "Shift z"][axis];
    let most = 100.0 * MAX_SHIFT_M;
    Number { name, unit: " cm", speed: 0.25, decimals: 1, range: (-most, most) }
}

fn degrees(axis: usize) -> Number<'static> {
    let name = ["Turn about x", "Turn about y", "Turn about z"][axis];
    let range = (-MAX_TURN_DEG, MAX_TURN_DEG);
    Number { name, unit: "°", speed: 0.5, decimals: 1, range }
}
