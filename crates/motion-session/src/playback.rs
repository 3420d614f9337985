//! Where in its motion a character is shown.
//!
//! There is no clock here: seconds come from outside. The place is a **fractional frame**: 3.5 lies
//! half way between the samples 3 and 4. A motion of `n` frames spans the places from 0 to `n − 1`
//! (see [`motion_core::units`]), so one of one frame has the place 0 alone.
//!
//! While it plays, the place moves through the range `[from, to]`, ends included. At the end it
//! begins again ([`AtEnd::Loop`]: what is beyond `to` is beyond `from` by as much) or stays
//! ([`AtEnd::Hold`]: at `to`, paused). With a range of frames 10 to 20:
//!
//! | place | plus frames | loop | hold |
//! | --- | --- | --- | --- |
//! | 12 | 3 | 15 | 15 |
//! | 12 | 8 | 10 | 20, paused |
//! | 12 | 9.5 | 11.5 | 20, paused |
//! | 12 | 28 | 10 | 20, paused |
//! | 3 | 2 | 5 | 5 |
//! | 25 | 1 | 10 | 20, paused |
//!
//! Backwards it is the same seen in a mirror: what is before `from` is before `to` by as much, and
//! [`AtEnd::Hold`] stays at `from`.
//!
//! | place | minus frames | loop | hold |
//! | --- | --- | --- | --- |
//! | 18 | 3 | 15 | 15 |
//! | 18 | 8 | 20 | 10, paused |
//! | 18 | 9.5 | 18.5 | 10, paused |
//! | 18 | 28 | 20 | 10, paused |
//! | 27 | 2 | 25 | 25 |
//! | 5 | 1 | 20 | 10, paused |

use motion_core::units::Fps;

/// The slowest speed.
pub const MIN_SPEED: f64 = 0.1;
/// The fastest speed.
pub const MAX_SPEED: f64 = 4.0;

/// Whether time goes on.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum PlayState {
    /// At the beginning of the range.
    #[default]
    Stopped,
    /// It goes on.
    Playing,
    /// It stands somewhere.
    Paused,
}

/// Which way time goes.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Direction {
    /// On.
    #[default]
    Ahead,
    /// Back.
    Back,
}

/// What happens at the end of the range.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum AtEnd {
    /// It begins again.
    #[default]
    Loop,
    /// It stays there.
    Hold,
}

/// Frames that are played, both ends included.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct PlayRange {
    /// The first.
    pub from: u32,
    /// The last; not before the first.
    pub to: u32,
}

/// What can be asked of a playback.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum PlaybackCommand {
    /// Go on; from the beginning of the range where its end is reached.
    Play,
    /// Go back; from the end of the range where its beginning is reached.
    PlayBack,
    /// Stand still.
    Pause,
    /// Play ahead, or pause.
    Toggle,
    /// Stand still at the beginning of the range.
    Stop,
    /// Go to a place, which may be outside the range but not outside the motion. For scrubbing.
    GoTo(f64),
    /// Go so many frames on, or back, to a whole frame, and pause there.
    Step(i32),
    /// To the first frame of the range.
    ToStart,
    /// To the last frame of the range.
    ToEnd,
    /// Play so many times as fast as it is, within [`MIN_SPEED`] and [`MAX_SPEED`].
    SetSpeed(f64),
    /// Play this part, or with `None` all. Ends in the wrong order are exchanged.
    SetRange(Option<PlayRange>),
    /// What happens at the end.
    SetAtEnd(AtEnd),
}

/// Where a motion is shown, and whether that changes by itself.
///
/// Invariants: the place lies within the motion, the speed within its limits, and a range in order.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Playback {
    state: PlayState,
    direction: Direction,
    frame: f64,
    speed: f64,
    range: Option<PlayRange>,
    at_end: AtEnd,
    n_frames: u32,
    fps: Fps,
}

impl Playback {
    /// Stopped at the beginning of a motion of `n_frames`.
    pub fn new(n_frames: u32, fps: Fps) -> Self {
        Self {
            state: PlayState::default(),
            direction: Direction::default(),
            frame: 0.0,
            speed: 1.0,
            range: None,
            at_end: AtEnd::default(),
            n_frames: n_frames.max(1),
            fps,
        }
    }

    /// Whether time goes on.
    pub fn state(&self) -> PlayState {
        self.state
    }

    /// Which way it plays, or played last.
    pub fn direction(&self) -> Direction {
        self.direction
    }

    /// The place, in frames.
    pub fn frame(&self) -> f64 {
        self.frame
    }

    /// The frame whose sample is shown at the place or last was.
    pub fn whole_frame(&self) -> u32 {
        self.frame as u32
    }

    /// How many times as fast as it is.
    pub fn speed(&self) -> f64 {
        self.speed
    }

    /// What happens at the end.
    pub fn at_end(&self) -> AtEnd {
        self.at_end
    }

    /// The part that the user has chosen, which may reach beyond the motion.
    pub fn chosen_range(&self) -> Option<PlayRange> {
        self.range
    }

    /// The part that is played: what of the chosen one is within the motion, all where none is.
    pub fn range(&self) -> PlayRange {
        let all = PlayRange { from: 0, to: self.n_frames - 1 };
        match self.range {
            Some(PlayRange { from, to }) if from < self.n_frames => {
                PlayRange { from, to: to.min(all.to) }
            }
            _ => all,
        }
    }

    /// How many frames the motion has.
    pub fn n_frames(&self) -> u32 {
        self.n_frames
    }

    /// Another motion is shown. The place stays, as far as the motion has it.
    pub fn set_motion(&mut self, n_frames: u32, fps: Fps) {
        self.n_frames = n_frames.max(1);
        self.fps = fps;
        self.frame = self.frame.min(self.last());
    }

    /// Does what is asked.
    pub fn apply(&mut self, command: PlaybackCommand) {
        let PlayRange { from, to } = self.range();
        let (from, to) = (f64::from(from), f64::from(to));
        match command {
            PlaybackCommand::Play => {
                if self.state != PlayState::Playing && self.frame >= to {
                    self.frame = from;
                }
                (self.state, self.direction) = (PlayState::Playing, Direction::Ahead);
            }
            PlaybackCommand::PlayBack => {
                if self.state != PlayState::Playing && self.frame <= from {
                    self.frame = to;
                }
                (self.state, self.direction) = (PlayState::Playing, Direction::Back);
            }
            PlaybackCommand::Pause => self.pause(),
            PlaybackCommand::Toggle if self.state == PlayState::Playing => self.pause(),
            PlaybackCommand::Toggle => self.apply(PlaybackCommand::Play),
            PlaybackCommand::Stop => {
                self.state = PlayState::Stopped;
                self.frame = from;
            }
            PlaybackCommand::GoTo(frame) => self.go_to(frame),
            PlaybackCommand::Step(frames) => {
                // Back from 3.5 is 3, on from it is 4.
                let here = if frames < 0 { self.frame.ceil() } else { self.frame.floor() };
                self.go_to(here + f64::from(frames));
                self.state = PlayState::Paused;
            }
            PlaybackCommand::ToStart => self.go_to(from),
            PlaybackCommand::ToEnd => self.go_to(to),
            PlaybackCommand::SetSpeed(speed) if speed.is_finite() => {
                self.speed = speed.clamp(MIN_SPEED, MAX_SPEED);
            }
            PlaybackCommand::SetSpeed(_) => {}
            PlaybackCommand::SetRange(range) => {
                self.range = range.map(|PlayRange { from, to }| PlayRange {
                    from: from.min(to),
                    to: from.max(to),
                });
            }
            PlaybackCommand::SetAtEnd(at_end) => self.at_end = at_end,
        }
    }

    /// So many seconds pass. Seconds below 0 and no numbers count 0. Returns whether the place
    /// changed.
    pub fn advance(&mut self, secs: f64) -> bool {
        if self.state != PlayState::Playing || secs.is_nan() || secs <= 0.0 {
            return false;
        }
        let before = self.frame;
        let PlayRange { from, to } = self.range();
        let (from, to) = (f64::from(from), f64::from(to));
        let way = secs * self.fps.get() * self.speed;
        self.frame = match self.direction {
            Direction::Ahead => self.after(self.frame + way, from, to),
            // The mirror image of a range from −to to −from. `0.0 -` makes no −0 of 0.
            Direction::Back => {
                self.frame = -self.frame;
                0.0 - self.after(self.frame + way, -to, -from)
            }
        };
        self.frame != before
    }

    /// The place after it has moved from the present one up to `place`, within a range.
    fn after(&mut self, place: f64, from: f64, to: f64) -> f64 {
        if place < to {
            place
        } else if self.at_end == AtEnd::Hold {
            self.state = PlayState::Paused;
            to
        } else if self.frame > to || to == from || !place.is_finite() {
            // It was outside the range, or the range is a single frame.
            from
        } else {
            from + (place - from) % (to - from)
        }
    }

    fn pause(&mut self) {
        if self.state == PlayState::Playing {
            self.state = PlayState::Paused;
        }
    }

    fn go_to(&mut self, frame: f64) {
        if frame.is_nan() {
            return;
        }
        self.frame = frame.clamp(0.0, self.last());
        if self.state == PlayState::Stopped {
            self.state = PlayState::Paused;
        }
    }

    fn last(&self) -> f64 {
        f64::from(self.n_frames - 1)
    }
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;

    /// One frame a second, so that frames are seconds.
    fn playing(n_frames: u32, at: f64, range: Option<(u32, u32)>, at_end: AtEnd) -> Playback {
        let mut playback = Playback::new(n_frames, Fps::new(1.0).unwrap());
        playback.apply(PlaybackCommand::Play);
        playback.apply(PlaybackCommand::GoTo(at));
        let range = range.map(|(from, to)| PlayRange { from, to });
        playback.apply(PlaybackCommand::SetRange(range));
        playback.apply(PlaybackCommand::SetAtEnd(at_end));
        playback
    }

    #[test]
    fn the_table_of_edges() {
        for (at, secs, looped, held) in [
            (12.0, 3.0, 15.0, (15.0, PlayState::Playing)),
            (12.0, 8.0, 10.0, (20.0, PlayState::Paused)),
            (12.0, 9.5, 11.5, (20.0, PlayState::Paused)),
            (12.0, 28.0, 10.0, (20.0, PlayState::Paused)),
            (3.0, 2.0, 5.0, (5.0, PlayState::Playing)),
            (25.0, 1.0, 10.0, (20.0, PlayState::Paused)),
            (12.0, 0.0, 12.0, (12.0, PlayState::Playing)),
            (12.0, -4.0, 12.0, (12.0, PlayState::Playing)),
            (12.0, f64::NAN, 12.0, (12.0, PlayState::Playing)),
            (12.0, f64::INFINITY, 10.0, (20.0, PlayState::Paused)),
        ] {
            let mut playback = playing(40, at, Some((10, 20)), AtEnd::Loop);
            playback.advance(secs);
            assert_eq!(playback.frame(), looped, "{at} plus {secs}");
            assert_eq!(playback.state(), PlayState::Playing);
            let mut playback = playing(40, at, Some((10, 20)), AtEnd::Hold);
            playback.advance(secs);
            assert_eq!((playback.frame(), playback.state()), held, "{at} plus {secs}, held");
        }
    }

    #[test]
    fn the_table_of_edges_backwards() {
        for (at, secs, looped, held) in [
            (18.0, 3.0, 15.0, (15.0, PlayState::Playing)),
            (18.0, 8.0, 20.0, (10.0, PlayState::Paused)),
            (18.0, 9.5, 18.5, (10.0, PlayState::Paused)),
            (18.0, 28.0, 20.0, (10.0, PlayState::Paused)),
            (27.0, 2.0, 25.0, (25.0, PlayState::Playing)),
            (5.0, 1.0, 20.0, (10.0, PlayState::Paused)),
            (18.0, 0.0, 18.0, (18.0, PlayState::Playing)),
            (18.0, f64::NAN, 18.0, (18.0, PlayState::Playing)),
            (18.0, f64::INFINITY, 20.0, (10.0, PlayState::Paused)),
        ] {
            for (at_end, expected) in
                [(AtEnd::Loop, (looped, PlayState::Playing)), (AtEnd::Hold, held)]
            {
                let mut playback = playing(40, at, Some((10, 20)), at_end);
                playback.apply(PlaybackCommand::PlayBack);
                playback.advance(secs);
                assert_eq!((playback.frame(), playback.state()), expected, "{at} minus {secs}");
            }
        }
    }

    #[test]
    fn from_the_beginning_it_goes_back_from_the_end() {
        let mut playback = Playback::new(10, Fps::new(1.0).unwrap());
        playback.apply(PlaybackCommand::PlayBack);
        assert_eq!((playback.frame(), playback.direction()), (9.0, Direction::Back));
        playback.advance(2.0);
        assert_eq!(playback.frame(), 7.0);
        playback.apply(PlaybackCommand::Play);
        playback.advance(1.0);
        assert_eq!((playback.frame(), playback.direction()), (8.0, Direction::Ahead));
        playback.apply(PlaybackCommand::PlayBack);
        playback.advance(8.0);
        assert_eq!(playback.frame().to_bits(), 9f64.to_bits(), "0 is the end, as ahead");
    }

    #[test]
    fn ranges_are_what_of_them_is_within_the_motion() {
        for (n_frames, chosen, played) in [
            (40, None, (0, 39)),
            (1, None, (0, 0)),
            (0, None, (0, 0)),
            (40, Some((20, 10)), (10, 20)),
            (40, Some((10, 90)), (10, 39)),
            (40, Some((50, 90)), (0, 39)),
            (40, Some((39, 90)), (39, 39)),
        ] {
            let range = playing(n_frames, 0.0, chosen, AtEnd::Loop).range();
            assert_eq!((range.from, range.to), played, "{chosen:?} of {n_frames}");
        }
    }

    #[test]
    fn a_pose_has_no_duration() {
        let mut playback = playing(1, 0.0, None, AtEnd::Loop);
        assert!(!playback.advance(10.0));
        assert_eq!(playback.frame(), 0.0);
    }

    #[test]
    fn speed_is_kept_within_its_limits() {
        let mut playback = playing(400, 0.0, None, AtEnd::Loop);
        for (asked, got) in [(2.0, 2.0), (0.01, MIN_SPEED), (9.0, MAX_SPEED), (f64::NAN, MAX_SPEED)]
        {
            playback.apply(PlaybackCommand::SetSpeed(asked));
            assert_eq!(playback.speed(), got);
        }
        playback.advance(10.0);
        assert_eq!(playback.frame(), 40.0);
    }

    #[test]
    fn steps_lead_to_whole_frames() {
        for (at, step, to) in
            [(3.5, 1, 4.0), (3.5, -1, 3.0), (3.0, 1, 4.0), (3.0, -1, 2.0), (0.0, -1, 0.0)]
        {
            let mut playback = playing(10, at, None, AtEnd::Loop);
            playback.apply(PlaybackCommand::Step(step));
            assert_eq!(
                (playback.frame(), playback.state()),
                (to, PlayState::Paused),
                "{at} {step}"
            );
        }
    }

    #[test]
    fn states_follow_the_keys() {
        let mut playback = Playback::new(10, Fps::THIRTY);
        assert_eq!(playback.state(), PlayState::Stopped);
        playback.apply(PlaybackCommand::Pause);
        assert_eq!(playback.state(), PlayState::Stopped, "there is nothing to pause");
        playback.apply(PlaybackCommand::Toggle);
        assert_eq!(playback.state(), PlayState::Playing);
        playback.apply(PlaybackCommand::Toggle);
        assert_eq!(playback.state(), PlayState::Paused);
        playback.apply(PlaybackCommand::ToEnd);
        playback.apply(PlaybackCommand::Play);
        assert_eq!(playback.frame(), 0.0, "from the end it begins again");
        playback.apply(PlaybackCommand::GoTo(5.0));
        playback.apply(PlaybackCommand::Stop);
        assert_eq!((playback.frame(), playback.state()), (0.0, PlayState::Stopped));
    }

    proptest! {
        #[test]
        fn the_place_is_always_within_the_motion(
            n_frames in 0u32..50, at in -10f64..80.0, range in prop::option::of((0u32..60, 0u32..60)),
            steps in prop::collection::vec(-1f64..20.0, 0..8), shorter in 0u32..50, hold: bool,
            back: bool,
        ) {
            let at_end = if hold { AtEnd::Hold } else { AtEnd::Loop };
            let mut playback = playing(n_frames, at, range, at_end);
            if back {
                playback.apply(PlaybackCommand::PlayBack);
            }
            for (nth, secs) in steps.into_iter().enumerate() {
                if nth == 3 {
                    playback.set_motion(shorter, Fps::THIRTY);
                }
                playback.advance(secs);
                prop_assert!((0.0..=f64::from(playback.n_frames() - 1)).contains(&playback.frame()));
                let range = playback.range();
                prop_assert!(range.from <= range.to && range.to < playback.n_frames());
            }
        }
    }
}
