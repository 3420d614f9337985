//! Wheel and middle button.

use egui::{PointerButton, Rect, Response, Ui};

use super::axis::Axis;
use crate::state::EditorState;

/// So many points of wheel show twice as much.
const WHEEL_PT_PER_OCTAVE: f64 = 160.0;

/// Ctrl+wheel zooms at the pointer, Shift+wheel and the middle button pan, the wheel scrolls rows,
/// and zooms where all of them are in sight. While it plays, the playhead is kept in view. Gives how
/// far rows are to be scrolled, points.
pub fn navigate_ui(
    ui: &Ui,
    ground: &Response,
    (panel, lanes): (Rect, Rect),
    axis: &mut Axis,
    can_scroll: bool,
    state: &EditorState,
) -> f32 {
    let n_frames = state.n_frames_asked();
    if state.is_playing() {
        axis.reveal(state.frame());
    }
    if ground.dragged_by(PointerButton::Middle) {
        axis.pan(ground.drag_delta().x, n_frames);
        if can_scroll {
            return -ground.drag_delta().y;
        }
    }
    let at = ui.input(|input| input.pointer.hover_pos());
    let Some(at) = at.filter(|_| ui.rect_contains_pointer(panel)) else { return 0.0 };
    let (wheel, zoom) = ui.input(|input| (input.smooth_scroll_delta(), input.zoom_delta()));
    let x = at.x.max(lanes.left());
    // egui makes zoom of Ctrl+wheel, and wheel along x of Shift+wheel.
    if zoom != 1.0 {
        axis.zoom_at(x, f64::from(zoom), n_frames);
    } else if wheel.x != 0.0 {
        axis.pan(wheel.x, n_frames);
    } else if wheel.y != 0.0 && can_scroll {
        return -wheel.y;
    } else if wheel.y != 0.0 {
        let factor = (f64::from(wheel.y) / WHEEL_PT_PER_OCTAVE).exp2();
        axis.zoom_at(x, factor, n_frames);
    }
    0.0
}
