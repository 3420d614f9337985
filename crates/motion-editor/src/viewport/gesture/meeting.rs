//! A member of a meeting brought to another place beside the first.

use egui::Pos2;
use motion_session::command::Command;
use motion_session::selection::Selectable;

use super::sight::Sight;
use super::snap::{GRID_M, snapped};
use crate::meeting;
use crate::state::EditorState;
use crate::state::moving::rounded;

/// A member on its way.
#[derive(Clone, Debug)]
pub struct MeetingPull {
    id: String,
    member: usize,
    grabbed_m: [f64; 2],
    /// Where it stood in the world.
    from_m: [f64; 2],
}

impl MeetingPull {
    /// Takes hold of a member; the first stays where the shown motion is, so only others go.
    pub fn begin(
        id: &str,
        member: usize,
        grabbed: Pos2,
        sight: &Sight,
        state: &mut EditorState,
    ) -> Option<Self> {
        state.session.selection_mut().select(Selectable::Interaction(id.to_owned()));
        let grabbed_m = sight.floor(grabbed)?;
        let wish = state.meeting_wish(id)?;
        let from = wish.places.get(member).filter(|_| member > 0)?.ground_m();
        let from_m = [f64::from(from.x), f64::from(from.y)];
        state.begin_gesture("Change meeting");
        Some(Self { id: id.to_owned(), member, grabbed_m, from_m })
    }

    /// What brings it to the pointer.
    pub fn commands(
        &self,
        sight: &Sight,
        pointer: Pos2,
        is_snapping: bool,
        state: &EditorState,
    ) -> Vec<Command> {
        let Some(floor_m) = sight.floor(pointer) else { return Vec::new() };
        let to_m = [0, 1].map(|axis| self.from_m[axis] + floor_m[axis] - self.grabbed_m[axis]);
        let wish = state.meeting_wish(&self.id);
        let Some(anchor) = wish.and_then(|wish| wish.places.first().copied()) else {
            return Vec::new();
        };
        let settled = state.session.history().settled();
        let Some(known) = settled.interaction(&self.id) else { return Vec::new() };
        let (_, heading_deg) = meeting::beside_first(known, self.member);
        let [ahead, left] = meeting::seen_from(anchor, to_m)
            .map(|metres| rounded(snapped(metres, GRID_M, is_snapping)));
        meeting::with_beside(known, self.member, [ahead, left], heading_deg).into_iter().collect()
    }

    /// How it stands to the first, in words.
    pub fn words(&self, state: &EditorState) -> Option<String> {
        let known = state.session.document().interaction(&self.id)?;
        let ([ahead, left], heading_deg) = meeting::beside_first(known, self.member);
        Some(format!("{ahead:.2} m ahead · {left:.2} m to the left · turned {heading_deg:.0}°"))
    }
}
