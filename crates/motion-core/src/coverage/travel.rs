//! How fast bodies travel while they turn how fast.

use glam::Vec2;

use crate::clip::{Clip, ClipSet};
use crate::tags::{travel_m_s, turn_rad_s};

/// Less than this of a speed with a turn is as good as nothing, seconds.
pub const EMPTY_SECS: f64 = 0.5;

/// Speeds that make a difference to an animator, metres per second.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum SpeedClass {
    /// Below 0.3.
    Standing,
    /// From 0.3.
    Slow,
    /// From 0.9.
    Walking,
    /// From 1.8.
    Jogging,
    /// From 3.0.
    Running,
}

impl SpeedClass {
    /// The slowest first.
    pub const ALL: [Self; 5] =
        [Self::Standing, Self::Slow, Self::Walking, Self::Jogging, Self::Running];

    /// The class of a speed, metres per second.
    pub fn of(speed_m_s: f32) -> Self {
        let next = Self::ALL.iter().rev().find(|class| speed_m_s >= class.from_m_s());
        next.copied().unwrap_or(Self::Standing)
    }

    /// The slowest speed in it, metres per second.
    pub fn from_m_s(self) -> f32 {
        match self {
            Self::Standing => 0.0,
            Self::Slow => 0.3,
            Self::Walking => 0.9,
            Self::Jogging => 1.8,
            Self::Running => 3.0,
        }
    }

    /// What it is called.
    pub fn name(self) -> &'static str {
        match self {
            Self::Standing => "standing",
            Self::Slow => "slow",
            Self::Walking => "walking",
            Self::Jogging => "jogging",
            Self::Running => "running",
        }
    }
}

/// Turns, by degrees per second; to the left is positive.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum TurnClass {
    /// To the right by more than 60.
    SharpRight,
    /// To the right by 20 to 60.
    Right,
    /// Less than 20 either way.
    Straight,
    /// To the left by 20 to 60.
    Left,
    /// To the left by more than 60.
    SharpLeft,
}

impl TurnClass {
    /// From right to left.
    pub const ALL: [Self; 5] =
        [Self::SharpRight, Self::Right, Self::Straight, Self::Left, Self::SharpLeft];

    /// The class of a rate of turning, radians per second.
    pub fn of(turn_rad_s: f32) -> Self {
        match turn_rad_s.to_degrees() {
            turn if turn < -60.0 => Self::SharpRight,
            turn if turn < -20.0 => Self::Right,
            turn if turn <= 20.0 => Self::Straight,
            turn if turn <= 60.0 => Self::Left,
            _ => Self::SharpLeft,
        }
    }

    /// What it is called.
    pub fn name(self) -> &'static str {
        match self {
            Self::SharpRight => "sharp right",
            Self::Right => "right",
            Self::Straight => "straight",
            Self::Left => "left",
            Self::SharpLeft => "sharp left",
        }
    }
}

/// What there is of a speed with a turn.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Cell {
    /// How fast the body travels.
    pub speed: SpeedClass,
    /// How fast it turns.
    pub turn: TurnClass,
    /// How long in all clips together, seconds.
    pub secs: f64,
}

impl Cell {
    /// Whether there is as good as nothing of it.
    pub fn is_empty(&self) -> bool {
        self.secs < EMPTY_SECS
    }
}

/// Speeds and turns of all clips.
#[derive(Clone, Debug, PartialEq)]
pub struct Travel {
    /// Every speed with every turn: speeds slowest first, within each turns from right to left.
    pub cells: Vec<Cell>,
    /// Half of the time bodies travel slower than this, metres per second.
    pub median_m_s: f32,
    /// The fastest that is kept up for half a second, metres per second.
    pub fastest_m_s: f32,
    /// The fastest turns to the right and to the left, radians per second, both positive.
    pub fastest_turns_rad_s: [f32; 2],
}

impl Travel {
    /// Speeds are means over half a second and turns over 0.8 s, in true metres.
    pub(super) fn new(clips: &ClipSet) -> Self {
        let frame_secs = clips.fps().frame_secs();
        let mut frames = vec![0usize; SpeedClass::ALL.len() * TurnClass::ALL.len()];
        let mut speeds = Vec::with_capacity(clips.n_frames());
        let mut fastest_turns_rad_s = [0.0_f32; 2];
        for clip in clips.clips() {
            for (travel, turn) in travel_and_turn(clip) {
                let speed = travel.length();
                let cell = SpeedClass::of(speed) as usize * TurnClass::ALL.len();
                frames[cell + TurnClass::of(turn) as usize] += 1;
                speeds.push(speed);
                fastest_turns_rad_s[0] = fastest_turns_rad_s[0].max(-turn);
                fastest_turns_rad_s[1] = fastest_turns_rad_s[1].max(turn);
            }
        }
        let classes = SpeedClass::ALL
            .into_iter()
            .flat_map(|speed| TurnClass::ALL.into_iter().map(move |turn| (speed, turn)));
        let cells = classes
            .zip(frames)
            .map(|((speed, turn), n)| Cell { speed, turn, secs: n as f64 * frame_secs })
            .collect();
        Self {
            cells,
            median_m_s: crate::contacts::percentile(&mut speeds, 0.5),
            fastest_m_s: speeds.iter().copied().fold(0.0, f32::max),
            fastest_turns_rad_s,
        }
    }

    /// How long bodies travel that fast and turn that way, seconds.
    pub fn secs(&self, speed: SpeedClass, turn: TurnClass) -> f64 {
        self.cells[speed as usize * TurnClass::ALL.len() + turn as usize].secs
    }

    /// How long bodies travel that fast, seconds.
    pub fn speed_secs(&self, speed: SpeedClass) -> f64 {
        TurnClass::ALL.into_iter().map(|turn| self.secs(speed, turn)).sum()
    }
}

fn travel_and_turn(clip: &Clip) -> impl Iterator<Item = (Vec2, f32)> {
    let torso = &clip.track.world_from_torso;
    let places: Vec<Vec2> = torso.iter().map(|torso| torso.ground_m()).collect();
    let heading = crate::ground::yaw_series_rad(&clip.motion);
    let fps = clip.motion.fps();
    travel_m_s(&places, &heading, fps).into_iter().zip(turn_rad_s(&heading, fps))
}
