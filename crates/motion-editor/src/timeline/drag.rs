//! What the left button is dragging on the timeline.

use std::collections::BTreeSet;

use egui::{Pos2, Rect, Ui};
use motion_session::playback::PlayRange;
use motion_session::selection::Selectable;
use motion_session::{Interaction, LengthMode};

use super::axis::Axis;
use super::hand_drag::HandGrab;
use super::length_handle;
use super::retime::{Grab, Part};
use super::style_drag;
use crate::mark::Mark;
use crate::state::EditorState;

/// A million frames are nine hours; nothing is dragged further.
const MAX_FRAMES: usize = 1_000_000;
/// Marks move when the pointer is further from where it was pressed than this, points.
const THRESHOLD_PT: f32 = 6.0;
/// Beyond an edge what is shown moves along, for each point so many points a second.
const PAN_PER_SEC: f32 = 8.0;

/// A drag. All begin with a press on something and end with its release, or with Escape as if they
/// had not been.
#[derive(Debug)]
pub enum Drag {
    /// Marks to other frames, held at so many frames behind the one that counts.
    Retime(Grab, f64),
    /// A new style, from this moment to the pointer's.
    Style(f64),
    /// A meeting, which was this, held at so many frames behind it; whether it has been moved.
    Meeting(Box<Interaction>, f64, bool),
    /// A change by hand to other frames.
    ByHand(Box<HandGrab>),
    /// The end of the motion; the mode it has from then on, and whether it has been moved.
    Length(LengthMode, bool),
    /// The played part, which was this, held at so many frames behind its beginning.
    Loop(Part, PlayRange, f64),
    /// The playhead, which was here.
    Scrub(f64),
    /// A rubber band from here, and what was selected before.
    Box(BoxSelect),
}

/// A rubber band.
#[derive(Debug)]
pub struct BoxSelect {
    /// Where it began: the moment, and how far below the first row.
    pub from: (f64, f32),
    /// What was selected and stays so.
    pub kept: Vec<Selectable>,
    /// What was selected, for Escape.
    pub before: Vec<Selectable>,
}

impl Drag {
    /// Brings marks to other frames.
    pub fn retime(grab: Grab, press: f64, state: &mut EditorState) -> Self {
        state.begin_gesture(if grab.part() == Part::Whole { "Retime" } else { "Stretch" });
        let off = press - f64::from(edge(&grab));
        Self::Retime(grab, off)
    }

    /// Makes the motion longer or shorter.
    pub fn length(state: &mut EditorState) -> Self {
        let (_, mode) = length_handle::wished(state);
        state.begin_gesture("Change length");
        Self::Length(if mode == LengthMode::Free { LengthMode::Preferred } else { mode }, false)
    }

    /// Whether it changes the document, and so is a gesture of its history.
    fn is_gesture(&self) -> bool {
        matches!(
            self,
            Self::Retime(..)
                | Self::Style(_)
                | Self::Meeting(..)
                | Self::ByHand(_)
                | Self::Length(..)
        )
    }

    /// Whether it is one of marks or lengths that has not moved them yet.
    fn is_at_rest(&self) -> bool {
        match self {
            Self::Retime(grab, _) => grab.done.is_none(),
            Self::ByHand(grab) => grab.done.is_none(),
            Self::Length(_, has_moved) | Self::Meeting(_, _, has_moved) => !has_moved,
            Self::Style(_) | Self::Loop(..) | Self::Scrub(_) | Self::Box(_) => false,
        }
    }

    /// Goes on with the drag. Gives it back while it lasts.
    pub fn ui(
        mut self,
        ui: &Ui,
        axis: &mut Axis,
        lanes: Rect,
        state: &mut EditorState,
    ) -> Option<Self> {
        let goes_on =
            if self.is_gesture() { state.is_in_gesture() } else { state.is_dragging_beside };
        if !goes_on {
            // Escape has ended it.
            self.restore(state);
            return None;
        }
        let (is_down, at, dt) = ui.input(|input| {
            (input.pointer.primary_down(), input.pointer.interact_pos(), input.stable_dt)
        });
        if !is_down {
            if self.is_gesture() {
                let n_before = state.session.history().n_steps().0;
                state.commit();
                if matches!(self, Self::Style(_)) && state.session.history().n_steps().0 > n_before
                {
                    state.select_newest();
                }
            }
            state.is_dragging_beside = false;
            return None;
        }
        let Some(at) = at else { return Some(self) };
        if self.is_at_rest() {
            // egui also takes a long press for a drag, but a shaky one must move nothing.
            let press = ui.input(|input| input.pointer.press_origin());
            if press.is_none_or(|press| press.distance(at) <= THRESHOLD_PT) {
                return Some(self);
            }
        }
        let beyond = (at.x - lanes.right()).max(0.0) + (at.x - lanes.left()).min(0.0);
        if beyond != 0.0 {
            let n_frames = state.n_frames_asked().max(axis.last_in_view() as usize);
            axis.pan(-beyond * PAN_PER_SEC * dt.min(0.1), n_frames);
            ui.ctx().request_repaint();
        }
        let at = Pos2::new(at.x.clamp(lanes.left(), lanes.right()), at.y);
        let (is_free, shift) = ui.input(|input| (input.modifiers.alt, input.modifiers.shift));
        self.follow(at, axis, (is_free, shift), state);
        Some(self)
    }

    /// Does what the pointer says now.
    fn follow(
        &mut self,
        at: Pos2,
        axis: &Axis,
        (is_free, shift): (bool, bool),
        state: &mut EditorState,
    ) {
        match self {
            Self::ByHand(grab) => {
                let commands = grab.commands(axis.frame_at(at.x), state);
                if !commands.is_empty() {
                    state.preview(&commands);
                }
            }
            Self::Style(from) => {
                let snaps = snaps(state, |_| false);
                let snap = |x: f32| axis.snap(x, &snaps, is_free, MAX_FRAMES) as u32;
                let (a, b) = (snap(axis.x_of(*from)), snap(at.x));
                // The later edge is where the next frame would begin.
                if let Some(to) = a.max(b).checked_sub(1).filter(|to| *to >= a.min(b)) {
                    state.preview(&style_drag::commands(state, a.min(b), to));
                }
            }
            Self::Meeting(known, off, has_moved) => {
                *has_moved = true;
                let snaps = snaps(state, |_| false);
                let x = axis.x_of(axis.frame_at(at.x) - *off);
                let frame = axis.snap(x, &snaps, is_free, MAX_FRAMES) as u32;
                state.preview(&state.retime_meeting(known, frame));
            }
            Self::Retime(grab, off) => {
                let snaps = snaps(state, |mark| grab.moves(&mark.at, shift));
                let x = axis.x_of(axis.frame_at(at.x) - *off);
                let frame = axis.snap(x, &snaps, is_free, MAX_FRAMES) as i64;
                let by = frame - i64::from(edge(grab));
                if grab.done != Some((by, shift)) {
                    grab.done = Some((by, shift));
                    state.preview(&state.retime_commands(grab, by, shift));
                }
            }
            Self::Length(mode, has_moved) => {
                *has_moved = true;
                let snaps = snaps(state, |_| false);
                let frames = axis.snap(at.x, &snaps, is_free, MAX_FRAMES).max(1) as u32;
                if length_handle::wished(state) != (frames, *mode) {
                    state.preview(&[length_handle::command(state, frames, *mode)]);
                }
            }
            Self::Loop(part, before, off) => {
                let snaps = snaps(state, |_| false);
                let last = state.last_frame() as u32;
                let frame = |x: f32| axis.snap(x, &snaps, is_free, state.n_frames() + 1) as u32;
                let (from, to) = (before.from, before.to.min(last));
                let range = match part {
                    Part::Start => PlayRange { from: frame(at.x).min(to), to },
                    Part::End => {
                        PlayRange { from, to: frame(at.x).saturating_sub(1).clamp(from, last) }
                    }
                    Part::Whole => {
                        let width = to.saturating_sub(from);
                        let left = axis.x_of(axis.frame_at(at.x) - *off);
                        let from = frame(left).min(last.saturating_sub(width));
                        PlayRange { from, to: from + width }
                    }
                };
                state.set_range(Some(range));
            }
            Self::Scrub(_) => {
                let mut stops = state.stops();
                stops.extend(
                    state
                        .chosen_range()
                        .into_iter()
                        .flat_map(|range| [range.from as usize, range.to as usize]),
                );
                let frame = axis.snap(at.x, &stops, is_free, state.n_frames());
                state.stop_at(frame);
            }
            // Which marks it touches is known while they are drawn.
            Self::Box(_) => {}
        }
    }

    /// Has everything as it was.
    fn restore(self, state: &mut EditorState) {
        match self {
            Self::Retime(..)
            | Self::Style(_)
            | Self::Meeting(..)
            | Self::ByHand(_)
            | Self::Length(..) => {}
            Self::Loop(_, before, _) => state.set_range(Some(before)),
            Self::Scrub(before) => state.seek(before),
            Self::Box(band) => state.session.selection_mut().select_all(band.before),
        }
    }
}

/// Where what is held begins; the end of a stretch is a whole frame, so its edge is one further.
fn edge(grab: &Grab) -> u32 {
    grab.frame() + u32::from(grab.part() == Part::End)
}

/// Frames that are snapped to: the playhead, cuts, and marks that do not move.
fn snaps(state: &EditorState, moves: impl Fn(&Mark) -> bool) -> Vec<usize> {
    let mut snaps = vec![state.frame_number()];
    if let Some(card) = state.shown_card() {
        snaps.extend(card.lane.cuts.iter().map(|cut| cut.frame));
    }
    for mark in state.marks.iter().filter(|mark| !moves(mark)) {
        let (from, to) = mark.span();
        snaps.push(from as usize);
        if to > from {
            snaps.push(to as usize + 1);
        }
    }
    snaps
}

impl BoxSelect {
    /// The band on the screen.
    pub fn rect(&self, axis: &Axis, rows_top: f32, to: Pos2) -> Rect {
        let from = Pos2::new(axis.x_of(self.from.0), rows_top + self.from.1);
        Rect::from_two_pos(from, to)
    }

    /// Selects the marks that it touches.
    pub fn select(&self, touched: &BTreeSet<usize>, state: &mut EditorState) {
        let touched: Vec<Selectable> = touched
            .iter()
            .filter_map(|index| state.marks.get(*index))
            .map(|mark| Selectable::Constraint(mark.at.clone()))
            .collect();
        let all = self.kept.iter().cloned().chain(touched);
        let all: Vec<Selectable> = all.collect();
        state.session.selection_mut().select_all(all);
    }
}
