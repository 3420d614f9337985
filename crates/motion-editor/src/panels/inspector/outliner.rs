//! Everything that is asked of the active character, a line each.

use egui::{Align2, Pos2, Role, Sense, Ui, Vec2, WidgetInfo};
use motion_scene::color::ColorRole;
use motion_session::ConstraintKind;
use motion_session::document::ObstacleIdx;
use motion_session::selection::Selectable;
use motion_session::stage::meeting_wishes::title;
use motion_session::stage::pick::PickTarget;

use super::{empty_ui, heading_ui};
use crate::mark::Mark;
use crate::obstacle_form::{self, ObstacleForm};
use crate::state::EditorState;
use crate::theme;

/// The lines. A click selects, Shift adds; what is under the pointer is lit everywhere.
pub(super) fn outliner_ui(ui: &mut Ui, state: &mut EditorState) {
    let marks = state.marks.clone();
    heading_ui(ui, "Constraints", &marks.len().to_string());
    if marks.is_empty() {
        empty_ui(ui, "What the motion must meet stands here; C and a press on the floor adds some");
    }
    ui.spacing_mut().item_spacing.y = 0.0;
    for mark in &marks {
        line_ui(ui, mark, state);
    }
    ui.spacing_mut().item_spacing.y = theme::GRID;
    things_ui(ui, state);
}

/// Meetings and obstacles, where there are any.
fn things_ui(ui: &mut Ui, state: &mut EditorState) {
    let document = state.session.document();
    let meetings: Vec<Thing> = document
        .interactions()
        .iter()
        .enumerate()
        .map(|(nth, meeting)| Thing {
            item: Selectable::Interaction(meeting.id.clone()),
            target: PickTarget::Meeting { interaction: nth, member: 0 },
            title: title(meeting),
            beside: format!("f {}", meeting.frame),
            role: ColorRole::Pose,
        })
        .collect();
    let obstacles: Vec<Thing> = document
        .obstacles()
        .iter()
        .enumerate()
        .map(|(nth, obstacle)| {
            let (_, top) = obstacle_form::levels_m(&obstacle.shape);
            Thing {
                item: Selectable::Obstacle(ObstacleIdx(nth)),
                target: PickTarget::Obstacle { obstacle: nth },
                title: format!("{} {}", ObstacleForm::of(&obstacle.shape).name(), nth + 1),
                beside: format!("{top:.2} m high"),
                role: ColorRole::Obstacle,
            }
        })
        .collect();
    for (name, things) in [("Meetings", meetings), ("Obstacles", obstacles)] {
        if things.is_empty() {
            continue;
        }
        heading_ui(ui, name, &things.len().to_string());
        ui.spacing_mut().item_spacing.y = 0.0;
        things.iter().for_each(|thing| thing.line_ui(ui, state));
        ui.spacing_mut().item_spacing.y = theme::GRID;
    }
}

/// Something that is no constraint of one character.
struct Thing {
    item: Selectable,
    target: PickTarget,
    title: String,
    beside: String,
    role: ColorRole,
}

impl Thing {
    fn line_ui(&self, ui: &mut Ui, state: &mut EditorState) {
        let palette = theme::of(ui);
        let size = Vec2::new(ui.available_width(), theme::ROW_HEIGHT);
        let (rect, response) = ui.allocate_exact_size(size, Sense::click());
        let is_selected = state.session.selection().contains(&self.item);
        let label = format!("{}, {}", self.title, self.beside);
        response.widget_info(|| WidgetInfo::selected(Role::ListItem, true, is_selected, &label));
        if response.hovered() {
            state.hovered = Some(self.target);
        }
        if is_selected || response.hovered() || state.hovered == Some(self.target) {
            let fill = if is_selected { palette.accent_surface } else { palette.hovered };
            ui.painter().rect_filled(rect, f32::from(theme::RADIUS), fill);
        }
        let y = rect.center().y;
        let painter = ui.painter().with_clip_rect(rect);
        let dot = theme::role(self.role, palette.theme);
        painter.circle_filled(Pos2::new(rect.left() + 8.0, y), 4.0, dot);
        let right = Pos2::new(rect.right() - 6.0, y);
        let align = Align2::RIGHT_CENTER;
        painter.text(right, align, &self.beside, theme::caption(), palette.faint);
        let left = Pos2::new(rect.left() + 20.0, y);
        painter.text(left, Align2::LEFT_CENTER, &self.title, theme::body(), palette.text);
        if response.clicked() {
            let selection = state.session.selection_mut();
            if ui.input(|input| input.modifiers.shift) {
                selection.toggle(self.item.clone());
            } else {
                selection.select(self.item.clone());
            }
        }
    }
}

/// What a mark is in the view.
fn target_of(mark: &Mark) -> Option<PickTarget> {
    let (character, constraint) = (mark.at.character.0, mark.index);
    match mark.constraint.kind {
        ConstraintKind::Body { .. } => Some(PickTarget::Checkpoint { character, constraint }),
        ConstraintKind::Joint { .. } => Some(PickTarget::JointTarget { character, constraint }),
        ConstraintKind::Pose { .. } => Some(PickTarget::Pose { character, constraint }),
        ConstraintKind::Path { .. } => Some(PickTarget::Path { character, constraint }),
        _ => None,
    }
}

fn line_ui(ui: &mut Ui, mark: &Mark, state: &mut EditorState) {
    let palette = theme::of(ui);
    let size = Vec2::new(ui.available_width(), theme::ROW_HEIGHT);
    let (rect, response) = ui.allocate_exact_size(size, Sense::click());
    let is_selected = state.is_selected(&mark.at);
    let label = format!("Asked for: {} at f {}, {}", mark.title(), mark.frame(), mark.miss_text());
    response.widget_info(|| WidgetInfo::selected(Role::ListItem, true, is_selected, &label));
    let target = target_of(mark);
    if response.hovered() && target.is_some() {
        state.hovered = target;
    }
    let is_hovered = response.hovered() || (target.is_some() && state.hovered == target);
    let painter = ui.painter().with_clip_rect(rect);
    if is_selected || is_hovered {
        let fill = if is_selected { palette.accent_surface } else { palette.hovered };
        painter.rect_filled(rect, f32::from(theme::RADIUS), fill);
    }
    let y = rect.center().y;
    let dot = theme::role(mark.color_role(), palette.theme);
    painter.circle_filled(Pos2::new(rect.left() + 8.0, y), 4.0, dot);
    let right = Pos2::new(rect.right() - 6.0, y);
    let miss = if mark.is_off() { ColorRole::Miss } else { ColorRole::FaintText };
    let miss = theme::role(miss, palette.theme);
    let words = painter.text(right, Align2::RIGHT_CENTER, mark.miss_text(), theme::caption(), miss);
    let frame = Pos2::new(words.left() - 8.0, y);
    let number = format!("f {}", mark.frame());
    let number = painter.text(frame, Align2::RIGHT_CENTER, number, theme::caption(), palette.faint);
    let room = rect.with_max_x(number.left() - 6.0);
    let left = Pos2::new(rect.left() + 20.0, y);
    let title = mark.title();
    painter.with_clip_rect(room).text(
        left,
        Align2::LEFT_CENTER,
        title,
        theme::body(),
        palette.text,
    );
    if response.clicked() {
        let item = Selectable::Constraint(mark.at.clone());
        let selection = state.session.selection_mut();
        if ui.input(|input| input.modifiers.shift) {
            selection.toggle(item);
        } else {
            selection.select(item);
        }
    }
}
