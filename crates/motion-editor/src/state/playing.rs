//! The playhead.

use motion_session::playback::{AtEnd, PlayState, PlaybackCommand};

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
