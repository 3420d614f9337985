//! Where no mark is: a rubber band, and a menu.

use std::collections::BTreeSet;

use egui::{PointerButton, Rect, Response, Stroke, StrokeKind, Ui};

use super::TimelinePanel;
use super::action::Action;
use super::drag::{BoxSelect, Drag};
use super::rows::{Layout, Row};
use super::sheet::Sheet;
use crate::state::EditorState;
use crate::ui_command::UiCommand;

impl TimelinePanel {
    /// Clicks and drags beside everything: a rubber band, and nothing selected any more.
    pub(super) fn ground_ui(
        &mut self,
        ui: &Ui,
        ground: &Response,
        window: Rect,
        lanes: Rect,
        state: &mut EditorState,
    ) {
        let shift = ui.input(|input| input.modifiers.shift);
        let press = ui.input(|input| input.pointer.press_origin());
        let inside = press.filter(|at| window.contains(*at) && lanes.contains(*at));
        if ground.drag_started_by(PointerButton::Primary)
            && let (Some(at), Some(axis)) = (inside, &self.axis)
        {
            let before = state.selected_items();
            let kept = if shift { before.clone() } else { Vec::new() };
            let from = (axis.frame_at(at.x), at.y - window.top() + self.scroll_pt);
            self.drag = Some(Drag::Box(BoxSelect { from, kept, before }));
            state.is_dragging_beside = true;
        }
        if ground.double_clicked() {
            self.axis = None;
        } else if ground.clicked() && !shift {
            state.session.selection_mut().clear();
            state.selected_hand_edit = None;
        }
    }

    /// The rubber band; gives the marks that it touches.
    pub(super) fn box_ui(&self, sheet: &Sheet<'_>, window: Rect) -> Option<BTreeSet<usize>> {
        let Some(Drag::Box(band)) = &self.drag else { return None };
        let to = sheet.ui.input(|input| input.pointer.interact_pos())?;
        let rect = band.rect(&sheet.axis, window.top() - self.scroll_pt, sheet.window.clamp(to));
        let accent = sheet.palette.accent;
        let painter = sheet.painter();
        painter.rect_filled(rect, 2.0, accent.gamma_multiply(0.12));
        painter.rect_stroke(rect, 2.0, Stroke::new(1.0, accent), StrokeKind::Inside);
        let touched = sheet.placed.iter().filter(|(_, mark)| mark.intersects(rect));
        Some(touched.map(|(index, _)| *index).collect())
    }

    /// What can be done where nothing is.
    pub(super) fn ground_menu_ui(
        &mut self,
        ground: &Response,
        sheet: &mut Sheet<'_>,
        layout: &Layout,
    ) {
        if ground.secondary_clicked()
            && let Some(at) = ground.interact_pointer_pos()
        {
            let is_body = |(row, place): &(Row, Rect)| *row == Row::Body && place.contains(at);
            let last = sheet.state.last_frame();
            let frame = (sheet.axis.frame_at(at.x).round().max(0.0) as usize).min(last);
            self.menu_at = Some((frame, layout.rows.iter().any(is_body)));
        }
        let Some((frame, is_body)) = self.menu_at else { return };
        if !ground.secondary_clicked() && !ground.context_menu_opened() {
            return;
        }
        let (state, actions) = (sheet.state, &mut sheet.actions);
        ground.context_menu(|ui| {
            ui.set_min_width(200.0);
            if is_body && ui.button("Add checkpoint here").clicked() {
                actions.push(Action::Do(state.checkpoint_on_the_way(frame)));
            }
            if ui.button(format!("Go to f {frame}")).clicked() {
                actions.push(Action::GoTo(frame));
            }
            for command in [UiCommand::SelectAll, UiCommand::FitTimeline, UiCommand::ClearLoop] {
                let button = egui::Button::new(command.label());
                if ui.add_enabled(command.is_enabled(state), button).clicked() {
                    actions.push(Action::Ask(command));
                }
            }
        });
    }
}
