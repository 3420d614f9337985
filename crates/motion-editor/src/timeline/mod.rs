//! The timeline: what happens when, and the playhead.

pub mod axis;
pub mod body_row;
pub mod feet_rows;
pub mod ribbon;
pub mod row;
pub mod ruler;
pub mod take_drop;
pub mod transport;

use egui::{PointerButton, Rect, Response, Sense, Stroke, Ui, Vec2};

use crate::state::EditorState;
use crate::theme;
use axis::Axis;

/// Names of rows stand left of them, points.
const NAMES_PT: f32 = 92.0;
/// The ruler.
const RULER_PT: f32 = 24.0;
/// So many points of wheel show twice as much.
const WHEEL_PT_PER_OCTAVE: f64 = 160.0;

/// The timeline's own state.
#[derive(Debug, Default)]
pub struct TimelinePanel {
    axis: Option<Axis>,
    n_frames: usize,
}

impl TimelinePanel {
    /// Shows all frames when it is drawn next.
    pub fn fit(&mut self) {
        self.axis = None;
    }

    /// The whole panel.
    pub fn ui(&mut self, ui: &mut Ui, state: &mut EditorState) {
        transport::transport_ui(ui, state);
        let rect = ui.available_rect_before_wrap();
        let rect = rect.with_max_x(rect.right().max(rect.left() + NAMES_PT + 40.0));
        let lanes = rect.with_min_x(rect.left() + NAMES_PT);
        let axis = self.axis_for(lanes, state.n_frames());
        let ground = ui.allocate_rect(rect, Sense::click_and_drag());
        let painter = ui.painter().with_clip_rect(rect);
        painter.rect_filled(lanes, 0.0, theme::of(ui).base);

        let rows = Rows::below(lanes.with_min_y(lanes.top() + RULER_PT));
        let strip = lanes.with_max_y(lanes.top() + RULER_PT);
        ruler::grid_ui(ui, lanes, &axis, state);
        ruler::ruler_ui(ui, strip, &axis, state);
        row::name_ui(ui, rect, rows.source, "Source");
        row::name_ui(ui, rect, rows.body, "Body");
        row::name_ui(ui, rect, rows.feet[0], "Foot L");
        row::name_ui(ui, rect, rows.feet[1], "Foot R");
        ribbon::ribbon_ui(ui, rows.source, &axis, state);
        body_row::body_row_ui(ui, rows.body, &axis, state);
        feet_rows::feet_rows_ui(ui, rows.feet, &axis, state);
        if state.shown_card().is_none() {
            row::empty_ui(ui, lanes, "Clips, checkpoints and feet of the shown take stand here");
        }
        ruler::playhead_ui(ui, lanes, &axis, state);
        take_drop::take_drop_ui(ui, &ground, lanes, &axis, state);
        self.navigate_ui(ui, &ground, lanes, state);
    }

    /// The axis for today's width and length.
    fn axis_for(&mut self, lanes: Rect, n_frames: usize) -> Axis {
        if self.n_frames != n_frames {
            self.n_frames = n_frames;
            self.axis = None;
        }
        let fitted = Axis::fit(lanes.left(), lanes.width(), n_frames);
        let axis = self.axis.get_or_insert(fitted);
        // A wider panel shows more of the same, unless it showed everything.
        let showed_all = *axis == Axis::fit(axis.left_pt, axis.width_pt, n_frames);
        if showed_all {
            *axis = fitted;
        }
        (axis.left_pt, axis.width_pt) = (lanes.left(), lanes.width());
        *axis
    }

    /// Wheel and middle button. While it plays, the playhead is kept in view.
    fn navigate_ui(&mut self, ui: &Ui, ground: &Response, lanes: Rect, state: &EditorState) {
        let n_frames = self.n_frames;
        let Some(axis) = &mut self.axis else { return };
        if state.is_playing() {
            axis.reveal(state.frame());
        }
        if ground.dragged_by(PointerButton::Middle) {
            axis.pan(ground.drag_delta().x, n_frames);
        }
        let at = ui.input(|input| input.pointer.hover_pos());
        let Some(at) = at.filter(|at| lanes.contains(*at) && ground.contains_pointer()) else {
            return;
        };
        let (wheel, zoom) = ui.input(|input| (input.smooth_scroll_delta(), input.zoom_delta()));
        // egui makes zoom of Ctrl+wheel, and wheel along x of Shift+wheel.
        if zoom != 1.0 {
            axis.zoom_at(at.x, f64::from(zoom), n_frames);
        } else if wheel.x != 0.0 {
            axis.pan(wheel.x, n_frames);
        } else if wheel.y != 0.0 {
            // There are too few rows to scroll, so the plain wheel zooms as well.
            let factor = (f64::from(wheel.y) / WHEEL_PT_PER_OCTAVE).exp2();
            axis.zoom_at(at.x, factor, n_frames);
        }
        if ground.double_clicked() {
            self.axis = None;
        }
    }
}

/// Where the rows are.
struct Rows {
    source: Rect,
    body: Rect,
    feet: [Rect; 2],
}

impl Rows {
    fn below(room: Rect) -> Self {
        let mut top = room.top() + theme::GRID;
        let mut next = |height: f32| {
            let size = Vec2::new(room.width(), height);
            let rect = Rect::from_min_size(egui::Pos2::new(room.left(), top), size);
            top += height + theme::GRID;
            rect
        };
        Self {
            source: next(theme::TRACK_HEIGHT + 10.0),
            body: next(theme::TRACK_HEIGHT),
            feet: [next(16.0), next(16.0)],
        }
    }
}

/// A line over the whole height of some rows.
fn vertical(ui: &Ui, room: Rect, x: f32, stroke: Stroke) {
    if room.x_range().contains(x) {
        ui.painter().with_clip_rect(room).vline(x, room.y_range(), stroke);
    }
}
