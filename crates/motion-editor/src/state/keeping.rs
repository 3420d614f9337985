//! Takes that are pinned, named, asked for more of, or kept in part.

use motion_session::command::Command;
use motion_session::document::{StoredTake, TakeId};
use motion_session::playback::PlayRange;

use super::EditorState;
use crate::stretch::{pieces_in, stretch_at};
use crate::take_card::TakeCard;

impl EditorState {
    /// The card of a take.
    pub fn card(&self, id: TakeId) -> Option<&TakeCard> {
        self.cards.iter().find(|card| card.id == id)
    }

    /// Pins a take or no longer, as one step.
    pub fn toggle_pin(&mut self, id: TakeId) {
        let Some(card) = self.card(id) else { return };
        let character = self.session.active();
        let command = match card.is_pinned {
            true => Some(Command::UnpinTake { character, take: id }),
            false => self.stored(id).map(|take| Command::PinTake { take }),
        };
        if let Some(command) = command {
            self.apply(&command);
        }
    }

    /// Calls a take something, as one step; an empty name is none.
    pub fn name_take(&mut self, id: TakeId, name: &str) {
        let name = Some(name.trim().to_owned()).filter(|name| !name.is_empty());
        if self.card(id).is_none_or(|card| card.name == name) {
            return;
        }
        if let Some(take) = self.stored(id) {
            self.apply(&Command::NameTake { take, name });
        }
    }

    /// Begins to type a name on a take's card.
    pub fn begin_renaming(&mut self, id: TakeId) {
        let name = self.card(id).map(|card| card.name.clone().unwrap_or_default());
        self.renaming = name.map(|name| (id, name));
    }

    /// Looks for takes that share much with this one.
    pub fn more_like(&mut self, id: TakeId) {
        let Some(title) = self.card(id).map(TakeCard::title) else { return };
        let active = self.session.active();
        self.session.search().more_like(active, id);
        self.notices.tell(format!("Looking for more like {title}"));
    }

    /// What a take is made of, a line a piece, for the clipboard.
    pub fn recipe(&self, id: TakeId) -> Option<String> {
        let card = self.card(id)?;
        let mut lines = vec![format!("{} · cost {:.2}", card.title(), card.score)];
        for piece in &card.lane.pieces {
            let (from, to) = piece.of_clip;
            let last = piece.frames.end.saturating_sub(1);
            lines.push(format!("f {}–{last}: {} {from}–{to}", piece.frames.start, piece.clip));
        }
        Some(lines.join("\n"))
    }

    /// The takes that one was made of, the nearest first, as far as they are known.
    pub fn lineage(&self, id: TakeId) -> Vec<String> {
        let Some(found) = self.session.snapshot().character(self.session.active()) else {
            return Vec::new();
        };
        let mut said = Vec::new();
        let mut seen = vec![id];
        let mut at = id;
        while let Some(parent) = found.take(at).and_then(|take| take.parent) {
            if seen.contains(&parent) {
                break;
            }
            seen.push(parent);
            said.push(match self.card(parent) {
                Some(card) => card.title(),
                None => "a take that is not in the gallery any more".to_owned(),
            });
            at = parent;
        }
        said
    }

    /// The stretch of the shown take that a lock would keep: what is played where a part was chosen,
    /// else the piece under the pointer or at the playhead. Both ends included.
    pub fn stretch_to_lock(&self) -> Option<(usize, usize)> {
        let card = self.shown_card()?;
        match self.session.playback().chosen_range() {
            Some(_) => {
                let PlayRange { from, to } = self.session.playback().range();
                Some((from as usize, to as usize))
            }
            None => stretch_at(&card.lane, self.hovered_source.unwrap_or(self.frame_number())),
        }
    }

    /// Keeps the chosen stretch of the shown take.
    pub fn lock_stretch(&mut self) {
        if let (Some(id), Some((from, to))) = (self.shown(), self.stretch_to_lock()) {
            self.lock(id, from, to);
        }
    }

    /// Keeps of a take what lies between the cuts around `frame`.
    pub fn lock_at(&mut self, id: TakeId, frame: usize) {
        let stretch = self.card(id).and_then(|card| stretch_at(&card.lane, frame));
        stretch.into_iter().for_each(|(from, to)| self.lock(id, from, to));
    }

    fn lock(&mut self, id: TakeId, from: usize, to: usize) {
        let Some(card) = self.card(id) else { return };
        let (pieces, title) = (pieces_in(&card.lane, from, to), card.title());
        if pieces.is_empty() {
            return;
        }
        let character = self.session.active();
        let (from, to) = (from as u32, to as u32);
        if self.apply(&Command::AddLock { character, from, to, pieces }) {
            self.notices.tell(format!("Locked f {from}–{to} of {title}"));
        }
    }

    fn stored(&self, id: TakeId) -> Option<StoredTake> {
        let found = self.session.snapshot().character(self.session.active())?;
        Some(found.take(id)?.stored(&found.name))
    }
}
