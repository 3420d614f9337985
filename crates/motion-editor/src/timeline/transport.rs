//! Buttons over the timeline, and which frame it is.

use egui::{Align, Layout, Role, Sense, Ui, WidgetInfo};

use super::time_unit::TimeUnit;
use crate::icons;
use crate::state::{EditorState, SPEEDS};
use crate::theme;
use crate::ui_command::UiCommand;
use crate::viewport::described;
use crate::widgets::digits::tabular;
use crate::widgets::icon_button::icon_button_ui;

/// The bar.
pub fn transport_ui(ui: &mut Ui, state: &mut EditorState) {
    let height = theme::TOP_BAR_HEIGHT;
    let layout = Layout::left_to_right(Align::Center);
    ui.allocate_ui_with_layout([ui.available_width(), height].into(), layout, |ui| {
        ui.set_min_height(height);
        ui.add_space(theme::GRID);
        ui.spacing_mut().item_spacing.x = 2.0;
        let play = if state.is_playing() { icons::PAUSE } else { icons::PLAY };
        let buttons = [
            (icons::TO_START, UiCommand::ToStart),
            (icons::STEP_BACK, UiCommand::StepBack),
            (play, UiCommand::PlayPause),
            (icons::STEP_AHEAD, UiCommand::StepAhead),
            (icons::TO_END, UiCommand::ToEnd),
            (icons::LOOP, UiCommand::Loop),
        ];
        for (icon, command) in buttons {
            let is_on = command.is_on(state).unwrap_or_default();
            let tooltip = described(command);
            let enabled = command.is_enabled(state);
            let response = ui
                .add_enabled_ui(enabled, |ui| {
                    icon_button_ui(ui, icon, &command.label(), &tooltip, is_on)
                })
                .inner;
            if response.clicked() {
                state.ask(command);
            }
        }
        ui.add_space(2.0 * theme::GRID);
        clock_ui(ui, state);
        ui.with_layout(Layout::right_to_left(Align::Center), |ui| {
            ui.add_space(2.0 * theme::GRID);
            speed_ui(ui, state);
        });
    });
}

/// The moment; a click writes it otherwise.
fn clock_ui(ui: &mut Ui, state: &mut EditorState) {
    let palette = theme::of(ui);
    let (unit, fps) = (state.settings.time_unit, state.fps());
    let now = format!("{} ", unit.text(state.frame_number(), fps));
    let mut job = tabular(ui, &now, &theme::heading(), palette.text);
    let beside = match unit {
        TimeUnit::Frames => TimeUnit::Seconds,
        TimeUnit::Seconds | TimeUnit::Timecode => TimeUnit::Frames,
    };
    let rest = format!(
        "/ {}    {}    {fps:.0} fps",
        unit.short(state.last_frame(), fps),
        beside.text(state.frame_number(), fps),
    );
    let rest = tabular(ui, &rest, &theme::body(), palette.faint);
    for section in rest.sections {
        let text = &rest.text[section.byte_range.start.0..section.byte_range.end.0];
        job.append(text, 0.0, section.format);
    }
    let tooltip = described(UiCommand::TimeUnit);
    let response = ui.add(egui::Label::new(job).selectable(false).sense(Sense::click()));
    response.widget_info(|| WidgetInfo::labeled(Role::Button, true, "Clock"));
    if response.on_hover_text(tooltip).clicked() {
        state.ask(UiCommand::TimeUnit);
    }
}

fn speed_ui(ui: &mut Ui, state: &mut EditorState) {
    let text = format!("{}×", state.speed());
    let combo = egui::ComboBox::from_id_salt("speed").width(64.0).selected_text(text);
    let response = combo.show_ui(ui, |ui| {
        for speed in SPEEDS {
            let is_chosen = (speed - state.speed()).abs() < 1e-9;
            if ui.selectable_label(is_chosen, format!("{speed}×")).clicked() {
                state.set_speed(speed);
            }
        }
    });
    response.response.on_hover_text("How fast time goes (− and =)");
    ui.label(egui::RichText::new("Speed").font(theme::caption()).color(theme::of(ui).faint));
}
