//! Other takes beside the shown one: in the same view, or each in its own with the same camera.

use egui::{Align2, Color32, Pos2, Rect, Role, Sense, Stroke, Ui, Vec2, WidgetInfo};
use glam::Vec3;
use motion_scene::body::Look;
use motion_scene::camera::OrbitCamera;
use motion_scene::color::ColorRole;
use motion_scene::label::{Anchor, LABEL_PT, Label, LabelPlace};
use motion_scene::line::Occlusion;
use motion_scene::scene::Scene;

use super::canvas::Canvas;
use super::{navigation, show};
use crate::state::{CompareMode, EditorState};
use crate::take_card::TakeCard;
use crate::theme;

/// Between two views, points.
const GAP_PT: f32 = 2.0;
/// Over a head, metres: where a take's name stands.
const OVER_HEAD_M: f32 = 0.08;
/// Those that are compared walk beside each other: each name stands so much higher, metres.
const NAME_STEP_M: f32 = 0.17;
/// How much of its take's colour a body has that is compared.
const TINT: f32 = 0.75;

/// How many views there are, the main one counted.
pub fn n_views(state: &EditorState) -> usize {
    match state.comparing.mode {
        CompareMode::Split => 1 + state.compared_cards().len(),
        CompareMode::Off | CompareMode::Overlay => 1,
    }
}

/// How large the main view is among `n` in a place of this size.
pub fn size_of_main(whole: Vec2, n: usize) -> Vec2 {
    places(Rect::from_min_size(Pos2::ZERO, whole), n)[0].size()
}

/// Where the views are, the main one first: two side by side, or four.
fn places(whole: Rect, n: usize) -> Vec<Rect> {
    let (columns, rows) = match n {
        0 | 1 => return vec![whole],
        2 => (2, 1),
        _ => (2, 2),
    };
    let gaps = Vec2::new((columns - 1) as f32, (rows - 1) as f32) * GAP_PT;
    let size =
        ((whole.size() - gaps) / Vec2::new(columns as f32, rows as f32)).max(Vec2::splat(1.0));
    let place = |nth: usize| {
        let cell = Vec2::new((nth % columns) as f32, (nth / columns) as f32);
        Rect::from_min_size(whole.min + cell * (size + Vec2::splat(GAP_PT)), size)
    };
    (0..columns * rows).map(place).collect()
}

/// The take whose card the pointer is over as a ghost, and in an overlay those that are compared,
/// each in its colour with its name; at the same moment as the shown one.
pub fn add_others(scene: &mut Scene, state: &EditorState) {
    let shown = state.shown();
    let compared = match state.comparing.mode {
        CompareMode::Overlay => state.compared_cards(),
        CompareMode::Off | CompareMode::Split => Vec::new(),
    };
    for (nth, card) in compared.iter().enumerate() {
        let hue = ColorRole::Take(card.hue).color(scene.theme);
        let plain = ColorRole::Body.color(scene.theme);
        let look = Look::Solid(plain.mixed(hue, TINT));
        scene.bodies.push(card.actor.body_at(state.frame(), look));
        scene.labels.extend(label(card, state.frame(), nth + 1, scene));
    }
    if !compared.is_empty()
        && let Some(card) = state.shown_card()
    {
        scene.labels.extend(label(card, state.frame(), 0, scene));
    }
    let is_seen = |card: &&TakeCard| {
        Some(card.id) == shown || compared.iter().any(|other| other.id == card.id)
    };
    let hovered = state.hovered_card.and_then(|id| state.card(id)).filter(|card| !is_seen(card));
    if let Some(card) = hovered {
        let look = Look::ghost(ColorRole::Take(card.hue), scene.theme);
        scene.bodies.push(card.actor.body_at(state.frame(), look));
        scene.labels.extend(label(card, state.frame(), compared.len() + 1, scene));
    }
}

/// A take's name over its head, `nth` steps higher.
fn label(card: &TakeCard, frame: f64, nth: usize, scene: &Scene) -> Option<Label> {
    let bounds = card.actor.bounds_at(frame)?;
    let over_m: Vec3 =
        bounds.center().with_y(bounds.max_m.y + OVER_HEAD_M + nth as f32 * NAME_STEP_M);
    Some(Label {
        text: card.title(),
        place: LabelPlace::World(over_m),
        anchor: Anchor::Below,
        clear_m: 0.0,
        occlusion: Occlusion::Shown,
        size_pt: LABEL_PT,
        color: ColorRole::Text.color(scene.theme),
        plate: Some(ColorRole::TextPlate.color(scene.theme).with_alpha(0.82)),
    })
}

/// The views beside the main one. A click in one shows its take; drags move the one camera.
pub fn others_ui(
    ui: &Ui,
    whole: Rect,
    canvas: &mut Canvas,
    camera: &mut OrbitCamera,
    state: &mut EditorState,
) {
    let n = n_views(state);
    canvas.keep_beside(n - 1);
    if n == 1 {
        return;
    }
    let palette = theme::of(ui);
    let places = places(whole, n);
    // Between the views, and where there are three for four places.
    let clip = ui.painter().with_clip_rect(whole);
    for place in &places[1..] {
        clip.rect_filled(place.expand2(Vec2::new(GAP_PT, GAP_PT)), 0.0, palette.base);
    }
    let cards: Vec<TakeCard> = state.compared_cards().into_iter().cloned().collect();
    let pixels_per_point = ui.ctx().pixels_per_point();
    let image = Rect::from_min_max(Pos2::ZERO, Pos2::new(1.0, 1.0));
    let mut clicked = None;
    for (nth, (card, place)) in cards.iter().zip(&places[1..]).enumerate() {
        let response =
            ui.interact(*place, ui.scope_id().with(("beside", nth)), Sense::click_and_drag());
        let label = format!("View of {}", card.title());
        response.widget_info(|| WidgetInfo::labeled(Role::Canvas, true, &label));
        let scheme = state.settings.navigation;
        let moved = navigation::navigate_ui(
            ui,
            &response,
            camera,
            scheme,
            super::gesture::Claim::default(),
        );
        if moved.across {
            state.settings.follow = false;
        }
        let Some(scene) = scene_of(card, state) else { continue };
        let texture = canvas.draw_beside(nth, scene, *camera, place.size(), pixels_per_point);
        ui.painter().image(texture, *place, image, Color32::WHITE);
        let color = theme::role(ColorRole::Take(card.hue), palette.theme);
        ui.painter().hline(place.x_range(), place.top() + 1.0, Stroke::new(2.0, color));
        let at = place.min + Vec2::splat(12.0);
        let (font, title) = (theme::heading(), card.title());
        let line = ui.painter().text(at, Align2::LEFT_TOP, title, font, palette.text);
        let about = format!("cost {:.2} · click to show", card.score);
        let below = line.left_bottom() + Vec2::new(0.0, 2.0);
        ui.painter().text(below, Align2::LEFT_TOP, about, theme::caption(), palette.faint);
        if response.clicked() {
            clicked = Some(card.id);
        }
    }
    if let Some(id) = clicked {
        // They change places, so that no take is lost from sight.
        let shown = state.shown();
        for known in state.comparing.takes.iter_mut().filter(|known| **known == id) {
            *known = shown.unwrap_or(id);
        }
        state.show_take(id);
    }
}

/// What is around a take, with the take instead of the shown one.
fn scene_of(card: &TakeCard, state: &EditorState) -> Option<Scene> {
    let mut stage = state.stage.clone();
    let active = state.session.active().0;
    *stage.actors.get_mut(active)? = card.actor.clone();
    if let Some(role) = stage.roles.get_mut(active) {
        role.misses = card.lane.misses.clone();
        role.root_path_m = card.actor.motion.root_positions_m().to_vec();
    }
    let show = show::choices(state);
    Some(stage.scene_at(state.frame(), show).scene)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn views_do_not_overlap_and_fill_their_place() {
        let whole = Rect::from_min_size(Pos2::new(10.0, 20.0), Vec2::new(802.0, 402.0));
        for (n, n_places, size) in [
            (0, 1, (802.0, 402.0)),
            (1, 1, (802.0, 402.0)),
            (2, 2, (400.0, 402.0)),
            (4, 4, (400.0, 200.0)),
        ] {
            let places = places(whole, n);
            assert_eq!(places.len(), n_places, "{n}");
            assert_eq!(places[0].size(), Vec2::new(size.0, size.1));
            assert_eq!(size_of_main(whole.size(), n), places[0].size());
            for (nth, place) in places.iter().enumerate() {
                assert!(whole.contains_rect(*place), "{n}: {place:?}");
                let overlaps = |other: &Rect| other.intersect(*place).is_positive();
                assert!(!places[..nth].iter().any(overlaps), "{n}: {nth}");
            }
        }
        assert_eq!(places(whole, 3).len(), 4);
    }
}
