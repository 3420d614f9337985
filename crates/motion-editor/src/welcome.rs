//! The card that a newcomer finds: what this is, and five ways to begin.

use egui::{Align2, Area, Button, Frame, Id, Key, Order, Rect, RichText, Stroke, Ui, Vec2};
use motion_session::sample::SAMPLES;

use crate::icons;
use crate::state::EditorState;
use crate::theme;
use crate::ui_command::UiCommand as C;
use crate::widgets::icon_button::icon_button_ui;

const WIDTH_PT: f32 = 300.0;
const INSET_PT: f32 = 16.0;
/// More of them would be a list.
const N_RECENT: usize = 3;

/// Draws the card in a corner of the view, where it hides nobody, until it is sent away.
pub fn welcome_ui(ui: &Ui, view: Rect, state: &mut EditorState) {
    if state.settings.welcome_seen || !state.welcomes {
        return;
    }
    let palette = theme::of(ui);
    let mut is_open = true;
    let frame = Frame::popup(ui.style())
        .fill(palette.raised)
        .stroke(Stroke::new(1.0, palette.hairline))
        .inner_margin(16.0)
        .corner_radius(8.0);
    Area::new(Id::unique("welcome"))
        .order(Order::Middle)
        .pivot(Align2::LEFT_BOTTOM)
        .fixed_pos(view.left_bottom() + Vec2::new(INSET_PT, -2.5 * INSET_PT))
        .show(ui.ctx(), |ui| {
            frame.show(ui, |ui| {
                ui.set_width(WIDTH_PT);
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
    let guide = Button::new(RichText::new("Show me, in five steps").color(palette.base));
    if ui.add(guide.fill(palette.accent).min_size([WIDTH_PT, 30.0].into())).clicked() {
        state.ask(C::Guide);
        stays = false;
    }
    ui.add_space(theme::GRID);
    let mut chosen = None;
    let mut line = |ui: &mut Ui, text: &str, about: &str, command: C| {
        let button = Button::new(text).min_size([WIDTH_PT, theme::ROW_HEIGHT].into());
        if ui.add(button.right_text(RichText::new(about).color(palette.faint))).clicked() {
            chosen = Some(command);
        }
    };
    for (nth, sample) in SAMPLES.iter().enumerate() {
        line(ui, sample.title, "sample", C::Sample(nth as u8));
    }
    line(ui, "Open a project…", "Ctrl+O", C::Open);
    for nth in 0..state.recent.len().min(N_RECENT) {
        let name = state.recent[nth].file_stem().map(|name| name.to_string_lossy().into_owned());
        line(ui, &name.unwrap_or_default(), "open again", C::Recent(nth as u8));
    }
    if let Some(command) = chosen {
        state.ask(command);
        stays = false;
    }
    stays
}
