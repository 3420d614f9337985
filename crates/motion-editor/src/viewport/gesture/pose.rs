//! Poses of clips put on the floor.

use egui::{DragAndDrop, Key, Ui};
use glam::{Mat4, Vec2};
use motion_session::command::Command;
use motion_session::stage::pose_wishes::{place_in_clip, placed_pose};

use super::snap::{GRID_DEG, GRID_M, heading_deg, snapped};
use super::wheel;
use crate::state::EditorState;
use crate::state::moving::{rounded, wrapped_deg};

/// A notch of the wheel turns by this, degrees.
const NOTCH_DEG: f64 = 5.0;

/// A clip's pose that is carried from the library; which one is [`EditorState::pose_clip`].
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct PoseDrag;

impl PoseDrag {
    /// Whether one is carried.
    pub fn is_under_way(ui: &Ui) -> bool {
        DragAndDrop::has_payload_of_type::<Self>(ui.ctx())
    }

    /// Whether one is let go of now; then it is carried no more.
    pub fn is_dropped(ui: &Ui) -> bool {
        let is_dropped = Self::is_under_way(ui) && ui.input(|input| input.pointer.any_released());
        if is_dropped {
            DragAndDrop::clear_payload(ui.ctx());
        }
        is_dropped
    }
}

/// The pose that the pointer would put down.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct PoseAim {
    /// By how much it was turned.
    heading_deg: f64,
    /// Where it stands, once the pointer was on the floor.
    at_m: Option<[f64; 2]>,
    /// Notches that are no whole frame yet.
    rest: f32,
}

/// The clip and the frame that would be put down: the chosen ones, or what the shown take shows at
/// the playhead.
pub fn source(state: &EditorState) -> Option<(String, u32)> {
    if let Some(chosen) = &state.pose_clip {
        return Some(chosen.clone());
    }
    let now = state.frame_number();
    let pieces = state.shown_card().map_or(&[][..], |card| card.lane.pieces.as_slice());
    let shown = pieces.iter().find(|piece| piece.frames.contains(&now)).map(|piece| {
        let (first, last) = piece.of_clip;
        (piece.clip.clone(), (first + (now - piece.frames.start) as u32).min(last))
    });
    shown.or_else(|| Some((state.clips.first()?.id.clone(), 0)))
}

impl PoseAim {
    /// Follows keys and wheel, the pointer being over the view. `floor_m` is under it.
    pub fn ui(
        &mut self,
        ui: &Ui,
        floor_m: Option<[f64; 2]>,
        is_snapping: bool,
        state: &mut EditorState,
    ) {
        let (with_ctrl, without) = wheel::notches(ui);
        self.heading_deg = wrapped_deg(self.heading_deg + NOTCH_DEG * f64::from(without.round()));
        self.rest += with_ctrl;
        let whole = self.rest.trunc();
        self.rest -= whole;
        self.scrub(whole as i32, state);
        if let Some(floor_m) = floor_m {
            self.at_m = Some(floor_m.map(|axis| rounded(snapped(axis, GRID_M, is_snapping))));
        }
    }

    /// Does a key of the tool; gives whether it was one.
    pub fn key(&mut self, key: Key, is_shifted: bool, state: &mut EditorState) -> bool {
        let step = if is_shifted { 10 } else { 1 };
        match key {
            Key::R => {
                let by = if is_shifted { -GRID_DEG } else { GRID_DEG };
                self.heading_deg = wrapped_deg(self.heading_deg + by);
            }
            Key::OpenBracket => self.scrub(-step, state),
            Key::CloseBracket => self.scrub(step, state),
            _ => return false,
        }
        true
    }

    fn scrub(&self, by: i32, state: &mut EditorState) {
        if by == 0 {
            return;
        }
        let Some((clip, frame)) = source(state) else { return };
        let known = state.clips.iter().find(|line| line.id == clip);
        let last = known.map_or(0, |line| line.n_frames.saturating_sub(1)) as u32;
        let frame = frame.saturating_add_signed(by).min(last);
        state.pose_clip = Some((clip, frame));
    }

    /// Looks towards a place, where that is far enough away to be one.
    pub fn look_at(&mut self, floor_m: [f64; 2], is_snapping: bool) {
        let heading = self.at_m.and_then(|from| heading_deg(from, floor_m, is_snapping));
        heading.into_iter().for_each(|deg| self.heading_deg = deg);
    }

    /// The body that would stand there.
    pub fn ghost(&self, state: &EditorState) -> Option<Vec<Mat4>> {
        let (clip, frame) = source(state)?;
        let [x, z] = self.at_m?;
        let at_m = Vec2::new(x as f32, z as f32);
        let heading_rad = self.heading_deg.to_radians() as f32;
        placed_pose(state.session.library()?, &clip, frame, Some(at_m), Some(heading_rad))
    }

    /// What it would be, in words.
    pub fn words(&self, state: &EditorState) -> Option<String> {
        let (clip, frame) = source(state)?;
        Some(format!("{clip}:{frame} · {:.0}° · at f {}", self.heading_deg, state.frame_number()))
    }

    /// Puts it down, as one step, and selects it.
    pub fn put_down(&self, state: &mut EditorState) {
        let commands = self.commands(state).unwrap_or_default();
        if !commands.is_empty() && state.apply_all("Add pose", &commands) {
            state.select_newest();
        }
    }

    /// What puts it down, at the playhead.
    pub fn commands(&self, state: &EditorState) -> Option<Vec<Command>> {
        let (clip, clip_frame) = source(state)?;
        place_in_clip(state.session.library()?, &clip, clip_frame)?;
        let frame = state.frame_number() as u32;
        let mut commands = vec![Command::AddPose {
            character: state.session.active(),
            frame,
            clip,
            clip_frame,
            position_m: Some(self.at_m?),
            heading_deg: Some(self.heading_deg),
        }];
        commands.extend(state.length_for(frame));
        Some(commands)
    }
}
