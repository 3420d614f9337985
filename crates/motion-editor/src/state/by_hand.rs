//! What is changed by hand on the shown take.
//!
//! Edits count the frames of the take before it is retimed, *source frames*; the playhead and the
//! timeline count those of the motion that is seen, *output frames*.

use std::sync::Arc;

use glam::{Quat, Vec3};
use motion_core::by_hand::Space;
use motion_core::ground::yaw_series_rad;
use motion_core::motion::Motion;
use motion_session::command::Command;
use motion_session::document::{ByHand, HandChange, HandEdit, StoredTake};
use motion_session::live::Take;
use motion_session::stage::actor::Actor;

use super::EditorState;
use crate::hand_time::{output_of, source_of};

/// A new edit comes and goes over so many frames.
pub const NEW_EASE_FRAMES: u32 = 12;

impl EditorState {
    /// The active character's take that is shown.
    fn shown_take(&self) -> Option<&Take> {
        self.session.snapshot().character(self.session.active())?.shown()
    }

    /// The kept take whose layer the shown one has: itself, or the nearest one that it was made of.
    /// The document is asked, which knows earlier than the search what was just done.
    fn hand_source(&self) -> Option<&StoredTake> {
        let found = self.session.snapshot().character(self.session.active())?;
        let shown = found.shown()?;
        let takes = self.session.document().takes();
        let with_layer = |id| takes.get(&found.name, id).filter(|stored| stored.by_hand.is_some());
        let mut at = Some(shown);
        // Nobody descends from more takes than there are.
        for _ in 0..=found.takes.len() {
            let Some(take) = at else { break };
            if let Some(stored) = with_layer(take.id) {
                return Some(stored);
            }
            at = take.parent.and_then(|parent| found.take(parent));
        }
        shown.by_hand.as_ref().and_then(|known| with_layer(known.from))
    }

    /// What is changed by hand on the shown take; `None` where it has no layer.
    pub fn hand_layer(&self) -> Option<&ByHand> {
        self.hand_source()?.by_hand.as_ref()
    }

    /// Whether the shown take is changed by hand at all.
    pub fn has_hand_edits(&self) -> bool {
        self.hand_layer().is_some_and(|layer| !layer.is_empty())
    }

    /// The shown take as commands speak of it, with its layer.
    pub fn hand_take(&self) -> Option<StoredTake> {
        let found = self.session.snapshot().character(self.session.active())?;
        let mut take = found.shown()?.stored(&found.name);
        take.by_hand = self.hand_layer().cloned();
        Some(take)
    }

    /// The shown take's motion without what is changed by hand, in its own time.
    pub fn motion_before_hand(&self) -> Option<&Arc<Motion>> {
        let made = self.shown_take()?.made.as_ref()?;
        Some(made.before_hand.as_ref().unwrap_or(&made.motion))
    }

    /// The active character as it moved before it was changed by hand; `None` where it is the same.
    pub fn actor_before_hand(&self) -> Option<Actor> {
        let before = self.shown_take()?.made.as_ref()?.before_hand.as_ref()?;
        let actor = self.stage.actors.get(self.session.active().0)?;
        let fits = before.n_joints() == actor.skeleton.n_joints();
        fits.then(|| Actor { motion: Arc::clone(before), ..actor.clone() })
    }

    /// Frames of the shown take before it is retimed, at least 1.
    pub fn n_source_frames(&self) -> usize {
        self.motion_before_hand().map_or(1, |motion| motion.n_frames())
    }

    fn source_frames(&self) -> Option<&Arc<[f64]>> {
        self.shown_take()?.made.as_ref()?.source_frames.as_ref()
    }

    /// The source frame that is shown at an output frame.
    pub fn source_frame(&self, output: f64) -> f64 {
        self.source_frames().map_or(output, |frames| source_of(frames, output))
    }

    /// The output frame at which a source frame is shown first.
    pub fn output_frame(&self, source: f64) -> f64 {
        self.source_frames().map_or(source, |frames| output_of(frames, source))
    }

    /// The source frame at the playhead, a whole one.
    pub fn hand_frame(&self) -> u32 {
        let last = self.n_source_frames() as f64 - 1.0;
        self.source_frame(self.frame()).round().clamp(0.0, last) as u32
    }

    /// The edit that is selected, with its id.
    pub fn selected_edit(&self) -> Option<(&str, &HandEdit)> {
        let id = self.selected_hand_edit.as_deref()?;
        let edit = self.hand_layer()?.edit(id)?;
        Some((id, edit)).filter(|_| self.selected().is_none())
    }

    /// Selects an edit, and nothing else.
    pub fn select_edit(&mut self, id: impl Into<String>) {
        self.session.selection_mut().clear();
        self.selected_knot = None;
        self.selected_hand_edit = Some(id.into());
    }

    /// Selects a knot of the timing, and nothing else.
    pub fn select_knot(&mut self, nth: usize) {
        self.session.selection_mut().clear();
        self.selected_hand_edit = None;
        self.selected_knot = Some(nth);
    }

    /// The selected knot of the timing, if it is there.
    pub fn knot_to_delete(&self) -> Option<usize> {
        let n = self.hand_layer()?.retime().knots().len();
        self.selected_knot.filter(|nth| *nth < n && self.selected().is_none())
    }

    /// Takes a knot of the timing away, as one step.
    pub fn remove_knot(&mut self, nth: usize) {
        let knots = self.hand_layer().map(|layer| layer.retime().knots().to_vec());
        let (Some(take), Some(mut knots)) = (self.hand_take(), knots) else { return };
        if nth < knots.len() {
            knots.remove(nth);
            self.apply_all("Delete a knot", &[Command::RetimeByHand { take, knots: Some(knots) }]);
        }
        self.selected_knot = None;
    }

    /// The edit of the same hand, foot or joint that is fully there at a source frame.
    pub fn edit_at(&self, what: &HandChange, frame: u32) -> Option<(&str, &HandEdit)> {
        let is_it = |edit: &HandEdit| is_same(&edit.change, what);
        let mut edits = self.hand_layer()?.edits();
        edits.find(|(_, edit)| is_it(edit) && (edit.from..=edit.to).contains(&frame))
    }

    /// A change of the source frame at the playhead, softly before and after it.
    pub fn new_edit(&self, change: HandChange) -> HandEdit {
        let frame = self.hand_frame();
        let ease = NEW_EASE_FRAMES;
        HandEdit { change, from: frame, to: frame, ease_in: ease, ease_out: ease }
    }

    /// Whether an edit has an effect at a source frame.
    pub fn is_changed_by_hand(&self, frame: u32) -> bool {
        let mut edits = self.hand_layer().into_iter().flat_map(|layer| layer.edits());
        edits.any(|(_, edit)| {
            let first = edit.from.saturating_sub(edit.ease_in);
            (first..=edit.to.saturating_add(edit.ease_out)).contains(&frame)
        })
    }

    /// Puts an edit on the shown take, as one step, and selects it.
    pub fn add_hand_edit(&mut self, change: HandChange) {
        let Some(take) = self.hand_take() else { return };
        let edit = self.new_edit(change);
        let id = take.by_hand.clone().unwrap_or_default().next_id(edit.change.kind());
        if self.apply(&Command::AddByHand { take, edit }) {
            self.select_edit(id);
        }
    }

    /// Moves the hand or foot of the selected edit by so much in the world, as one step.
    pub fn nudge_hand(&mut self, by_m: Vec3) {
        let Some((id, edit)) = self.selected_edit() else { return };
        let (id, mut edit) = (id.to_owned(), edit.clone());
        let HandChange::Hand { shift_m, space, .. } = &mut edit.change else { return };
        let by_m = match space {
            Space::World => by_m,
            Space::Torso => self.heading_by_hand().inverse() * by_m,
        };
        let to_tenth_mm = |metres: f64| (metres * 1e4).round() / 1e4 + 0.0;
        for (axis, by) in by_m.to_array().into_iter().enumerate() {
            shift_m[axis] = to_tenth_mm(shift_m[axis] + f64::from(by));
        }
        if let Some(take) = self.hand_take() {
            self.apply_all("Nudge", &[Command::ChangeByHand { take, id, edit }]);
        }
    }

    /// Where the body looks at the playhead, before it is changed by hand.
    pub fn heading_by_hand(&self) -> Quat {
        let yaw = self.motion_before_hand().map(|motion| yaw_series_rad(motion));
        let at = |yaw: Vec<f32>| yaw.get(self.hand_frame() as usize).copied();
        Quat::from_rotation_y(yaw.and_then(at).unwrap_or_default())
    }

    /// Takes an edit away, as one step.
    pub fn remove_hand_edit(&mut self, id: &str) {
        if let Some(take) = self.hand_take() {
            self.apply(&Command::RemoveByHand { take, id: id.to_owned() });
        }
        if self.selected_hand_edit.as_deref() == Some(id) {
            self.selected_hand_edit = None;
        }
    }

    /// Takes all away that was changed by hand on the shown take, as one step.
    pub fn clear_by_hand(&mut self) {
        self.selected_hand_edit = None;
        if let Some(take) = self.hand_take() {
            self.apply(&Command::ClearByHand { take });
        }
    }

    /// Whoever selects something else has no edit selected any more.
    pub(super) fn forget_edit(&mut self) {
        if self.selected().is_some() {
            self.selected_hand_edit = None;
            self.selected_knot = None;
        }
    }
}

/// Whether two changes are of the same hand, foot or joint.
fn is_same(a: &HandChange, b: &HandChange) -> bool {
    match (a, b) {
        (HandChange::Hand { limb: a, .. }, HandChange::Hand { limb: b, .. }) => a == b,
        (HandChange::Joint { joint: a, .. }, HandChange::Joint { joint: b, .. }) => a == b,
        _ => false,
    }
}
