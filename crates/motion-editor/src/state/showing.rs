//! Which take is shown.

use motion_session::document::TakeId;

use super::EditorState;
use crate::take_card::TakeCard;

impl EditorState {
    /// The id of the active character's take that is shown.
    pub fn shown(&self) -> Option<TakeId> {
        self.session.shown().map(|shown| shown.take.id)
    }

    /// The card of the take that is shown.
    pub fn shown_card(&self) -> Option<&TakeCard> {
        let shown = self.shown()?;
        self.cards.iter().find(|card| card.id == shown)
    }

    /// Shows a take of the active character from now on, at the same frame. The search hears of it
    /// and answers in a later snapshot.
    pub fn show_take(&mut self, id: TakeId) {
        if self.shown() != Some(id) {
            self.shown_before = self.shown();
            self.session.pick(self.session.active(), id);
        }
    }

    /// Shows the take on card number `nth`, from 0.
    pub fn show_card(&mut self, nth: usize) {
        let id = self.cards.get(nth).map(|card| card.id);
        id.into_iter().for_each(|id| self.show_take(id));
    }

    /// By how much another take is better than the shown one, percent, and which.
    pub fn better(&self) -> Option<(TakeId, f32)> {
        let active = self.session.snapshot().character(self.session.active())?;
        active.better.as_ref().map(|better| (better.take, better.by_percent))
    }
}
