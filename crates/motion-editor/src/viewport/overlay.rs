//! Words over the view: what is shown, and what the mouse does.

use egui::{Align2, Color32, FontId, Pos2, Rect, Ui, Vec2};
use motion_session::live::SearchState;

use crate::settings::Navigation;
use crate::state::EditorState;
use crate::theme;
use crate::widgets::digits::tabular;

/// From the edge of the view, points.
const INSET_PT: f32 = 12.0;

/// The words. `fps` is how often the window is drawn, while it moves.
pub fn overlay_ui(ui: &Ui, rect: Rect, state: &EditorState, fps: Option<f32>) {
    let palette = theme::of(ui);
    let mut at = rect.min + Vec2::splat(INSET_PT);
    let mut line = |text: &str, font: &FontId, color: Color32| {
        let job = tabular(ui, text, font, color);
        let galley = ui.fonts_mut(|fonts| fonts.layout_job(job));
        let height = galley.size().y;
        ui.painter().galley(at, galley, color);
        at.y += height + 2.0;
    };
    if let Some(card) = state.shown_card() {
        line(&card.title(), &theme::heading(), palette.text);
        let speed = state.speed();
        let rate = fps.map(|fps| format!(" · {fps:.0} fps drawn")).unwrap_or_default();
        let text = format!("f {} · {:.2} s · {speed}×{rate}", state.frame_number(), state.secs());
        line(&text, &theme::caption(), palette.faint);
    }
    let hint = match state.settings.navigation {
        Navigation::Blender => "Drag: orbit   Shift+drag: pan   Wheel: zoom   F: frame   `: views",
        Navigation::Industry => {
            "Alt+drag: orbit   Middle: pan   Right: fly   Wheel: zoom   F: frame"
        }
    };
    let corner = Pos2::new(rect.left() + INSET_PT, rect.bottom() - INSET_PT);
    ui.painter().text(corner, Align2::LEFT_BOTTOM, hint, theme::caption(), palette.faint);
    if state.shown_card().is_none() {
        waiting_ui(ui, rect, state);
    }
}

/// In the middle, while there is nothing to be seen.
fn waiting_ui(ui: &Ui, rect: Rect, state: &EditorState) {
    let palette = theme::of(ui);
    let (first, second) = match state.search_state() {
        SearchState::Building { what, share } => {
            ("Reading the library…".to_owned(), format!("{what} · {:.0} %", share * 100.0))
        }
        SearchState::Infeasible(sentence) | SearchState::Error(sentence) => {
            ("No motion".to_owned(), sentence)
        }
        _ => ("Searching for a motion…".to_owned(), String::new()),
    };
    let middle = rect.center();
    ui.painter().text(middle, Align2::CENTER_BOTTOM, first, theme::title(), palette.text);
    let second = ui.fonts_mut(|fonts| {
        fonts.layout(second, theme::body(), palette.faint, (rect.width() - 80.0).max(80.0))
    });
    let at = middle + Vec2::new(-0.5 * second.size().x, 6.0);
    ui.painter().galley(at, second, palette.faint);
}
