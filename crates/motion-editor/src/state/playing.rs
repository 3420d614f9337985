//! The playhead.

use motion_session::playback::{AtEnd, PlayRange, PlayState, PlaybackCommand};

use super::EditorState;

/// The speeds that keys step through.
pub const SPEEDS: [f64; 7] = [0.1, 0.25, 0.5, 1.0, 1.5, 2.0, 4.0];

impl EditorState {
    /// The moment that is shown; between two frames while it plays.
    pub fn frame(&self) -> f64 {
        self.session.playback().frame()
    }

    /// The frame whose number is shown.
    pub fn frame_number(&self) -> usize {
        self.frame().round() as usize
    }

    /// Frames of the shown motion, at least 1.
    pub fn n_frames(&self) -> usize {
        self.session.playback().n_frames() as usize
    }

    /// The last frame.
    pub fn last_frame(&self) -> usize {
        self.n_frames() - 1
    }

    /// Frames per second at speed 1.
    pub fn fps(&self) -> f64 {
        self.session.document().fps()
    }

    /// The moment in seconds.
    pub fn secs(&self) -> f64 {
        self.frame() / self.fps()
    }

    /// Whether time goes on.
    pub fn is_playing(&self) -> bool {
        self.session.playback().state() == PlayState::Playing
    }

    /// Whether it begins again at the end.
    pub fn is_looping(&self) -> bool {
        self.session.playback().at_end() == AtEnd::Loop
    }

    /// Times real time.
    pub fn speed(&self) -> f64 {
        self.session.playback().speed()
    }

    /// Lets time go on.
    pub fn play(&mut self) {
        self.session.play(PlaybackCommand::Play);
    }

    /// Lets time go back.
    pub fn play_back(&mut self) {
        self.session.play(PlaybackCommand::PlayBack);
    }

    /// Pauses at a whole frame.
    pub fn stop(&mut self) {
        self.stop_at(self.frame_number());
    }

    /// Plays, or pauses at a whole frame. At the end it plays from the start.
    pub fn toggle_playing(&mut self) {
        self.session.play(PlaybackCommand::Toggle);
        if !self.is_playing() {
            self.seek(self.frame().round());
        }
    }

    /// Goes to a moment; what lies outside is brought to the nearest end.
    pub fn seek(&mut self, frame: f64) {
        self.session.play(PlaybackCommand::GoTo(frame));
    }

    /// Goes to a frame and stays there.
    pub fn stop_at(&mut self, frame: usize) {
        self.session.play(PlaybackCommand::Pause);
        self.seek(frame as f64);
    }

    /// Goes some frames on or back, to whole ones, and pauses.
    pub fn step(&mut self, by: i32) {
        self.session.play(PlaybackCommand::Step(by));
    }

    /// Begins again at the end, or no longer does.
    pub fn toggle_loop(&mut self) {
        let at_end = if self.is_looping() { AtEnd::Hold } else { AtEnd::Loop };
        self.session.play(PlaybackCommand::SetAtEnd(at_end));
    }

    /// The part that the user has chosen to be played.
    pub fn chosen_range(&self) -> Option<PlayRange> {
        self.session.playback().chosen_range()
    }

    /// Plays this part, or with `None` all.
    pub fn set_range(&mut self, range: Option<PlayRange>) {
        self.session.play(PlaybackCommand::SetRange(range));
    }

    /// What is played begins at a frame; it ends where it did unless that is before.
    pub fn loop_from(&mut self, from: u32) {
        let last = self.last_frame() as u32;
        let to = self.chosen_range().map_or(last, |range| range.to);
        self.set_range(Some(PlayRange { from, to: if to > from { to } else { last } }));
    }

    /// What is played ends at a frame; it begins where it did unless that is after.
    pub fn loop_to(&mut self, to: u32) {
        let from = self.chosen_range().map_or(0, |range| range.from);
        self.set_range(Some(PlayRange { from: if from < to { from } else { 0 }, to }));
    }

    /// Times real time.
    pub fn set_speed(&mut self, speed: f64) {
        self.session.play(PlaybackCommand::SetSpeed(speed));
    }

    /// The next of [`SPEEDS`], up or down.
    pub fn change_speed(&mut self, up: bool) {
        const SLACK: f64 = 1e-9;
        let now = self.speed();
        let next = match up {
            true => SPEEDS.iter().find(|speed| **speed > now + SLACK),
            false => SPEEDS.iter().rev().find(|speed| **speed < now - SLACK),
        };
        next.into_iter().for_each(|speed| self.set_speed(*speed));
    }
}
