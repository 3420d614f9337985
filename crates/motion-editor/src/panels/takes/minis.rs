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
    /// The picture of a take; of its motion before the last edit while there is none of this one.
    pub fn of(&self, card: &TakeCard) -> Option<TextureId> {
        let is = |mini: &&Mini| is_of(mini, card);
        let own = self.known.iter().find(is);
        own.or_else(|| self.known.iter().find(|mini| mini.id == card.id)).map(|mini| mini.texture)
    }

    /// How many there are.
    pub fn len(&self) -> usize {
        self.known.len()
    }

    /// Whether there is none.
    pub fn is_empty(&self) -> bool {
        self.known.is_empty()
    }

    /// Draws one that is missing, and lets go of those that no card has. Gives whether more are
    /// missing.
    pub fn keep_up(
        &mut self,
        cards: &[TakeCard],
        canvas: &mut Canvas,
        theme: Theme,
        pixels_per_point: f32,
    ) -> bool {
        let scale = pixels_per_point.min(MAX_PIXELS_PER_POINT);
        if self.looks.replace((theme, scale)) != Some((theme, scale)) {
            self.known.drain(..).for_each(|mini| canvas.free(mini.texture));
        }
        let missing: Vec<&TakeCard> =
            cards.iter().filter(|card| !self.known.iter().any(|mini| is_of(mini, card))).collect();
        if let Some(card) = missing.first() {
            let (scene, camera) = mini(&card.actor, card.hue, theme);
            canvas.set_model(card.actor.figure.mesh, &card.actor.figure.model);
            let texture = canvas.still(&scene, camera, MINI_PT, scale);
            let motion = Arc::clone(&card.actor.motion);
            self.known.push(Mini { id: card.id, hue: card.hue, motion, texture });
        }
        // A picture from before the last edit stays until there is one from after it.
        let newer: Vec<TakeId> =
            self.known.iter().filter(|m| cards.iter().any(|c| is_of(m, c))).map(|m| m.id).collect();
        self.known.retain(|mini| {
            let has_own = cards.iter().any(|card| is_of(mini, card));
            let stands_in =
                cards.iter().any(|card| card.id == mini.id) && !newer.contains(&mini.id);
            let stays = has_own || stands_in;
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
