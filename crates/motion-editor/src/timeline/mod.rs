//! The timeline: what happens when, and the playhead.

pub mod action;
mod answer;
pub mod axis;
pub mod bar_row;
pub mod curve_rows;
pub mod curves;
pub mod drag;
pub mod feet_rows;
pub mod foot_faults;
mod ground;
pub mod hand_drag;
pub mod hand_row;
pub mod length_handle;
pub mod loop_band;
pub mod mark_shape;
pub mod meet_row;
pub mod navigate;
pub mod other_rows;
pub mod point_row;
pub mod pose_drop;
pub mod retime;
pub mod ribbon;
pub mod row;
pub mod rows;
pub mod ruler;
pub mod scale;
pub mod sheet;
pub mod style_drag;
pub mod take_drop;
pub mod time_unit;
pub mod transport;

use std::sync::Arc;

use egui::{Key, Modifiers, Pos2, Rect, Sense, Stroke, Ui};

use crate::state::EditorState;
use crate::theme;
use crate::ui_command::UiCommand;
use axis::Axis;
use curve_rows::PathErrors;
use drag::Drag;
use rows::{Layout, Row, rows_of};
use scale::Scale;
use sheet::Sheet;

/// Names of rows stand left of them, points.
const NAMES_PT: f32 = 108.0;
/// A key zooms by so much.
const KEY_ZOOM: f64 = 1.5;

/// The timeline's own state.
#[derive(Debug, Default)]
pub struct TimelinePanel {
    axis: Option<Axis>,
    n_frames: usize,
    scroll_pt: f32,
    drag: Option<Drag>,
    scale: Option<Scale>,
    /// Where the context menu of the ground was opened.
    menu_at: Option<(usize, bool)>,
    /// Whether the pointer is over the panel.
    has_pointer: bool,
    /// Whether something here was pointed at in the frame before.
    is_pointing: bool,
    path_errors: PathErrors,
}

impl TimelinePanel {
    /// Does a command that changes what of the motion is shown; gives whether it was one.
    pub fn run(&mut self, command: UiCommand, state: &mut EditorState) -> bool {
        let factor = match command {
            UiCommand::ScaleTimes => {
                self.scale = Scale::begin(state);
                return true;
            }
            UiCommand::FitTimeline => {
                self.axis = None;
                return true;
            }
            UiCommand::TimelineNearer => KEY_ZOOM,
            UiCommand::TimelineFarther => 1.0 / KEY_ZOOM,
            _ => return false,
        };
        if let Some(axis) = &mut self.axis {
            axis.reveal(state.frame());
            axis.zoom_at(axis.x_of(state.frame()), factor, self.n_frames);
        }
        true
    }

    /// Takes the keys that mean what is under way here, before they mean anything else.
    pub fn take_keys(&mut self, ctx: &egui::Context) {
        if let Some(scale) = &mut self.scale {
            scale.take_keys(ctx);
        }
    }

    /// The commands of keys that mean something else while the pointer is here.
    pub fn pressed(&self, ctx: &egui::Context) -> Option<UiCommand> {
        let is_free = self.has_pointer && !ctx.text_edit_focused();
        let home = is_free && ctx.input_mut(|input| input.consume_key(Modifiers::NONE, Key::Home));
        home.then_some(UiCommand::ToStart)
    }

    /// The frame under a place, in frames, for tests.
    pub fn frame_at(&self, x_pt: f32) -> Option<f64> {
        self.axis.map(|axis| axis.frame_at(x_pt))
    }

    /// The whole panel.
    pub fn ui(&mut self, ui: &mut Ui, state: &mut EditorState) {
        transport::transport_ui(ui, state);
        let panel = ui.available_rect_before_wrap();
        let panel = panel.with_max_x(panel.right().max(panel.left() + NAMES_PT + 40.0));
        let lanes = panel.with_min_x(panel.left() + NAMES_PT);
        let strip = lanes.with_max_y((lanes.top() + ruler::HEIGHT_PT).min(lanes.bottom()));
        let window = panel.with_min_y(strip.bottom());
        let axis = self.axis_for(lanes, state.n_frames_asked());
        let layout = Layout::new(rows_of(state), &state.marks, window, self.scroll_pt);
        let max_scroll = layout.max_scroll_pt(window);
        self.has_pointer = ui.rect_contains_pointer(panel);

        let ground = ui.allocate_rect(panel, Sense::click_and_drag());
        ui.painter().rect_filled(lanes, 0.0, theme::of(ui).base);
        let path_errors = self.path_errors.of_shown(state);
        let lanes_window = window.with_min_x(lanes.left());
        let mut sheet = Sheet::new(ui, state, axis, lanes_window);
        ruler::grid_ui(&sheet, lanes);
        rows_ui(&mut sheet, &layout, (window, lanes), &path_errors);
        ruler::ruler_ui(&mut sheet, strip);
        loop_band::loop_band_ui(&mut sheet, strip);
        if state.shown_card().is_some() {
            length_handle::length_handle_ui(&mut sheet, lanes, strip);
        } else {
            let sentence = "Clips, checkpoints and feet of the shown take stand here";
            ruler::empty_ui(&sheet, lanes_window, sentence);
        }
        other_rows::chips_ui(&mut sheet, strip.with_min_x(panel.left()).with_max_x(lanes.left()));
        ruler::playhead_ui(&sheet, lanes);
        scroll_bar_ui(&sheet, window, self.scroll_pt, layout.height_pt);
        let touched = self.box_ui(&sheet, window);
        self.ground_menu_ui(&ground, &mut sheet, &layout);
        let (actions, hovered_source) = (sheet.actions, sheet.hovered_source);
        state.hovered_source = hovered_source;

        if let (Some(Drag::Box(band)), Some(touched)) = (&self.drag, touched) {
            band.select(&touched, state);
        }
        self.hover(&actions, state);
        self.do_all(ui, actions, state);
        self.ground_ui(ui, &ground, window, lanes, state);
        let Some(axis) = &mut self.axis else { return };
        self.drag = self.drag.take().and_then(|drag| drag.ui(ui, axis, lanes, state));
        self.scale = self.scale.take().and_then(|scale| scale.ui(ui, axis, lanes, state));
        let can_scroll = max_scroll > 0.0;
        let by = navigate::navigate_ui(ui, &ground, (panel, lanes), axis, can_scroll, state);
        self.scroll_pt = (self.scroll_pt + by).clamp(0.0, max_scroll);
        take_drop::take_drop_ui(ui, &ground, lanes, axis, state);
        pose_drop::pose_drop_ui(ui, lanes, axis, state);
    }

    /// The axis for today's width and length.
    fn axis_for(&mut self, lanes: Rect, n_frames: usize) -> Axis {
        if self.n_frames != n_frames && self.drag.is_none() {
            // Another motion of about the same length is looked at from where the last was.
            let is_alike = n_frames.abs_diff(self.n_frames) * 4 < self.n_frames;
            let showed_all = self.axis.is_none_or(|axis| axis.shows_all(self.n_frames));
            if !is_alike || showed_all {
                self.axis = None;
            }
            self.n_frames = n_frames;
        }
        let fitted = Axis::fit(lanes.left(), lanes.width(), n_frames);
        let axis = self.axis.get_or_insert(fitted);
        // A wider panel shows more of the same, unless it showed everything.
        if axis.shows_all(n_frames) {
            *axis = fitted;
        }
        (axis.left_pt, axis.width_pt) = (lanes.left(), lanes.width());
        *axis
    }
}

fn rows_ui(
    sheet: &mut Sheet<'_>,
    layout: &Layout,
    (window, lanes): (Rect, Rect),
    path_errors_m: &Arc<Vec<f32>>,
) {
    for (row, place) in &layout.rows {
        if !place.intersects(window) {
            continue;
        }
        let names = place.with_max_x(lanes.left());
        row::name_ui(sheet, row, (names, names.intersect(window)), path_errors_m);
        let place = place.with_min_x(lanes.left());
        match row {
            Row::Source => ribbon::ribbon_ui(sheet, place),
            Row::Body | Row::Joint(_) | Row::Pose => point_row::point_row_ui(sheet, row, place),
            Row::Style | Row::Path | Row::Locked => bar_row::bar_row_ui(sheet, row, place),
            Row::Meetings => meet_row::meet_row_ui(sheet, place),
            Row::ByHand(_) => hand_row::hand_row_ui(sheet, place),
            Row::Foot(side) => feet_rows::foot_row_ui(sheet, *side, place),
            Row::Curves => {}
            Row::Curve(curve) => curve_rows::curve_row_ui(sheet, *curve, place, path_errors_m),
            Row::Other(character) => other_rows::other_row_ui(sheet, *character, place),
        }
    }
}

/// How much of the rows is in sight, where not all of them are.
fn scroll_bar_ui(sheet: &Sheet<'_>, window: Rect, scroll_pt: f32, height_pt: f32) {
    if height_pt <= window.height() {
        return;
    }
    let share = window.height() / height_pt;
    let top = window.top() + scroll_pt * share;
    let bar = Rect::from_min_max(
        Pos2::new(window.right() - 5.0, top),
        Pos2::new(window.right() - 2.0, top + window.height() * share),
    );
    sheet.painter().rect_filled(bar, 1.5, sheet.palette.faint.gamma_multiply(0.6));
}

/// A line over the whole height of some rows.
fn vertical(ui: &Ui, room: Rect, x: f32, stroke: Stroke) {
    if room.x_range().contains(x) {
        ui.painter().with_clip_rect(room).vline(x, room.y_range(), stroke);
    }
}
