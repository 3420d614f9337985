//! Panels by key: F6 goes from one to the next, Tab through what is in it.

use egui::{Id, Rect, Role, Sense, Stroke, StrokeKind, Ui, WidgetInfo};

use crate::theme;

/// The panels, in the order of F6, as screen readers call them.
pub const PANELS: [&str; 5] = ["Menus", "Library panel", "View", "Takes and inspector", "Timeline"];

fn id_of(panel: &str) -> Id {
    Id::unique(("panel", panel))
}

/// To be called first in a panel: the place where keys come in. Its edge is lit while they do.
pub fn anchor_ui(ui: &Ui, panel: &str) {
    let id = id_of(panel);
    let at = Rect::from_min_size(ui.max_rect().min, egui::Vec2::ZERO);
    let response = ui.interact(at, id, Sense::focusable_noninteractive());
    response.widget_info(|| WidgetInfo::labeled(Role::Group, true, panel));
    if response.has_focus() {
        let line = Stroke::new(1.0, theme::of(ui).accent);
        let clip = ui.clip_rect();
        ui.painter().rect_stroke(clip, 0.0, line, StrokeKind::Inside);
    }
}

/// Brings the keys to the next panel that there is, or to the one before.
pub fn step(ctx: &egui::Context, is_there: impl Fn(&str) -> bool, ahead: bool) {
    let there: Vec<&str> = PANELS.into_iter().filter(|panel| is_there(panel)).collect();
    let last = ctx.data(|data| data.get_temp::<usize>(Id::unique("panel of keys")));
    let focused = ctx.memory(|memory| memory.focused());
    let n = there.len();
    let now = there.iter().position(|panel| focused == Some(id_of(panel)));
    let next = match (now.or(last.filter(|_| focused.is_some())), ahead) {
        (Some(at), true) => (at + 1) % n,
        (Some(at), false) => (at + n - 1) % n,
        (None, true) => 0,
        (None, false) => n - 1,
    };
    ctx.data_mut(|data| data.insert_temp(Id::unique("panel of keys"), next));
    ctx.memory_mut(|memory| memory.request_focus(id_of(there[next])));
}

/// Whether keys go to a button or the like, and not to the window as a whole.
pub fn is_on_widget(ctx: &egui::Context) -> bool {
    let focused = ctx.memory(|memory| memory.focused());
    focused.is_some_and(|id| PANELS.iter().all(|panel| id != id_of(panel)))
}
