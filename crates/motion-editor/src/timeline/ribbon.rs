//! The source ribbon: which clip is shown when, and what the cuts cost.

use egui::{CursorIcon, Pos2, Rect, Role, Sense, Shape, Stroke, WidgetInfo};
use motion_scene::color::ColorRole;
use motion_session::command::Command;
use motion_session::{LockedPiece, Palette};

use super::action::Action;
use super::sheet::Sheet;
use crate::state::EditorState;
use crate::take_card::{Cut, Piece};
use crate::theme;

/// The highest notch, points; a cut of [`FULL_COST`] has it.
const NOTCH_PT: f32 = 9.0;
/// What a cut costs that is hard to overlook.
const FULL_COST: f64 = 1.0;

/// The ribbon of the shown take. A click on a piece or a cut goes to its first frame.
pub fn ribbon_ui(sheet: &mut Sheet<'_>, row: Rect) {
    let Some(card) = sheet.state.shown_card() else { return };
    let lane = std::sync::Arc::clone(&card.lane);
    let bars = row.with_min_y(row.top() + 10.0);
    for (nth, piece) in lane.pieces.iter().enumerate() {
        let cut = lane.cuts.iter().find(|cut| cut.frame == piece.frames.start);
        piece_ui(sheet, bars, (nth, piece), cut);
    }
    for (nth, cut) in lane.cuts.iter().enumerate() {
        let sides = (lane.pieces.get(nth), lane.pieces.get(nth + 1));
        notch_ui(sheet, row, cut, sides);
    }
    let at = sheet.ui.input(|input| input.pointer.hover_pos()).filter(|at| bars.contains(*at));
    sheet.hovered_source = at.map(|at| sheet.axis.frame_at(at.x).max(0.0) as usize);
}

fn piece_ui(sheet: &mut Sheet<'_>, bars: Rect, (nth, piece): (usize, &Piece), cut: Option<&Cut>) {
    let palette = sheet.palette;
    let axis = &sheet.axis;
    let (from, to) = (axis.x_of(piece.frames.start as f64), axis.x_of(piece.frames.end as f64));
    let bar = Rect::from_x_y_ranges(from + 0.5..=(to - 0.5).max(from + 1.0), bars.y_range());
    let Some(seen) = sheet.seen(bar) else { return };
    let id = sheet.ui.scope_id().with(("piece", nth));
    let response = sheet.ui.interact(seen, id, Sense::click());
    let text = format!("{} {}–{}", piece.clip, piece.of_clip.0, piece.of_clip.1);
    response.widget_info(|| WidgetInfo::labeled(Role::ListItem, true, &text));
    let now = sheet.state.frame_number();
    let mut color = theme::clip_color(&piece.clip, &palette);
    if response.hovered() || piece.frames.contains(&now) {
        color = theme::over(color, palette.text, if response.hovered() { 0.16 } else { 0.07 });
    }
    let painter = sheet.painter();
    painter.rect_filled(bar, 3.0, color);
    // The clip's name as long as it fits, then its frames if they fit too.
    let room = seen.width() - 12.0;
    if room > 12.0 {
        let words = [text.as_str(), piece.clip.as_str()].map(|text| sheet.words(text));
        if let Some(words) = words.into_iter().find(|words| words.size().x <= room) {
            let at = Pos2::new(seen.left() + 6.0, bar.center().y - 0.5 * words.size().y);
            painter.galley(at, words, palette.text);
        }
    }
    if response.clicked() {
        sheet.actions.push(Action::GoTo(piece.frames.start));
    }
    if response.secondary_clicked() || response.context_menu_opened() {
        let (state, actions) = (sheet.state, &mut sheet.actions);
        response.context_menu(|ui| {
            ui.set_min_width(200.0);
            ui.strong(&text);
            if ui.button("Go to").clicked() {
                actions.push(Action::GoTo(piece.frames.start));
            }
            if ui.button("Exclude this clip").clicked() {
                actions.push(Action::Do(vec![exclude(state, &piece.clip)]));
            }
            if ui.button("Lock this stretch").clicked() {
                actions.push(Action::Do(vec![lock(state, piece)]));
            }
        });
    } else if response.hovered() {
        response.on_hover_ui_at_pointer(|ui| {
            ui.strong(piece.clip.as_str());
            let (first, last) = (piece.frames.start, piece.frames.end.saturating_sub(1));
            ui.label(format!("Frames {}–{} of the clip", piece.of_clip.0, piece.of_clip.1));
            ui.label(format!("Shown from f {first} to f {last}"));
            cut.into_iter().for_each(|cut| drop(ui.label(cut_text(cut))));
        });
    }
}

/// What keeps a clip out of every motion. Letters that patterns read otherwise stand for any letter.
fn exclude(state: &EditorState, clip: &str) -> Command {
    let palette = state.session.document().palette().cloned();
    let mut palette = palette.unwrap_or(Palette {
        include: Vec::new(),
        exclude: Vec::new(),
        tags: Vec::new(),
        extra: Default::default(),
    });
    let plain = |letter: char| if "*?[]{}\\!".contains(letter) { '?' } else { letter };
    // A pattern for a clip has its mirror image too.
    let clip = clip.strip_suffix("@mirror").unwrap_or(clip);
    palette.exclude.push(clip.chars().map(plain).collect());
    Command::SetPalette { palette: Some(palette) }
}

/// What keeps a piece where it is.
fn lock(state: &EditorState, piece: &Piece) -> Command {
    Command::AddLock {
        character: state.session.active(),
        from: piece.frames.start as u32,
        to: piece.frames.end.saturating_sub(1) as u32,
        pieces: vec![LockedPiece {
            clip: piece.clip.clone(),
            from: piece.of_clip.0,
            to: piece.of_clip.1,
            extra: Default::default(),
        }],
    }
}

fn cut_text(cut: &Cut) -> String {
    let bridge = if cut.is_bridge { ", a bridge between parts" } else { "" };
    format!("Cut at f {} costs {:.2}{bridge}", cut.frame, cut.cost)
}

/// A triangle over the ribbon; the dearer the cut the higher, and in the colour of misses where it
/// is a bridge.
fn notch_ui(
    sheet: &mut Sheet<'_>,
    row: Rect,
    cut: &Cut,
    (before, after): (Option<&Piece>, Option<&Piece>),
) {
    let x = sheet.axis.x_of(cut.frame as f64);
    let palette = sheet.palette;
    let share = (cut.cost / FULL_COST).clamp(0.5, 1.0) as f32;
    let (low, high) = (row.top() + 10.0, row.top() + 10.0 - share * NOTCH_PT);
    let room = Rect::from_x_y_ranges(x - 6.0..=x + 6.0, row.top()..=low + 2.0);
    let Some(seen) = sheet.seen(room) else { return };
    let id = sheet.ui.scope_id().with(("cut", cut.frame));
    let response = sheet.ui.interact(seen, id, Sense::click());
    response.widget_info(|| WidgetInfo::labeled(Role::ListItem, true, cut_text(cut)));
    let color = match (cut.is_bridge, response.hovered()) {
        (_, true) => palette.text,
        (true, _) => theme::role(ColorRole::Miss, palette.theme),
        (false, _) => palette.faint,
    };
    let points = vec![Pos2::new(x - 4.0, high), Pos2::new(x + 4.0, high), Pos2::new(x, low)];
    sheet.painter().add(Shape::convex_polygon(points, color, Stroke::NONE));
    if response.clicked() {
        sheet.actions.push(Action::GoTo(cut.frame));
    }
    let details = |ui: &mut egui::Ui| {
        ui.strong(cut_text(cut));
        if let (Some(before), Some(after)) = (before, after) {
            ui.label(format!("From {}, frame {}", before.clip, before.of_clip.1));
            ui.label(format!("to {}, frame {}", after.clip, after.of_clip.0));
        }
    };
    if response.secondary_clicked() || response.context_menu_opened() {
        let actions = &mut sheet.actions;
        response.context_menu(|ui| {
            details(ui);
            ui.separator();
            if ui.button("Go to").clicked() {
                actions.push(Action::GoTo(cut.frame));
            }
        });
    } else if response.hovered() {
        response.on_hover_cursor(CursorIcon::PointingHand).on_hover_ui_at_pointer(details);
    }
}
