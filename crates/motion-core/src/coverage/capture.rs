//! What would be worth recording, in sentences.

use std::fmt;

use super::{Coverage, EMPTY_SECS};
use crate::clip::{Clip, ClipSet};
use crate::skeleton::mirror::MIRROR_SUFFIX;
use crate::tags::TagSpan;
use crate::units::FrameIdx;

/// A dead end that is shorter than this is the tail that every clip has, seconds.
const DEAD_SECS: f64 = 1.0;

/// How bodies get on.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Gait {
    /// `walk`.
    Walk,
    /// `run`.
    Run,
}

impl Gait {
    fn tag(self) -> &'static str {
        match self {
            Self::Walk => "walk",
            Self::Run => "run",
        }
    }

    fn doing(self) -> &'static str {
        match self {
            Self::Walk => "walking",
            Self::Run => "running",
        }
    }
}

/// To which side.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Turn {
    /// To the left.
    Left,
    /// To the right.
    Right,
}

impl Turn {
    fn word(self) -> &'static str {
        match self {
            Self::Left => "left",
            Self::Right => "right",
        }
    }

    fn tag(self) -> &'static str {
        match self {
            Self::Left => "turn left",
            Self::Right => "turn right",
        }
    }
}

/// Something that the library cannot do. Its text says so, and what to record.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Missing {
    /// Nobody gets on that way.
    Gait(Gait),
    /// Nobody turns that way while getting on so. `mirrors`: somebody turns the other way, and the
    /// library has no mirror images.
    Turn {
        /// While doing so.
        gait: Gait,
        /// To this side.
        turn: Turn,
        /// The other side is there, mirror images are not.
        mirrors: bool,
    },
    /// Nobody stands still.
    Idle,
    /// Nobody turns on the spot.
    TurnOnSpot(Turn),
    /// Nobody goes backward.
    Backward,
    /// Nobody goes sideways.
    Sideways,
    /// Nobody jumps.
    Jump,
    /// Nobody crouches.
    Crouch,
    /// No clip has both, the second behind the first.
    Change {
        /// A tag.
        from: &'static str,
        /// Another tag.
        to: &'static str,
    },
    /// A clip that cannot be left from some frame on.
    DeadEnd {
        /// The clip.
        clip: String,
        /// The first frame without a way out.
        from: FrameIdx,
    },
    /// A clip that nothing leads into, or out of.
    Apart(String),
    /// Clips that only bridges join to the others.
    OnBridges(Vec<String>),
}

impl fmt::Display for Missing {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Gait(Gait::Walk) => {
                f.write_str("no walk: record 6–8 takes of walks, straight and in curves")
            }
            Self::Gait(Gait::Run) => {
                f.write_str("no run: record 6–8 takes of runs, straight and in curves")
            }
            Self::Turn { gait, turn, mirrors } => {
                let (doing, side, tag) = (gait.doing(), turn.word(), gait.tag());
                write!(
                    f,
                    "no {side} turn while {doing}: record 3–4 takes of a {tag} with a 45–90° {side} turn"
                )?;
                if *mirrors { f.write_str(", or build the library with --mirror") } else { Ok(()) }
            }
            Self::Idle => {
                f.write_str("nobody stands still: record 2–3 takes of standing, 10 s each")
            }
            Self::TurnOnSpot(turn) => {
                let side = turn.word();
                write!(
                    f,
                    "no turn to the {side} on the spot: record 2–3 takes of standing with a 90–180° \
                     {side} turn"
                )
            }
            Self::Backward => {
                f.write_str("no backward walk: record 3–4 takes of stepping and walking backward")
            }
            Self::Sideways => {
                f.write_str("no sideways walk: record 3–4 takes of side steps to either side")
            }
            Self::Jump => f.write_str(
                "no jump: record 3–4 takes of jumps, on the spot, ahead and out of a run",
            ),
            Self::Crouch => f.write_str(
                "no crouch: record 3–4 takes of crouching down, crouched walks and getting up",
            ),
            Self::Change { from, to } => {
                let what = match (*from, *to) {
                    ("idle", "walk") => "nobody starts to walk from standing",
                    ("walk", "idle") => "no walk comes to a stand",
                    ("walk", "run") => "nobody begins to run out of a walk",
                    ("run", "walk") => "no run falls into a walk",
                    ("run", "idle") => "no run comes to a stand",
                    _ => "no clip has this change",
                };
                write!(f, "{what}: record 3–4 takes that go from {from} to {to}")
            }
            Self::DeadEnd { clip, from } => write!(
                f,
                "nothing leads out of clip {clip} after frame {from}: record 2–3 takes that begin \
                 as it ends and go on into a walk or a stand"
            ),
            Self::Apart(clip) => write!(
                f,
                "clip {clip} cannot be reached and left again: record 2–3 takes that lead into what \
                 it does and out of it"
            ),
            Self::OnBridges(clips) => {
                const N_NAMED: usize = 6;
                let named: Vec<&str> = clips.iter().take(N_NAMED).map(String::as_str).collect();
                let more = clips.len().saturating_sub(N_NAMED);
                let more = if more > 0 { format!(" and {more} more") } else { String::new() };
                write!(
                    f,
                    "only bridges join {}{more} to the rest: record 2–3 takes from a walk or a stand \
                     into what happens there and back",
                    named.join(", ")
                )
            }
        }
    }
}

/// What is missing, the most useful first: ways of getting on, turns, stands, directions, changes,
/// heights, then clips that lead nowhere.
pub(super) fn missing(clips: &ClipSet, coverage: &Coverage) -> Vec<Missing> {
    let mut missing = Vec::new();
    if coverage.has_legs {
        person(clips, coverage, &mut missing);
    }
    let is_image = |clip: &str| clip.ends_with(MIRROR_SUFFIX);
    let dead_frames = clips.fps().frames_in_secs(DEAD_SECS) as u32;
    for ways in coverage.ways.clips.iter().filter(|ways| !is_image(&ways.clip)) {
        if ways.is_apart() {
            missing.push(Missing::Apart(ways.clip.clone()));
        } else if ways.n_dead() >= dead_frames {
            let from = FrameIdx(ways.dead_from);
            missing.push(Missing::DeadEnd { clip: ways.clip.clone(), from });
        }
    }
    let on_bridges = coverage.ways.clips.iter().filter(|ways| ways.hangs_on_bridges());
    let on_bridges: Vec<String> =
        on_bridges.filter(|ways| !is_image(&ways.clip)).map(|ways| ways.clip.clone()).collect();
    if !on_bridges.is_empty() {
        missing.push(Missing::OnBridges(on_bridges));
    }
    missing
}

fn person(clips: &ClipSet, coverage: &Coverage, missing: &mut Vec<Missing>) {
    let is_there = |tag: &str| coverage.tag_secs(tag) >= EMPTY_SECS;
    let together = |tags: [&str; 2]| {
        let n: usize = clips.clips().iter().map(|clip| n_frames_with(clip, tags)).sum();
        n as f64 * clips.fps().frame_secs() >= EMPTY_SECS
    };
    let has_images = clips.clips().iter().any(|clip| clip.id.ends_with(MIRROR_SUFFIX));
    for gait in [Gait::Walk, Gait::Run] {
        if !is_there(gait.tag()) {
            missing.push(Missing::Gait(gait));
            continue;
        }
        let turns = [Turn::Left, Turn::Right].map(|turn| together([gait.tag(), turn.tag()]));
        for (turn, side, other) in [(Turn::Left, 0, 1), (Turn::Right, 1, 0)] {
            if !turns[side] {
                missing.push(Missing::Turn { gait, turn, mirrors: turns[other] && !has_images });
            }
        }
    }
    if !is_there("idle") {
        missing.push(Missing::Idle);
    }
    for turn in [Turn::Left, Turn::Right] {
        let n: usize = clips.clips().iter().map(|clip| n_on_the_spot(clip, turn)).sum();
        if (n as f64 * clips.fps().frame_secs()) < EMPTY_SECS {
            missing.push(Missing::TurnOnSpot(turn));
        }
    }
    for (tag, what) in [("backward", Missing::Backward), ("sideways", Missing::Sideways)] {
        if !is_there(tag) {
            missing.push(what);
        }
    }
    let changes =
        [("idle", "walk"), ("walk", "idle"), ("walk", "run"), ("run", "walk"), ("run", "idle")];
    for (from, to) in changes {
        let is_wanted = is_there(from) && is_there(to);
        if is_wanted && !clips.clips().iter().any(|clip| changes_from(clip, from, to)) {
            missing.push(Missing::Change { from, to });
        }
    }
    for (tag, what) in [("jump", Missing::Jump), ("crouch", Missing::Crouch)] {
        if !is_there(tag) {
            missing.push(what);
        }
    }
}

/// How many frames have both tags.
fn n_frames_with(clip: &Clip, [a, b]: [&str; 2]) -> usize {
    let mut n = 0;
    for a in spans_of(clip, a) {
        for b in spans_of(clip, b) {
            let (from, to) = (a.from.max(b.from), a.to.min(b.to));
            n += (to.0 + 1).saturating_sub(from.0) as usize;
        }
    }
    n
}

/// How many frames turn while the body does not get on.
fn n_on_the_spot(clip: &Clip, turn: Turn) -> usize {
    let turning = clip.tag_spans.iter().filter(|span| span.tag == turn.tag());
    let all: usize = turning.map(TagSpan::n_frames).sum();
    let moving =
        n_frames_with(clip, [turn.tag(), "walk"]) + n_frames_with(clip, [turn.tag(), "run"]);
    all.saturating_sub(moving)
}

/// Whether one tag comes within a second behind another.
fn changes_from(clip: &Clip, from: &str, to: &str) -> bool {
    let within = clip.motion.fps().frames_in_secs(1.0) as u32;
    spans_of(clip, from).any(|a| {
        let follows = |b: &TagSpan| b.to > a.to && b.from.0 <= a.to.0 + within && b.from > a.from;
        spans_of(clip, to).any(follows)
    })
}

fn spans_of<'a>(clip: &'a Clip, tag: &'a str) -> impl Iterator<Item = &'a TagSpan> {
    clip.tag_spans.iter().filter(move |span| span.tag == tag)
}
