//! A take's card: a picture, what it costs, how it is made.

use egui::{
    Align2, Id, Pos2, Rect, Response, Role, Sense, Stroke, StrokeKind, TextureId, Ui, Vec2,
};
use egui::{Key, Modifiers, WidgetInfo};
use motion_scene::color::ColorRole;
use motion_session::document::TakeId;
use motion_session::live::SearchState;

use super::cost_bar::cost_bar_ui;
use super::mini::MINI_PT;
use super::rename::rename_ui;
use super::{menu, score_text, way};
use crate::icons;
use crate::state::EditorState;
use crate::take_card::{TERMS, TakeCard};
use crate::theme;
use crate::widgets::digits::tabular;
use crate::widgets::icon_button::icon_button_ui;

/// Around the picture, points.
const INSET_PT: f32 = 5.0;

/// A card on its way to the timeline.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct CardDrag(pub TakeId);

/// What a card needs of the gallery.
pub struct Around {
    /// The cost at which its bar is full.
    pub worst: f64,
    /// Its picture, once it is drawn.
    pub mini: Option<TextureId>,
}

/// The card.
pub fn card_ui(ui: &mut Ui, take: &TakeCard, around: &Around, state: &mut EditorState) {
    let size = Vec2::new(ui.available_width(), MINI_PT.y + 2.0 * INSET_PT);
    let (_, rect) = ui.allocate_space(size);
    if !ui.is_rect_visible(rect) {
        return;
    }
    let response = ui.interact(rect, id_of(take.id), Sense::click_and_drag());
    let is_shown = state.shown() == Some(take.id);
    let is_new = take.is_new(state.clock_secs);
    let label = label_of(take, is_new);
    response.widget_info(|| WidgetInfo::selected(Role::ListItem, true, is_shown, &label));
    ground_ui(ui, rect, &response, take, is_shown, state);
    let picture = Rect::from_min_size(rect.min + Vec2::splat(INSET_PT), MINI_PT);
    picture_ui(ui, picture, take, around, state);
    words_ui(
        ui,
        rect.with_min_x(picture.right() + 8.0).shrink2(Vec2::new(4.0, 0.0)),
        take,
        around,
        state,
    );
    if response.has_focus() {
        keys_ui(ui, take, state);
    }
    if response.contains_pointer() {
        state.hovered_card = Some(take.id);
    }
    if response.double_clicked() {
        state.begin_renaming(take.id);
    } else if response.clicked() {
        match ui.input(|input| input.modifiers.shift) {
            true => state.toggle_compared(take.id),
            false => state.show_take(take.id),
        }
    }
    drag_ui(ui, &response, take);
    response.context_menu(|ui| menu::menu_ui(ui, take, state));
}

/// What egui calls a card.
fn id_of(take: TakeId) -> Id {
    Id::unique(("take card", take))
}

/// For tests and screen readers.
fn label_of(take: &TakeCard, is_new: bool) -> String {
    let mut label = format!("{}, cost {}", take.title(), score_text(take.score));
    for (is, words) in [
        (take.is_pinned, "pinned"),
        (take.is_by_hand, "changed by hand"),
        (take.is_stale, "for earlier constraints"),
        (is_new, "new"),
    ] {
        if is {
            label += &format!(", {words}");
        }
    }
    label
}

fn ground_ui(
    ui: &Ui,
    rect: Rect,
    response: &Response,
    take: &TakeCard,
    is_shown: bool,
    state: &EditorState,
) {
    let palette = theme::of(ui);
    let radius = f32::from(theme::RADIUS);
    let ground = match (is_shown, response.contains_pointer() || response.has_focus()) {
        (true, _) => palette.accent_surface,
        (false, true) => palette.hovered,
        (false, false) => palette.raised,
    };
    ui.painter().rect_filled(rect, radius, ground);
    if is_shown || response.has_focus() {
        let line = Stroke::new(1.0, palette.accent);
        ui.painter().rect_stroke(rect, radius, line, StrokeKind::Inside);
    }
    if state.is_compared(take.id) && !is_shown {
        let line = Stroke::new(1.5, theme::role(ColorRole::Take(take.hue), palette.theme));
        ui.painter().rect_stroke(rect, radius, line, StrokeKind::Inside);
    }
}

/// The picture, with the number that is its key.
fn picture_ui(ui: &Ui, place: Rect, take: &TakeCard, around: &Around, state: &EditorState) {
    let palette = theme::of(ui);
    match around.mini {
        Some(texture) => {
            use egui::emath::GuiRounding as _;
            let place = place.round_to_pixels(ui.ctx().pixels_per_point());
            egui::Image::from_texture((texture, place.size()))
                .corner_radius(3.0)
                .paint_at(ui, place);
        }
        None => {
            ui.painter().rect_filled(place, 3.0, palette.base);
            way::way_ui(ui, place.shrink(6.0), take, &state.marks);
        }
    }
    let plate =
        Rect::from_min_size(place.min, Vec2::new(if take.number < 10 { 16.0 } else { 22.0 }, 16.0));
    let color = theme::role(ColorRole::Take(take.hue), palette.theme);
    ui.painter().rect_filled(plate, 3.0, theme::over(palette.base, color, 0.35));
    let number = take.number.to_string();
    ui.painter().text(
        plate.center(),
        Align2::CENTER_CENTER,
        number,
        theme::caption(),
        palette.text,
    );
}

fn words_ui(ui: &mut Ui, room: Rect, take: &TakeCard, around: &Around, state: &mut EditorState) {
    let palette = theme::of(ui);
    let (left, right) = (room.left(), room.right() - 2.0);
    let y = |row: f32| room.top() + row;
    // What it costs.
    let job = tabular(ui, &score_text(take.score), &theme::body(), palette.text);
    let score = ui.fonts_mut(|fonts| fonts.layout_job(job));
    let score_left = right - score.size().x;
    let at = Pos2::new(score_left, y(16.0) - 0.5 * score.size().y);
    ui.painter().galley(at, score, palette.text);
    // What it is called.
    let title_place = Rect::from_x_y_ranges(left..=score_left - 6.0, y(6.0)..=y(27.0));
    if state.renaming.as_ref().is_some_and(|(id, _)| *id == take.id) {
        rename_ui(ui, title_place, take.id, state);
    } else {
        let painter = ui.painter().with_clip_rect(title_place);
        let at = title_place.left_center();
        painter.text(at, Align2::LEFT_CENTER, take.title(), theme::heading(), palette.text);
    }
    // How it is made.
    let cuts = match take.lane.cuts.len() {
        1 => "1 cut".to_owned(),
        n => format!("{n} cuts"),
    };
    let about = format!("{} f · {cuts}", take.n_frames());
    let at = Pos2::new(left, y(36.0));
    ui.painter().text(at, Align2::LEFT_CENTER, about, theme::caption(), palette.faint);
    badges_ui(ui, Pos2::new(right, y(36.0)), take, state);
    let bar = Rect::from_x_y_ranges(left..=right, y(54.0)..=y(60.0));
    cost_bar_ui(ui, bar, take.terms, around.worst);
    let touch = ui.interact(bar.expand(6.0), id_of(take.id).with("cost"), Sense::hover());
    touch.on_hover_ui(|ui| {
        ui.strong(format!("{} costs {}", take.title(), score_text(take.score)));
        for (name, term) in TERMS.iter().zip(take.terms).filter(|(_, term)| *term > 0.005) {
            ui.label(format!("{name} {term:.2}"));
        }
        if take.is_by_hand {
            ui.label("Changed by hand");
        }
        if let Some(cm) = take.lane.foot_slide_cm_per_s {
            ui.label(format!("Feet slide {cm:.1} cm/s"));
        }
    });
}

/// From the right: the pin, then what is to be known about it.
fn badges_ui(ui: &mut Ui, right: Pos2, take: &TakeCard, state: &mut EditorState) {
    let palette = theme::of(ui);
    let size = Vec2::splat(theme::ICON_BUTTON);
    let place = Rect::from_center_size(right - Vec2::new(0.5 * size.x - 4.0, 0.0), size);
    let is_near = state.shown() == Some(take.id) || state.hovered_card == Some(take.id);
    let mut x = right.x;
    if is_near {
        let mut child = ui.new_child(egui::UiBuilder::new().max_rect(place));
        let (icon, verb) = match take.is_pinned {
            true => (icons::UNPIN, "Unpin"),
            false => (icons::PIN, "Pin"),
        };
        let key =
            if take.number < 10 { format!(" (Shift+{})", take.number) } else { String::new() };
        let tooltip = match take.is_pinned {
            true => format!("Pinned: it stays whatever is found. Click to unpin{key}"),
            false => format!("Keep it with the project, whatever is found{key}"),
        };
        let label = format!("{verb} {}", take.title());
        if icon_button_ui(&mut child, icon, &label, &tooltip, take.is_pinned).clicked() {
            state.toggle_pin(take.id);
        }
        x -= theme::ICON_BUTTON;
    }
    let small = egui::FontId { size: 13.0, ..theme::icon() };
    let is_settled = state.search_state() == SearchState::Settled && !take.is_stale;
    let badges = [
        (take.is_pinned && !is_near, icons::PIN, palette.accent, "Pinned"),
        (take.is_by_hand, icons::HAND, palette.text, "Changed by hand; what it was is kept below"),
        (take.is_stale, icons::STALE, palette.faint, "For earlier constraints; it is made anew"),
        (is_settled, icons::DONE, palette.faint, "Settled: nothing near it is better"),
    ];
    for (is, icon, color, words) in badges {
        if !is {
            continue;
        }
        let at = Pos2::new(x - 8.0, right.y);
        ui.painter().text(at, Align2::CENTER_CENTER, icon, small.clone(), color);
        let touch = Rect::from_center_size(at, Vec2::splat(16.0));
        ui.interact(touch, id_of(take.id).with(words), Sense::hover()).on_hover_text(words);
        x -= 17.0;
    }
    if take.is_new(state.clock_secs) {
        ui.painter().text(
            Pos2::new(x - 2.0, right.y),
            Align2::RIGHT_CENTER,
            "new",
            theme::caption(),
            palette.accent,
        );
    }
}

/// Keys while the card has the focus.
fn keys_ui(ui: &Ui, take: &TakeCard, state: &mut EditorState) {
    let lock = egui::EventFilter { vertical_arrows: true, ..Default::default() };
    ui.memory_mut(|memory| memory.set_focus_lock_filter(id_of(take.id), lock));
    let pressed = |key| ui.input_mut(|input| input.consume_key(Modifiers::NONE, key));
    let nth = take.number.wrapping_sub(1);
    let next = match (pressed(Key::ArrowUp), pressed(Key::ArrowDown)) {
        (true, _) => nth.checked_sub(1),
        (_, true) => Some(nth + 1),
        _ => None,
    };
    if let Some(card) = next.and_then(|next| state.cards.get(next)) {
        ui.memory_mut(|memory| memory.request_focus(id_of(card.id)));
    }
}

/// A card that is dragged shows where it goes; the timeline says what it does there.
fn drag_ui(ui: &Ui, response: &Response, take: &TakeCard) {
    if !response.dragged() {
        return;
    }
    response.dnd_set_drag_payload(CardDrag(take.id));
    if let Some(at) = ui.input(|input| input.pointer.interact_pos()) {
        let palette = theme::of(ui);
        let layer = egui::LayerId::new(egui::Order::Tooltip, id_of(take.id));
        let painter = ui.ctx().layer_painter(layer);
        let words = format!("{} · drop on the timeline to lock a stretch", take.title());
        let galley = painter.layout_no_wrap(words, theme::caption(), palette.text);
        let at = at + Vec2::new(14.0, 10.0);
        let plate = Rect::from_min_size(at, galley.size()).expand2(Vec2::new(8.0, 4.0));
        painter.rect_filled(plate, f32::from(theme::RADIUS), palette.raised);
        painter.galley(at, galley, palette.text);
    }
}
