//! Small pictures of takes, drawn one a frame and kept as long as their takes are there.

use std::sync::Arc;

use egui::TextureId;
use motion_core::motion::Motion;
use motion_scene::color::Theme;
use motion_session::document::TakeId;

use super::mini::{MINI_PT, mini};
use crate::take_card::TakeCard;
use crate::viewport::canvas::Canvas;

/// On finer screens than this a picture is not drawn finer.
const MAX_PIXELS_PER_POINT: f32 = 2.0;

/// The pictures.
#[derive(Debug, Default)]
pub struct Minis {
    known: Vec<Mini>,
    looks: Option<(Theme, f32)>,
}

/// The picture of a motion. It keeps the motion, so that no other one can be taken for it.
#[derive(Debug)]
struct Mini {
    id: TakeId,
    hue: usize,
    motion: Arc<Motion>,
    texture: TextureId,
}

impl Minis {
    /// The picture of a take; while there is none of its motion, of the motion that it came from.
    pub fn of(&self, card: &TakeCard, cards: &[TakeCard]) -> Option<TextureId> {
        self.own(card).or_else(|| self.stand_in(card, cards)).map(|mini| mini.texture)
    }

    fn own(&self, card: &TakeCard) -> Option<&Mini> {
        self.known.iter().find(|mini| is_of(mini, card))
    }

    /// The take before an edit, or the one that this was made of: it has left its hue.
    fn stand_in(&self, card: &TakeCard, cards: &[TakeCard]) -> Option<&Mini> {
        let is_gone = |mini: &&Mini| cards.iter().all(|card| card.id != mini.id);
        let same = self.known.iter().find(|mini| mini.id == card.id);
        same.or_else(|| self.known.iter().filter(is_gone).find(|mini| mini.hue == card.hue))
    }

    /// How many there are.
    pub fn len(&self) -> usize {
        self.known.len()
    }

    /// Whether there is none.
    pub fn is_empty(&self) -> bool {
        self.known.is_empty()
    }

    /// Draws one that is missing, the shown take's first, and lets go of those that no card has.
    /// Gives whether more are missing.
    pub fn keep_up(
        &mut self,
        cards: &[TakeCard],
        shown: Option<TakeId>,
        canvas: &mut Canvas,
        theme: Theme,
        pixels_per_point: f32,
    ) -> bool {
        let scale = pixels_per_point.min(MAX_PIXELS_PER_POINT);
        if self.looks.replace((theme, scale)) != Some((theme, scale)) {
            self.known.drain(..).for_each(|mini| canvas.free(mini.texture));
        }
        let missing: Vec<&TakeCard> =
            cards.iter().filter(|card| self.own(card).is_none()).collect();
        let of_shown = missing.iter().find(|card| Some(card.id) == shown);
        if let Some(card) = of_shown.or(missing.first()) {
            let (scene, camera) = mini(&card.actor, card.hue, theme);
            canvas.set_model(card.actor.figure.mesh, &card.actor.figure.model);
            let texture = canvas.still(&scene, camera, MINI_PT, scale);
            let motion = Arc::clone(&card.actor.motion);
            self.known.push(Mini { id: card.id, hue: card.hue, motion, texture });
        }
        let picture = |card: &TakeCard| self.of(card, cards);
        let wanted: Vec<TextureId> = cards.iter().filter_map(picture).collect();
        self.known.retain(|mini| {
            let stays = wanted.contains(&mini.texture);
            if !stays {
                canvas.free(mini.texture);
            }
            stays
        });
        missing.len() > 1
    }
}

fn is_of(mini: &Mini, card: &TakeCard) -> bool {
    mini.hue == card.hue && Arc::ptr_eq(&mini.motion, &card.actor.motion)
}
