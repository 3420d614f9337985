//! Takes that are looked at beside the shown one.

use motion_session::document::TakeId;

use super::EditorState;
use crate::take_card::TakeCard;

/// More than so many beside the shown one nobody can tell apart.
pub const MAX_COMPARED: usize = 3;

/// How takes are looked at beside the shown one.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Default)]
pub enum CompareMode {
    /// They are not.
    #[default]
    Off,
    /// In the same view, each in its colour.
    Overlay,
    /// Each in a view of its own, with the same camera.
    Split,
}

/// What is compared, and how.
#[derive(Clone, Debug, PartialEq, Eq, Default)]
pub struct Comparing {
    /// How.
    pub mode: CompareMode,
    /// The takes beside the shown one, in the order of choosing.
    pub takes: Vec<TakeId>,
}

impl EditorState {
    /// The cards of the takes that are compared with the shown one; none while nothing is compared.
    pub fn compared_cards(&self) -> Vec<&TakeCard> {
        if self.comparing.mode == CompareMode::Off {
            return Vec::new();
        }
        let shown = self.shown();
        let of = |id: &TakeId| self.cards.iter().find(|card| card.id == *id);
        let others = self.comparing.takes.iter().filter(|id| Some(**id) != shown);
        others.filter_map(of).take(MAX_COMPARED).collect()
    }

    /// Whether a take is among those that are compared.
    pub fn is_compared(&self, id: TakeId) -> bool {
        self.comparing.mode != CompareMode::Off && self.comparing.takes.contains(&id)
    }

    /// Compares a take too, or no longer.
    pub fn toggle_compared(&mut self, id: TakeId) {
        if self.comparing.mode == CompareMode::Off {
            self.comparing = Comparing { mode: CompareMode::Overlay, takes: Vec::new() };
        }
        let takes = &mut self.comparing.takes;
        match takes.iter().position(|known| *known == id) {
            Some(at) => drop(takes.remove(at)),
            None => takes.push(id),
        }
        // The one that was chosen longest ago makes room.
        let too_many = takes.len().saturating_sub(MAX_COMPARED);
        takes.drain(..too_many);
        if takes.is_empty() {
            self.comparing.mode = CompareMode::Off;
        }
    }

    /// Compares in this way, or no longer.
    pub fn toggle_comparing(&mut self, mode: CompareMode) {
        if self.comparing.mode == mode {
            self.comparing.mode = CompareMode::Off;
            return;
        }
        let shown = self.shown();
        let is_other = |id: &TakeId| Some(*id) != shown;
        if !self.comparing.takes.iter().any(is_other) {
            // The one that was seen before, else the best other one.
            let known = |id: &TakeId| self.cards.iter().any(|card| card.id == *id);
            let before = self.shown_before.filter(known).filter(is_other);
            let best = self.cards.iter().map(|card| card.id).find(is_other);
            self.comparing.takes = before.or(best).into_iter().collect();
        }
        self.comparing.mode = match self.comparing.takes.is_empty() {
            true => CompareMode::Off,
            false => mode,
        };
    }

    /// Takes that are gone are not compared any more.
    pub(super) fn forget_gone_takes(&mut self) {
        let is_there = |id: &TakeId| self.cards.iter().any(|card| card.id == *id);
        self.comparing.takes.retain(is_there);
        if self.comparing.takes.is_empty() {
            self.comparing.mode = CompareMode::Off;
        }
        self.hovered_card = self.hovered_card.filter(is_there);
    }
}
