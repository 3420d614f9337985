//! Tags as switches: a click lets the search use all clips that have one, or none of them.

use egui::{Button, RichText, Role, Ui, WidgetInfo};
use motion_session::clip_rows::tag_counts;
use motion_session::command::Command;
use motion_session::palette::{TagState, palette_with_tag, tag_state, tagged_clips};

use crate::state::EditorState;
use crate::theme;

/// More would be a panel of their own; the search finds the others.
const MAX_TAGS: usize = 6;

/// The most frequent tags.
pub(super) fn tags_ui(ui: &mut Ui, state: &mut EditorState) {
    let clips = tagged_clips(&state.clips);
    let present = state.session.document().palette();
    let all = tag_counts(&state.clips);
    let mut wanted = None;
    ui.spacing_mut().item_spacing.x = theme::GRID;
    ui.horizontal_wrapped(|ui| {
        for (tag, n) in all.iter().take(MAX_TAGS) {
            let use_of = tag_state(present, &clips, tag);
            if tag_ui(ui, tag, *n, use_of).clicked() {
                let on = use_of != TagState::All;
                wanted = Some(palette_with_tag(present, &clips, tag, on));
            }
        }
    });
    if !all.is_empty() {
        ui.add_space(theme::GRID);
    }
    if let Some(palette) = wanted {
        state.apply(&Command::SetPalette { palette });
    }
}

fn tag_ui(ui: &mut Ui, tag: &str, n: usize, use_of: TagState) -> egui::Response {
    let palette = theme::of(ui);
    let (fill, color, sign) = match use_of {
        TagState::All => (palette.raised, palette.text, ""),
        TagState::Some => (palette.raised, palette.faint, "~ "),
        TagState::None => (palette.base, palette.faint, "− "),
    };
    let text = RichText::new(format!("{sign}{tag} {n}")).font(theme::caption()).color(color);
    let response = ui.add(Button::new(text).fill(fill).min_size([0.0, 20.0].into()));
    let state = match use_of {
        TagState::All => "all in use",
        TagState::Some => "some in use",
        TagState::None => "none in use",
    };
    let label = format!("Tag {tag}, {n} clips, {state}");
    let is_on = use_of == TagState::All;
    response.widget_info(|| WidgetInfo::selected(Role::ListItem, true, is_on, &label));
    response.on_hover_text(format!("{n} clips, {state}; a click switches all of them"))
}
