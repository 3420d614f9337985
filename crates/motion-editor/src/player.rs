//! The playhead, as the window speaks of it.

use motion_core::units::Fps;
use motion_session::playback::{AtEnd, PlayState, Playback, PlaybackCommand};

/// Which moment is shown, and whether that changes by itself. What moves it is
/// [`motion_session::playback`].
#[derive(Clone, Debug)]
pub struct Player {
    playback: Playback,
    fps: f64,
}

/// The speeds that keys step through.
pub const SPEEDS: [f64; 7] = [0.1, 0.25, 0.5, 1.0, 1.5, 2.0, 4.0];

impl Default for Player {
    fn default() -> Self {
        let fps = Fps::THIRTY;
        Self { playback: Playback::new(1, fps), fps: fps.get() }
    }
}

impl Player {
    /// Takes up a motion of another length; the playhead stays where it is if it can.
    pub fn set_motion(&mut self, n_frames: usize, fps: f64) {
        let Ok(rate) = Fps::new(fps) else { return };
        self.fps = fps;
        self.playback.set_motion(u32::try_from(n_frames).unwrap_or(u32::MAX), rate);
    }

    /// The moment that is shown; between two frames while it plays.
    pub fn frame(&self) -> f64 {
        self.playback.frame()
    }

    /// The frame whose number is shown.
    pub fn frame_number(&self) -> usize {
        self.playback.frame().round() as usize
    }

    /// The last frame.
    pub fn last(&self) -> usize {
        self.n_frames() - 1
    }

    /// Frames of the motion, at least 1.
    pub fn n_frames(&self) -> usize {
        self.playback.n_frames() as usize
    }

    /// Frames per second at speed 1.
    pub fn fps(&self) -> f64 {
        self.fps
    }

    /// The moment in seconds.
    pub fn secs(&self) -> f64 {
        self.frame() / self.fps
    }

    /// Whether time goes on.
    pub fn is_playing(&self) -> bool {
        self.playback.state() == PlayState::Playing
    }

    /// Whether it begins again at the end.
    pub fn is_looping(&self) -> bool {
        self.playback.at_end() == AtEnd::Loop
    }

    /// Times real time.
    pub fn speed(&self) -> f64 {
        self.playback.speed()
    }

    /// Goes to a moment; what lies outside is brought to the nearest end.
    pub fn seek(&mut self, frame: f64) {
        self.playback.apply(PlaybackCommand::GoTo(frame));
    }

    /// Goes to a frame and stays there.
    pub fn stop_at(&mut self, frame: usize) {
        self.playback.apply(PlaybackCommand::Pause);
        self.seek(frame as f64);
    }

    /// Goes some frames on or back, to whole ones, and pauses.
    pub fn step(&mut self, by: i32) {
        self.playback.apply(PlaybackCommand::Step(by));
    }

    /// Lets time go on.
    pub fn play(&mut self) {
        self.playback.apply(PlaybackCommand::Play);
    }

    /// Plays, or pauses at a whole frame. At the end it plays from the start.
    pub fn toggle(&mut self) {
        self.playback.apply(PlaybackCommand::Toggle);
        if !self.is_playing() {
            self.seek(self.frame().round());
        }
    }

    /// Begins again at the end, or no longer does.
    pub fn toggle_loop(&mut self) {
        let at_end = if self.is_looping() { AtEnd::Hold } else { AtEnd::Loop };
        self.playback.apply(PlaybackCommand::SetAtEnd(at_end));
    }

    /// Times real time.
    pub fn set_speed(&mut self, speed: f64) {
        self.playback.apply(PlaybackCommand::SetSpeed(speed));
    }

    /// The next of [`SPEEDS`], up or down.
    pub fn change_speed(&mut self, up: bool) {
        const SLACK: f64 = 1e-9;
        let next = match up {
            true => SPEEDS.iter().find(|s| **s > self.speed() + SLACK),
            false => SPEEDS.iter().rev().find(|s| **s < self.speed() - SLACK),
        };
        next.into_iter().for_each(|speed| self.set_speed(*speed));
    }

    /// Lets time pass.
    pub fn advance(&mut self, secs: f64) {
        self.playback.advance(secs);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_pause_is_at_a_whole_frame() {
        let mut player = Player::default();
        player.set_motion(100, 30.0);
        player.toggle();
        player.advance(1.01);
        player.toggle();
        assert_eq!((player.frame(), player.is_playing()), (30.0, false));
        assert_eq!(player.secs(), 1.0);
    }

    #[test]
    fn speeds_end_where_they_end() {
        let mut player = Player::default();
        for (up, end) in [(true, 4.0), (false, 0.1)] {
            for _ in 0..9 {
                player.change_speed(up);
            }
            assert_eq!(player.speed(), end);
        }
    }
}
