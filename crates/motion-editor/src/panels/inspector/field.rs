//! Fields that change the project: a drag is one step of the history, and so is what is typed.

use egui::{Align, DragValue, Id, Layout, Response, RichText, Role, TextEdit, Ui, WidgetInfo};
use motion_session::command::Command;

use crate::state::EditorState;
use crate::theme;
use crate::widgets::digits::tabular;

/// A number with its unit.
#[derive(Clone, Copy, Debug)]
pub struct Number<'a> {
    /// What stands before it, and what tests and screen readers call it.
    pub name: &'a str,
    /// Its unit, with a space before it where there must be one.
    pub unit: &'a str,
    /// What a point of drag changes.
    pub speed: f64,
    /// Digits after the point.
    pub decimals: usize,
    /// The least and the most.
    pub range: (f64, f64),
}

impl<'a> Number<'a> {
    /// A place along an axis, metres.
    pub fn metres(name: &'a str) -> Self {
        Self { name, unit: " m", speed: 0.01, decimals: 2, range: (-10_000.0, 10_000.0) }
    }

    /// A whole number of frames.
    pub fn frames(name: &'a str) -> Self {
        Self { name, unit: " f", speed: 0.25, decimals: 0, range: (0.0, 999_999.0) }
    }

    /// An angle, degrees.
    pub fn degrees(name: &'a str) -> Self {
        Self { name, unit: "°", speed: 0.5, decimals: 0, range: (-360.0, 360.0) }
    }

    /// How much something counts.
    pub fn weight(name: &'a str) -> Self {
        Self { name, unit: "", speed: 0.01, decimals: 2, range: (0.0, 1000.0) }
    }
}

/// A row with a number. `make` says what another number does.
pub fn number_row_ui(
    ui: &mut Ui,
    number: Number<'_>,
    value: f64,
    state: &mut EditorState,
    make: impl Fn(f64) -> Vec<Command>,
) {
    row_ui(ui, |ui| {
        name_ui(ui, number.name);
        ui.with_layout(Layout::right_to_left(Align::Center), |ui| {
            number_ui(ui, number, value, state, make);
        });
    });
}

/// A row with the parts of one thing, each behind its letter. `make` says what all of them do when
/// one is another number.
pub fn parts_row_ui<const N: usize>(
    ui: &mut Ui,
    name: &str,
    parts: [(&str, Number<'_>); N],
    values: [f64; N],
    state: &mut EditorState,
    make: impl Fn([f64; N]) -> Vec<Command>,
) {
    row_ui(ui, |ui| {
        name_ui(ui, name);
        ui.with_layout(Layout::right_to_left(Align::Center), |ui| {
            ui.spacing_mut().item_spacing.x = theme::GRID;
            for (nth, (letter, number)) in parts.into_iter().enumerate().rev() {
                let size = if N > 2 { NARROW_PT } else { FIELD_PT };
                sized_number_ui(ui, (number, letter, size), values[nth], state, |value| {
                    let mut values = values;
                    values[nth] = value;
                    make(values)
                });
            }
        });
    });
}

/// A number alone.
pub fn number_ui(
    ui: &mut Ui,
    number: Number<'_>,
    value: f64,
    state: &mut EditorState,
    make: impl Fn(f64) -> Vec<Command>,
) -> Response {
    sized_number_ui(ui, (number, "", FIELD_PT), value, state, make)
}

fn sized_number_ui(
    ui: &mut Ui,
    (number, letter, width_pt): (Number<'_>, &str, f32),
    value: f64,
    state: &mut EditorState,
    make: impl Fn(f64) -> Vec<Command>,
) -> Response {
    let mut new = value;
    let field = DragValue::new(&mut new)
        .prefix(letter)
        .speed(number.speed)
        .fixed_decimals(number.decimals)
        .range(number.range.0..=number.range.1)
        .suffix(number.unit)
        .update_while_editing(false);
    let response = ui.scope(|ui| {
        let p = theme::of(ui);
        // A ground of its own says that it can be typed into.
        ui.visuals_mut().widgets.inactive.weak_bg_fill = p.raised;
        ui.add_sized([width_pt, theme::ROW_HEIGHT - 4.0], field)
    });
    let response = response.inner;
    ui.ctx().accesskit_node_builder(response.id, |node| node.set_label(number.name));
    let label = format!("Change {}", number.name.to_lowercase());
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
    response
}

/// How wide a field is, points.
const FIELD_PT: f32 = 84.0;
/// How wide one of three is, points.
const NARROW_PT: f32 = 68.0;

/// A row with words that can be changed; `None` until they have been.
pub fn text_row_ui(ui: &mut Ui, name: &str, value: &str) -> Option<String> {
    let id = Id::unique(("inspected words", name));
    let kept = ui.data(|data| data.get_temp::<String>(id));
    let mut text = kept.unwrap_or_else(|| value.to_owned());
    let mut changed = None;
    row_ui(ui, |ui| {
        name_ui(ui, name);
        ui.with_layout(Layout::right_to_left(Align::Center), |ui| {
            let width = ui.available_width();
            let response = ui.add(TextEdit::singleline(&mut text).desired_width(width));
            response.widget_info(|| WidgetInfo::labeled(Role::TextInput, true, name));
            if response.lost_focus() {
                let is_escaped = ui.input(|input| input.key_pressed(egui::Key::Escape));
                changed = (!is_escaped && text != value).then(|| text.clone());
            }
            let is_typed_in = response.has_focus();
            ui.data_mut(|data| {
                if is_typed_in {
                    data.insert_temp(id, text.clone());
                } else {
                    data.remove::<String>(id);
                }
            });
        });
    });
    changed
}

/// A row with a choice; gives another one where it was made.
pub fn choice_row_ui(ui: &mut Ui, name: &str, value: &str, choices: &[String]) -> Option<String> {
    let mut chosen = None;
    row_ui(ui, |ui| {
        name_ui(ui, name);
        ui.with_layout(Layout::right_to_left(Align::Center), |ui| {
            let combo = egui::ComboBox::from_id_salt(("choice", name)).selected_text(value);
            let shown = combo.width(120.0).show_ui(ui, |ui| {
                for choice in choices {
                    if ui.selectable_label(choice == value, choice).clicked() {
                        chosen = Some(choice.clone());
                    }
                }
            });
            let info = || WidgetInfo::labeled(Role::ComboBox, true, name);
            shown.response.widget_info(info);
        });
    });
    chosen.filter(|choice| choice != value)
}

/// A row with a tick; gives whether it was clicked.
pub fn tick_row_ui(ui: &mut Ui, name: &str, mut is_on: bool) -> bool {
    let mut clicked = false;
    row_ui(ui, |ui| clicked = ui.checkbox(&mut is_on, name).clicked());
    clicked
}

/// A row that says something.
pub fn line_ui(ui: &mut Ui, name: &str, value: &str) {
    let color = theme::of(ui).text;
    colored_line_ui(ui, name, value, color);
}

/// A row that says something in a colour.
pub fn colored_line_ui(ui: &mut Ui, name: &str, value: &str, color: egui::Color32) {
    row_ui(ui, |ui| {
        name_ui(ui, name);
        value_ui(ui, value, color);
    });
}

/// A row of a list.
pub fn row_ui(ui: &mut Ui, add: impl FnOnce(&mut Ui)) {
    let size = [ui.available_width(), theme::ROW_HEIGHT].into();
    ui.allocate_ui_with_layout(size, Layout::left_to_right(Align::Center), add);
}

/// What a row is called.
pub(super) fn name_ui(ui: &mut Ui, name: &str) {
    ui.label(RichText::new(name).color(theme::of(ui).faint));
}

/// A value at the right end.
pub fn value_ui(ui: &mut Ui, value: &str, color: egui::Color32) {
    ui.with_layout(Layout::right_to_left(Align::Center), |ui| {
        let job = tabular(ui, value, &theme::body(), color);
        ui.label(job);
    });
}
