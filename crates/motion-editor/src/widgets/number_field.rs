//! A number with a name and a unit. A drag of it is one step of the history, and so is what is typed.

use egui::{Align, DragValue, Layout, RichText, Ui};
use motion_session::command::Command;

use crate::state::EditorState;
use crate::theme;

/// How wide a field is, points.
const FIELD_PT: f32 = 84.0;

/// What is said of a number.
#[derive(Clone, Copy, Debug)]
pub struct NumberField {
    /// What stands before it, and what tests and screen readers call it.
    pub name: &'static str,
    /// Its unit, with a space before it where there must be one.
    pub unit: &'static str,
    /// What a point of drag changes.
    pub speed: f64,
    /// Digits after the point.
    pub decimals: usize,
    /// The least and the most.
    pub range: (f64, f64),
}

impl NumberField {
    /// A row with the name and the number. `make` says what another number does.
    pub fn row_ui(
        self,
        ui: &mut Ui,
        value: f64,
        state: &mut EditorState,
        make: impl Fn(f64) -> Vec<Command>,
    ) {
        let size = [ui.available_width(), theme::ROW_HEIGHT].into();
        ui.allocate_ui_with_layout(size, Layout::left_to_right(Align::Center), |ui| {
            ui.label(RichText::new(self.name).color(theme::of(ui).faint));
            ui.with_layout(Layout::right_to_left(Align::Center), |ui| {
                self.ui(ui, value, state, make);
            });
        });
    }

    fn ui(
        self,
        ui: &mut Ui,
        value: f64,
        state: &mut EditorState,
        make: impl Fn(f64) -> Vec<Command>,
    ) {
        let mut new = value;
        let field = DragValue::new(&mut new)
            .speed(self.speed)
            .fixed_decimals(self.decimals)
            .range(self.range.0..=self.range.1)
            .suffix(self.unit)
            .update_while_editing(false);
        // A ground of its own says that it can be typed into.
        ui.visuals_mut().widgets.inactive.weak_bg_fill = theme::of(ui).raised;
        let response = ui.add_sized([FIELD_PT, theme::ROW_HEIGHT - 4.0], field);
        ui.ctx().accesskit_node_builder(response.id, |node| node.set_label(self.name));
        let label = format!("Change {}", self.name.to_lowercase());
        if response.drag_started() {
            state.begin_gesture(&label);
        }
        if response.changed() {
            let commands = make(new);
            if response.dragged() && state.is_in_gesture() {
                state.preview(&commands);
            } else if !response.dragged() {
                state.apply_all(&label, &commands);
            }
        }
        if response.drag_stopped() && state.is_in_gesture() {
            state.commit();
        }
    }
}
