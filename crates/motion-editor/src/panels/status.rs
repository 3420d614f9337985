//! The bar at the bottom: what goes on, and what draws.

use egui::{Align, Layout, RichText, Ui};

use crate::settings::{Tool, navigation_name};
use crate::state::EditorState;
use crate::theme;

/// The bar.
pub fn status_ui(ui: &mut Ui, state: &EditorState, adapter: Option<&str>) {
    let faint = theme::of(ui).faint;
    let small = |text: String| RichText::new(text).font(theme::caption()).color(faint);
    ui.horizontal_centered(|ui| {
        ui.add_space(theme::GRID);
        ui.label(small(hint(state)));
        ui.with_layout(Layout::right_to_left(Align::Center), |ui| {
            ui.add_space(theme::GRID);
            let scheme = navigation_name(state.settings.navigation);
            let drawn_by = match adapter {
                Some(adapter) => format!("Drawn by {adapter}"),
                None => "Nothing draws here".to_owned(),
            };
            ui.label(small(format!("{scheme} navigation"))).on_hover_text(drawn_by);
        });
    });
}

fn hint(state: &EditorState) -> String {
    if let Some(notice) = state.notices.current() {
        return notice.text.clone();
    }
    if state.settings.tool == Tool::Checkpoint {
        return "Press on the floor where the body must be, drag to where it looks · Esc leaves the \
                tool"
            .to_owned();
    }
    match state.settings.tool {
        Tool::JointTarget => {
            return "Drag from a joint to where it must be · Z lifts it · Esc leaves the tool"
                .to_owned();
        }
        Tool::Pose => {
            return "Click on the floor for the pose · R or the wheel turns it · [ ] choose its frame \
                    · Esc leaves the tool"
                .to_owned();
        }
        Tool::Path => {
            return "Draw on the floor where the body must go, from the playhead on · Esc leaves the \
                    tool"
                .to_owned();
        }
        Tool::Obstacle => {
            return "Drag on the floor where something stands · O: another form · Esc leaves the tool"
                .to_owned();
        }
        Tool::ByHand => {
            return "Drag a hand or a foot to move it, another joint to turn it · Z lifts · Esc \
                    leaves the tool"
                .to_owned();
        }
        Tool::Select | Tool::Checkpoint => {}
    }
    if let Some(mark) = state.selected_mark() {
        return format!("{} at f {}: {}", mark.title(), mark.frame(), mark.miss_text());
    }
    match state.shown_card() {
        Some(_) => "Space plays · drag on the ruler to scrub · 1–9 show takes".to_owned(),
        None => String::new(),
    }
}
