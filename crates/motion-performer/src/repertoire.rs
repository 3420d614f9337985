//! The built-in library: its clips as data.
//!
//! Clips of gait begin and end with a foot's landing at a whole phase, at one of a few speeds;
//! clips from or to rest do so in one and the same pose. That is what lets a motion graph go
//! from everywhere to everywhere: idle ↔ walk ↔ run.

use std::f32::consts::PI;

use motion_core::clip::{Clip, ClipSet, ClipSetError};
use motion_core::ground::GroundTrack;
use motion_core::motion::MotionError;
use motion_core::skeleton::SkeletonError;
use motion_core::units::Fps;

use crate::body;
use crate::gait_curves::REST_PHASE;
use crate::idle::Idle;
use crate::jump::Jump;
use crate::perform::{Performed, Take, gait_take};
use crate::signal::{Ease, Keys};
use crate::travel::{Edge, Performance};

const SLOW_M_S: f32 = 0.95;
const WALK_M_S: f32 = 1.30;
const FAST_M_S: f32 = 1.75;
const JOG_M_S: f32 = 2.50;
const RUN_M_S: f32 = 3.40;
/// At rest before a start and after a stop.
const REST_S: f32 = 0.5;
/// The phase at which the left foot is the next to lift: the right one has just come down.
const LEFT_NEXT: f32 = 0.5 + REST_PHASE;

/// What happens in a clip.
#[derive(Clone, Debug)]
enum Act {
    Gait(Performance),
    Idle(Idle),
    Jump(Jump),
}

/// A clip of the library before it is performed.
#[derive(Clone, Debug)]
struct Entry {
    id: String,
    tags: Vec<&'static str>,
    act: Act,
    /// Performed as its mirror image.
    mirrored: bool,
}

/// Why the library could not be made. None of these happens for the built-in one (tests hold
/// that); a library still does not panic to say so.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum BuiltinError {
    /// The body is no skeleton.
    #[error(transparent)]
    Skeleton(#[from] SkeletonError),
    /// A performance gave numbers that are no motion.
    #[error("the built-in clip {id:?} cannot be performed; {source}")]
    Motion {
        /// The clip.
        id: String,
        /// What is wrong.
        source: MotionError,
    },
    /// The clips are no set.
    #[error(transparent)]
    Set(#[from] ClipSetError),
}

/// Makes the built-in library: every clip on the built-in skeleton at 30 frames per second, with
/// contacts from the foot plan, on a floor at level 0.
///
/// Always the same; nothing is read, nothing is random.
pub fn builtin_clips() -> Result<ClipSet, BuiltinError> {
    let skeleton = body::skeleton()?;
    let clips = entries()
        .into_iter()
        .map(|entry| {
            let Performed { motion, contacts } = entry
                .take()
                .performed()
                .map_err(|source| BuiltinError::Motion { id: entry.id.clone(), source })?;
            let level_m = vec![0.0; motion.n_frames()];
            let track = GroundTrack::new(&motion, &level_m, contacts);
            let tags = entry.tags.iter().map(|&tag| tag.to_owned()).collect();
            Ok(Clip::found(&skeleton, entry.id, tags, motion, track))
        })
        .collect::<Result<Vec<Clip>, BuiltinError>>()?;
    Ok(ClipSet::new(skeleton, Fps::THIRTY, clips)?)
}

impl Entry {
    fn new(id: impl Into<String>, tags: &[&'static str], act: Act) -> Self {
        Self { id: id.into(), tags: tags.to_vec(), act, mirrored: false }
    }

    fn take(&self) -> Take {
        let take = match &self.act {
            Act::Gait(spec) => gait_take(spec),
            Act::Idle(idle) => idle.take(),
            Act::Jump(jump) => jump.take(),
        };
        if self.mirrored { take.mirrored() } else { take }
    }
}

/// Two clips from one: to the left as given, to the right as its mirror image (which begins with
/// the other foot). For starts and stops the side is that of the first or last step.
fn both_ways(id: &str, suffix: &str, tags: &[&'static str], spec: &Performance) -> [Entry; 2] {
    let left = Entry::new(format!("{id}_left{suffix}"), tags, Act::Gait(spec.clone()));
    let mut right = Entry::new(format!("{id}_right{suffix}"), tags, Act::Gait(spec.clone()));
    right.mirrored = true;
    let mut entries = [left, right];
    entries[0].tags.push("left");
    entries[1].tags.push("right");
    entries
}

/// Heading that turns by `turn_rad` between two phases.
fn turning(from: f32, to: f32, turn_rad: f32) -> Keys {
    Keys::new(Ease::Smooth, vec![(from, 0.0), (to, turn_rad)])
}

fn smooth(keys: &[(f32, f32)]) -> Keys {
    Keys::new(Ease::Smooth, keys.to_vec())
}

fn entries() -> Vec<Entry> {
    let mut all = Vec::new();
    all.extend(straight());
    all.extend(turns());
    all.extend(arcs());
    all.extend(starts_and_stops());
    all.extend(changes_of_speed());
    all.extend(on_the_spot());
    all.extend(aside_and_back());
    all.extend(standing());
    all
}

fn straight() -> Vec<Entry> {
    let gait = |id: &str, tags: &[&'static str], speed_m_s: f32, cycles: f32| {
        Entry::new(id, tags, Act::Gait(Performance::straight(speed_m_s, cycles)))
    };
    vec![
        gait("walk_slow", &["walk", "slow", "straight"], SLOW_M_S, 4.0),
        gait("walk", &["walk", "straight"], WALK_M_S, 4.0),
        gait("walk_fast", &["walk", "fast", "straight"], FAST_M_S, 4.0),
        gait("jog", &["run", "slow", "straight"], JOG_M_S, 5.0),
        gait("run", &["run", "straight"], RUN_M_S, 6.0),
    ]
}

/// One turn in the midst of straight gait.
struct Turn {
    degrees: f32,
    /// Phases between which the body turns.
    between: [f32; 2],
    /// Speed in the middle of the turn.
    slowest_m_s: f32,
    cycles: f32,
}

const WALK_TURNS: [Turn; 3] = [
    Turn { degrees: 45.0, between: [1.2, 2.4], slowest_m_s: 1.2, cycles: 4.0 },
    Turn { degrees: 90.0, between: [1.0, 2.8], slowest_m_s: 1.0, cycles: 4.0 },
    Turn { degrees: 180.0, between: [0.7, 3.4], slowest_m_s: 0.75, cycles: 4.0 },
];

const RUN_TURNS: [Turn; 3] = [
    Turn { degrees: 45.0, between: [1.2, 3.2], slowest_m_s: 3.2, cycles: 5.0 },
    Turn { degrees: 90.0, between: [1.0, 4.0], slowest_m_s: 2.9, cycles: 5.0 },
    Turn { degrees: 180.0, between: [0.8, 5.4], slowest_m_s: 2.6, cycles: 6.0 },
];

fn turns() -> Vec<Entry> {
    let gaits = [("walk", WALK_M_S, &WALK_TURNS), ("run", RUN_M_S, &RUN_TURNS)];
    let mut all = Vec::new();
    for (gait, speed_m_s, turns) in gaits {
        for turn in turns {
            let [from, to] = turn.between;
            let mut spec = Performance::straight(speed_m_s, turn.cycles);
            spec.heading_rad = turning(from, to, turn.degrees.to_radians());
            spec.speed_m_s = smooth(&[
                (from - 0.6, speed_m_s),
                (0.5 * (from + to), turn.slowest_m_s),
                (to + 0.5, speed_m_s),
            ]);
            let suffix = format!("_{}", turn.degrees);
            all.extend(both_ways(&format!("{gait}_turn"), &suffix, &[gait, "turn"], &spec));
        }
    }
    all
}

fn arcs() -> Vec<Entry> {
    let arc = |gait: &'static str, speed_m_s: f32, cycles: f32, degrees: f32| {
        let rate = degrees.to_radians() / cycles;
        let mut spec = Performance::straight(speed_m_s, cycles);
        spec.heading_rad = Keys::new(Ease::Linear, vec![(-5.0, -5.0 * rate), (15.0, 15.0 * rate)]);
        both_ways(&format!("{gait}_arc"), "", &[gait, "arc"], &spec)
    };
    let mut weave = Performance::straight(WALK_M_S, 4.0);
    let aside = 40f32.to_radians();
    weave.heading_rad = smooth(&[(0.4, 0.0), (1.4, aside), (2.6, -aside), (3.6, 0.0)]);
    [
        arc("walk", 1.2, 4.0, 120.0),
        arc("run", 3.2, 6.0, 120.0),
        both_ways("walk_weave", "", &["walk", "arc"], &weave),
    ]
    .into_iter()
    .flatten()
    .collect()
}

fn starts_and_stops() -> Vec<Entry> {
    let standing = Edge::Standing { secs: REST_S };
    let start = |speed_m_s: f32, by: f32, to: f32| Performance {
        from_phase: LEFT_NEXT,
        cycles: to - LEFT_NEXT,
        speed_m_s: smooth(&[(LEFT_NEXT, 0.0), (by, speed_m_s)]),
        before: standing,
        ..Performance::straight(speed_m_s, 1.0)
    };
    let stop = |speed_m_s: f32, from: f32, last_landing: f32| Performance {
        cycles: last_landing + REST_PHASE,
        speed_m_s: smooth(&[(from, speed_m_s), (last_landing - 0.1, 0.0)]),
        after: standing,
        ..Performance::straight(speed_m_s, 1.0)
    };
    let mut turned = start(WALK_M_S, 1.9, 3.0);
    turned.heading_rad = turning(LEFT_NEXT, 1.9, 0.5 * PI);
    [
        both_ways("walk_start", "", &["walk", "start"], &start(WALK_M_S, 1.6, 3.0)),
        both_ways("walk_stop", "", &["walk", "stop"], &stop(WALK_M_S, 1.6, 3.0)),
        both_ways("walk_start_turn", "_90", &["walk", "start", "turn"], &turned),
        both_ways("run_start", "", &["run", "start"], &start(RUN_M_S, 2.6, 4.0)),
        both_ways("run_stop", "", &["run", "stop"], &stop(RUN_M_S, 1.0, 4.0)),
    ]
    .into_iter()
    .flatten()
    .collect()
}

fn changes_of_speed() -> Vec<Entry> {
    let change = |id: &str, tags: &[&'static str], from_m_s: f32, to_m_s: f32, over: [f32; 2]| {
        let mut spec = Performance::straight(from_m_s, 5.0);
        spec.speed_m_s = smooth(&[(over[0], from_m_s), (over[1], to_m_s)]);
        Entry::new(id, tags, Act::Gait(spec))
    };
    vec![
        change("walk_to_run", &["walk", "run"], WALK_M_S, RUN_M_S, [0.8, 3.0]),
        change("run_to_walk", &["run", "walk"], RUN_M_S, WALK_M_S, [1.0, 3.6]),
        change("walk_speed_up", &["walk", "slow", "fast"], SLOW_M_S, FAST_M_S, [1.0, 3.5]),
        change("walk_slow_down", &["walk", "fast", "slow"], FAST_M_S, SLOW_M_S, [1.0, 3.5]),
    ]
}

fn on_the_spot() -> Vec<Entry> {
    let turn = |degrees: f32, cycles: f32| {
        let spec = Performance {
            from_phase: LEFT_NEXT,
            cycles,
            speed_m_s: Keys::constant(0.0),
            heading_rad: turning(LEFT_NEXT, LEFT_NEXT + cycles - 0.12, degrees.to_radians()),
            drift_rad: 0.0,
            before: Edge::Standing { secs: REST_S },
            after: Edge::Standing { secs: REST_S },
        };
        both_ways("turn", &format!("_{degrees}"), &["turn", "spot"], &spec)
    };
    [turn(45.0, 1.0), turn(90.0, 1.5), turn(180.0, 2.5)].into_iter().flatten().collect()
}

fn aside_and_back() -> Vec<Entry> {
    let from_rest_to_rest = |speed_m_s: f32, drift_rad: f32| Performance {
        from_phase: LEFT_NEXT,
        cycles: 3.0,
        speed_m_s: smooth(&[
            (LEFT_NEXT, 0.0),
            (LEFT_NEXT + 0.6, speed_m_s),
            (LEFT_NEXT + 2.3, speed_m_s),
            (LEFT_NEXT + 2.9, 0.0),
        ]),
        heading_rad: Keys::constant(0.0),
        drift_rad,
        before: Edge::Standing { secs: 0.3 },
        after: Edge::Standing { secs: 0.3 },
    };
    let mut all =
        Vec::from(both_ways("sidestep", "", &["sidestep"], &from_rest_to_rest(0.33, 0.5 * PI)));
    let mut backward = Performance::straight(0.8, 3.0);
    backward.drift_rad = PI;
    all.push(Entry::new("step_back", &["back"], Act::Gait(from_rest_to_rest(0.55, PI))));
    all.push(Entry::new("walk_backward", &["walk", "back"], Act::Gait(backward)));
    all
}

fn standing() -> Vec<Entry> {
    let idle = |id: &str, idle: Idle| Entry::new(id, &["idle"], Act::Idle(idle));
    let jump = |id: &str, rise_m: f32, ahead_m: f32| {
        Entry::new(id, &["jump"], Act::Jump(Jump { rise_m, ahead_m }))
    };
    vec![
        idle("idle", Idle::still(4.0)),
        idle("idle_look", Idle::looking(4.6, 0.7)),
        idle("idle_shift_left", Idle::shifting(4.4, 0.055)),
        idle("idle_shift_right", Idle::shifting(4.4, -0.055)),
        jump("jump_up", 0.32, 0.0),
        jump("jump_forward", 0.20, 0.75),
        jump("jump_far", 0.24, 1.15),
    ]
}
