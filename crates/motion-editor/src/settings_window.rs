//! What can be set, on one page.

use egui::{Align2, Checkbox, ComboBox, Grid, RichText, Slider, Ui, Vec2, Window};
use motion_scene::color::Theme;
use motion_session::preferences::UI_SCALES;

use crate::settings::{Navigation, Settings, navigation_name};
use crate::theme;

/// Draws the page while `is_open`.
pub fn settings_window_ui(ui: &Ui, settings: &mut Settings, is_open: &mut bool) {
    let before = settings.clone();
    Window::new(RichText::new("Settings").font(theme::title()))
        .id(egui::Id::unique("settings"))
        .open(is_open)
        .collapsible(false)
        .resizable(false)
        .default_width(380.0)
        .anchor(Align2::CENTER_CENTER, Vec2::ZERO)
        .show(ui.ctx(), |ui| contents_ui(ui, settings));
    if settings.theme != before.theme {
        theme::choose(ui.ctx(), settings.theme);
    }
    if settings.ui_scale != before.ui_scale {
        ui.ctx().set_zoom_factor(settings.ui_scale);
    }
}

fn contents_ui(ui: &mut Ui, settings: &mut Settings) {
    Grid::new("settings").num_columns(2).spacing([24.0, 8.0]).show(ui, |ui| {
        ui.label("Colours");
        let name = |theme| if theme == Theme::Dark { "Dark" } else { "Light" };
        ComboBox::from_id_salt("colours").selected_text(name(settings.theme)).show_ui(ui, |ui| {
            for theme in [Theme::Dark, Theme::Light] {
                ui.selectable_value(&mut settings.theme, theme, name(theme));
            }
        });
        ui.end_row();
        ui.label("Mouse in the view");
        let chosen = navigation_name(settings.navigation);
        ComboBox::from_id_salt("navigation").selected_text(chosen).show_ui(ui, |ui| {
            for scheme in [Navigation::Blender, Navigation::Industry] {
                ui.selectable_value(&mut settings.navigation, scheme, navigation_name(scheme));
            }
        });
        ui.end_row();
        ui.label("Size of everything");
        // Set when it is let go: a window that grows under a slider runs away from the pointer.
        let id = ui.scope_id().with("scale");
        let mut scale = ui.data(|data| data.get_temp(id)).unwrap_or(settings.ui_scale);
        let slider = Slider::new(&mut scale, UI_SCALES)
            .step_by(0.05)
            .custom_formatter(|scale, _| format!("{:.0} %", 100.0 * scale));
        let response = ui.add(slider);
        if response.dragged() {
            ui.data_mut(|data| data.insert_temp(id, scale));
        } else if response.changed() || response.drag_stopped() {
            settings.ui_scale = scale;
            ui.data_mut(|data| data.remove::<f32>(id));
        }
        ui.end_row();
    });
    ui.add_space(theme::GRID);
    ui.add(Checkbox::new(&mut settings.reduced_motion, "Move nothing that need not move"));
    ui.add(Checkbox::new(
        &mut settings.own_file_dialog,
        "Choose files inside the window (from the next start)",
    ));
}
