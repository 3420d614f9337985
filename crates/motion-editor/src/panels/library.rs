//! The library's clips.

use egui::{Align2, Pos2, RichText, Role, ScrollArea, Sense, TextEdit, Ui, Vec2, WidgetInfo};

use super::{empty_ui, heading_ui};
use crate::clip_line::ClipLine;
use crate::icons;
use crate::state::EditorState;
use crate::theme;

/// The panel's own state.
#[derive(Debug, Default)]
pub struct LibraryPanel {
    wanted: String,
}

impl LibraryPanel {
    /// The whole panel.
    pub fn ui(&mut self, ui: &mut Ui, state: &EditorState) {
        heading_ui(ui, "Library", &clip_count(state.clips.len()));
        let palette = theme::of(ui);
        let hint = RichText::new("Find clips or tags").color(palette.faint);
        let field = TextEdit::singleline(&mut self.wanted)
            .hint_text(hint)
            .prefix(RichText::new(icons::SEARCH).font(theme::icon()).color(palette.faint))
            .desired_width(f32::INFINITY);
        let response = ui.add_sized([ui.available_width(), theme::ICON_BUTTON], field);
        response.widget_info(|| WidgetInfo::labeled(Role::TextInput, true, "Find clips"));
        ui.add_space(theme::GRID);
        let found: Vec<&ClipLine> =
            state.clips.iter().filter(|clip| matches(clip, &self.wanted)).collect();
        if state.clips.is_empty() {
            empty_ui(ui, "Clips of the library stand here once it is read");
        } else if found.is_empty() {
            empty_ui(ui, "No clip has that in its name or tags");
        }
        let used = used_clips(state);
        ui.spacing_mut().item_spacing.y = 0.0;
        ScrollArea::vertical().auto_shrink(false).show_rows(
            ui,
            theme::ROW_HEIGHT,
            found.len(),
            |ui, rows| {
                for clip in &found[rows] {
                    clip_ui(ui, clip, used.contains(&clip.id.as_str()));
                }
            },
        );
    }
}

fn clip_count(n: usize) -> String {
    match n {
        0 => String::new(),
        1 => "1 clip".to_owned(),
        n => format!("{n} clips"),
    }
}

/// Clips of the shown take.
fn used_clips(state: &EditorState) -> Vec<&str> {
    let pieces = state.shown_card().map(|card| card.lane.pieces.as_slice());
    pieces.unwrap_or_default().iter().map(|piece| piece.clip.as_str()).collect()
}

fn matches(clip: &ClipLine, wanted: &str) -> bool {
    let has = |text: &str, word: &str| text.to_lowercase().contains(word);
    wanted
        .to_lowercase()
        .split_whitespace()
        .all(|word| has(&clip.id, word) || clip.tags.iter().any(|tag| has(tag, word)))
}

/// A clip's line: a mark in its colour if the shown take uses it, its name, its length.
fn clip_ui(ui: &mut Ui, clip: &ClipLine, is_used: bool) {
    let palette = theme::of(ui);
    let size = Vec2::new(ui.available_width(), theme::ROW_HEIGHT);
    let (rect, response) = ui.allocate_exact_size(size, Sense::hover());
    let label = format!("Clip {}, {} frames", clip.id, clip.n_frames);
    response.widget_info(|| WidgetInfo::labeled(Role::ListItem, true, &label));
    let painter = ui.painter();
    if response.hovered() {
        painter.rect_filled(rect, f32::from(theme::RADIUS), palette.hovered);
    }
    if is_used {
        let dot = Pos2::new(rect.left() + 6.0, rect.center().y);
        let color = theme::over(theme::clip_color(&clip.id, &palette), palette.text, 0.25);
        painter.circle_filled(dot, 4.0, color);
    }
    let frames = clip.n_frames.to_string();
    let right = Pos2::new(rect.right() - 6.0, rect.center().y);
    let number = painter.text(right, Align2::RIGHT_CENTER, frames, theme::caption(), palette.faint);
    let left = Pos2::new(rect.left() + 16.0, rect.center().y);
    let room = rect.with_max_x(number.left() - 6.0);
    let words = if is_used { palette.text } else { theme::over(palette.faint, palette.text, 0.45) };
    painter.with_clip_rect(room).text(left, Align2::LEFT_CENTER, &clip.id, theme::body(), words);
    response.on_hover_ui(|ui| {
        ui.strong(clip.id.as_str());
        ui.label(format!("{} frames", clip.n_frames));
        if !clip.tags.is_empty() {
            ui.label(clip.tags.join(", "));
        }
    });
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn words_are_looked_for_in_names_and_tags() {
        let clip = ClipLine {
            id: "Walk_left_90".to_owned(),
            n_frames: 9,
            tags: vec!["locomotion".to_owned()],
        };
        for (wanted, expected) in
            [("", true), ("walk", true), ("90 loco", true), ("run", false), ("walk run", false)]
        {
            assert_eq!(matches(&clip, wanted), expected, "{wanted}");
        }
    }
}
