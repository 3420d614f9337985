//! A line for each clip.

use egui::{
    Align2, Key, Pos2, Rect, Role, ScrollArea, Sense, Stroke, StrokeKind, Ui, Vec2, WidgetInfo,
};
use motion_session::clip_rows::ClipRow;
use motion_session::command::Command;
use motion_session::palette::{palette_with, tagged_clips};

use super::tag_menu;
use crate::icons;
use crate::settings::Tool;
use crate::state::EditorState;
use crate::theme;
use crate::viewport::gesture::pose::PoseDrag;

/// Half of a check box, points.
const HALF_BOX_PT: f32 = 7.0;

/// More stretches with a tag than this are counted rather than listed.
const MAX_SPANS: usize = 8;

/// The list. The box at the left switches a clip on and off, a rest of the pointer plays it in the
/// view, a click takes its pose for the pose tool, and a drag brings it to the floor or a frame.
pub(super) fn clip_list_ui(ui: &mut Ui, found: &[ClipRow], state: &mut EditorState) {
    let used: Vec<String> = match state.shown_card() {
        Some(card) => card.lane.pieces.iter().map(|piece| piece.clip.clone()).collect(),
        None => Vec::new(),
    };
    let mut hovered = None;
    ui.spacing_mut().item_spacing.y = 0.0;
    let list = ScrollArea::vertical().auto_shrink(false);
    list.show_rows(ui, theme::ROW_HEIGHT, found.len(), |ui, rows| {
        for clip in &found[rows] {
            let is_used = used.contains(&clip.id);
            if line_ui(ui, clip, is_used, state) {
                hovered = Some(clip.id.clone());
            }
        }
    });
    state.preview_clip(hovered);
}

/// Gives whether the pointer is over it.
fn line_ui(ui: &mut Ui, clip: &ClipRow, is_used: bool, state: &mut EditorState) -> bool {
    let palette = theme::of(ui);
    let size = Vec2::new(ui.available_width(), theme::ROW_HEIGHT);
    let (rect, response) = ui.allocate_exact_size(size, Sense::click_and_drag());
    let label = format!("Clip {}, {:.1} s", clip.id, clip.secs);
    let is_on = clip.is_in_palette;
    response.widget_info(|| WidgetInfo::selected(Role::ListItem, true, is_on, &label));
    let painter = ui.painter();
    if response.hovered() || response.has_focus() {
        painter.rect_filled(rect, f32::from(theme::RADIUS), palette.hovered);
    }
    let middle = Pos2::new(rect.left() + 2.0 + HALF_BOX_PT, rect.center().y);
    box_ui(ui, middle, is_on);
    let secs = format!("{:.1} s", clip.secs);
    let right = Pos2::new(rect.right() - 6.0, rect.center().y);
    let painter = ui.painter();
    let number = painter.text(right, Align2::RIGHT_CENTER, secs, theme::caption(), palette.faint);
    let mut left = rect.left() + 2.0 * HALF_BOX_PT + 10.0;
    if is_used {
        // The colour that it has on the ribbon.
        let color = theme::over(theme::clip_color(&clip.id, &palette), palette.text, 0.25);
        painter.circle_filled(Pos2::new(left + 4.0, rect.center().y), 4.0, color);
        left += 14.0;
    }
    let words = match (is_on, is_used) {
        (false, _) => theme::over(palette.panel, palette.faint, 0.6),
        (true, true) => palette.text,
        (true, false) => theme::over(palette.faint, palette.text, 0.45),
    };
    let room = Rect::from_x_y_ranges(left..=number.left() - 6.0, rect.y_range());
    let at = Pos2::new(left, rect.center().y);
    painter.with_clip_rect(room).text(at, Align2::LEFT_CENTER, &clip.id, theme::body(), words);
    let is_over_box = |at: Pos2| at.x < rect.left() + 2.0 * HALF_BOX_PT + 8.0;
    let by_key = response.has_focus() && ui.input(|input| input.key_pressed(Key::Enter));
    let by_click = response.clicked() && response.interact_pointer_pos().is_some_and(is_over_box);
    if by_key || by_click {
        switch(clip, state);
    } else if response.clicked() {
        take_pose(clip, state);
    } else if response.drag_started() {
        take_pose(clip, state);
        response.dnd_set_drag_payload(PoseDrag);
    }
    let is_hovered = response.hovered() || response.has_focus();
    tag_menu::tag_menu_ui(&response, clip, state);
    response.on_hover_ui(|ui| about_ui(ui, clip));
    is_hovered
}

fn box_ui(ui: &Ui, middle: Pos2, is_on: bool) {
    let palette = theme::of(ui);
    let place = Rect::from_center_size(middle, Vec2::splat(2.0 * HALF_BOX_PT));
    let line = Stroke::new(1.0, if is_on { palette.accent } else { palette.faint });
    ui.painter().rect_stroke(place, 3.0, line, StrokeKind::Inside);
    if is_on {
        let font = egui::FontId { size: 11.0, ..theme::icon() };
        let tick = icons::DONE;
        ui.painter().text(middle, Align2::CENTER_CENTER, tick, font, palette.accent);
    }
}

fn about_ui(ui: &mut Ui, clip: &ClipRow) {
    ui.strong(clip.id.as_str());
    ui.label(format!("{} frames, {:.1} s", clip.n_frames, clip.secs));
    if let Some(subject) = &clip.subject {
        ui.label(format!("Subject {subject}"));
    }
    if clip.is_mirror {
        ui.label("A mirror image");
    }
    if !clip.tags.is_empty() {
        ui.label(clip.tags.join(", "));
    }
    for span in clip.spans.iter().take(MAX_SPANS) {
        ui.weak(format!("{}: frames {}–{}", span.tag, span.from, span.to));
    }
    if clip.spans.len() > MAX_SPANS {
        ui.weak(format!("and {} more stretches", clip.spans.len() - MAX_SPANS));
    }
    for own in clip.by_hand.iter().filter(|own| own.frames.is_some()) {
        ui.weak(tag_menu::words(own));
    }
    let in_use = if clip.is_in_palette { "May be used" } else { "May not be used" };
    ui.label(format!("{in_use}; the box changes that"));
    ui.label("The right button tags it");
    ui.label("A click takes the pose that is shown; drag it to the floor or the timeline");
}

/// Takes the pose that is shown of a clip for the pose tool, which puts it down.
fn take_pose(clip: &ClipRow, state: &mut EditorState) {
    let preview = state.preview.as_ref().filter(|preview| preview.clip == clip.id);
    let frame = preview.map_or(0, |preview| preview.frame as u32);
    state.pose_clip = Some((clip.id.clone(), frame));
    state.settings.tool = Tool::Pose;
}

/// Lets the search use a clip, or no longer, as one step.
fn switch(clip: &ClipRow, state: &mut EditorState) {
    let present = state.session.document().palette();
    let palette = palette_with(present, &tagged_clips(&state.clips), &clip.id, !clip.is_in_palette);
    state.apply(&Command::SetPalette { palette });
}
