//! The card that a newcomer finds: what this is, and five ways to begin.

use egui::{Align2, Area, Button, Frame, Id, Key, Order, Rect, RichText, Stroke, Ui, Vec2};
use motion_session::sample::SAMPLES;

use crate::icons;
use crate::state::EditorState;
use crate::theme;
use crate::ui_command::UiCommand as C;
use crate::widgets::icon_button::icon_button_ui;

const WIDTH_PT: f32 = 640.0;
const INSET_PT: f32 = 16.0;
/// Of its buttons.
const HEIGHT_PT: f32 = 28.0;
/// More of them would be a list.
const N_RECENT: usize = 3;

/// Draws the card, a low strip along the lower edge of the view where it hides nobody, until it is
/// sent away.
pub fn welcome_ui(ui: &Ui, view: Rect, state: &mut EditorState) {
    if state.settings.welcome_seen || !state.welcomes {
        return;
    }
    let palette = theme::of(ui);
    let mut is_open = true;
    let frame = Frame::popup(ui.style())
        .fill(palette.raised)
        .stroke(Stroke::new(1.0, palette.hairline))
        .inner_margin(12.0)
        .corner_radius(8.0);
    Area::new(Id::unique("welcome"))
        .order(Order::Middle)
        .pivot(Align2::CENTER_BOTTOM)
        .fixed_pos(view.center_bottom() - Vec2::new(0.0, INSET_PT))
        .show(ui.ctx(), |ui| {
            frame.show(ui, |ui| {
                ui.set_width(WIDTH_PT.min(view.width() - 4.0 * INSET_PT).max(200.0));
                is_open = contents_ui(ui, state);
            });
        });
    let escaped = ui.input(|input| input.key_pressed(Key::Escape));
    if !is_open || escaped {
        state.settings.welcome_seen = true;
    }
}

/// Gives whether the card stays.
fn contents_ui(ui: &mut Ui, state: &mut EditorState) -> bool {
    let palette = theme::of(ui);
    let mut stays = true;
    ui.horizontal(|ui| {
        ui.label(RichText::new("Welcome to Gaitway").font(theme::title()));
        ui.with_layout(egui::Layout::right_to_left(egui::Align::Center), |ui| {
            stays &=
                !icon_button_ui(ui, icons::CLOSE, "Close welcome", "Closes this card (Esc)", false)
                    .clicked();
        });
    });
    let about = "Arrows on the floor say where somebody must be, how and when. Motions that do so \
                 are cut from motion capture while you watch.";
    ui.label(RichText::new(about).color(palette.faint));
    ui.add_space(2.0 * theme::GRID);
    let mut chosen = None;
    ui.horizontal_wrapped(|ui| {
        ui.spacing_mut().item_spacing = Vec2::new(theme::GRID, theme::GRID);
        let guide = Button::new(RichText::new("Show me, in five steps").color(palette.base));
        if ui.add(guide.fill(palette.accent).min_size([0.0, HEIGHT_PT].into())).clicked() {
            chosen = Some(C::Guide);
        }
        let mut button = |ui: &mut Ui, text: &str, about: &str, command: C| {
            let button = Button::new(text).fill(palette.hovered).min_size([0.0, HEIGHT_PT].into());
            if ui.add(button).on_hover_text(about).clicked() {
                chosen = Some(command);
            }
        };
        for (nth, sample) in SAMPLES.iter().enumerate() {
            button(ui, sample.title, "A sample", C::Sample(nth as u8));
        }
        button(ui, "Open…", C::Open.tooltip(), C::Open);
        button(ui, "Import clips…", C::Import.tooltip(), C::Import);
        for nth in 0..state.recent.len().min(N_RECENT) {
            let path = &state.recent[nth];
            let name = path.file_stem().map(|name| name.to_string_lossy().into_owned());
            let about = path.display().to_string();
            button(ui, &name.unwrap_or_default(), &about, C::Recent(nth as u8));
        }
    });
    if let Some(command) = chosen {
        state.ask(command);
        stays = false;
    }
    stays
}
