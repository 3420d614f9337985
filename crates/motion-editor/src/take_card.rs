//! A take that was found, with everything the window shows of it.

use std::ops::Range;
use std::sync::Arc;

use motion_core::contacts::{self, Side};
use motion_scene::color::Theme;
use motion_session::document::TakeId;
use motion_session::live::{Made, Take};
use motion_session::stage::actor::Actor;
use motion_session::{AlternativeReport, ConstraintReport, SeamReport, Session};

use crate::timeline::curves::{root_speeds_m_s, root_turns_deg_s};
use crate::timeline::foot_faults::foot_faults;

/// Takes have one of so many hues.
pub const N_HUES: usize = 8;

/// What a score is made of.
pub const TERMS: [&str; 4] = ["Cuts", "Length", "Body", "Surroundings"];

/// A take of the active character.
#[derive(Clone, Debug)]
pub struct TakeCard {
    /// Stable under edits.
    pub id: TakeId,
    /// Its place in the gallery, from 1: the key that shows it.
    pub number: usize,
    /// Which of the hues of takes it has; its own as long as it is there.
    pub hue: usize,
    /// What the user calls it.
    pub name: Option<String>,
    /// Whether it stays whatever is found.
    pub is_pinned: bool,
    /// Whether it was made for other constraints than the present ones.
    pub is_stale: bool,
    /// Whether something of it is changed by hand.
    pub is_by_hand: bool,
    /// The sum of the terms, in units of one tolerance squared; infinite where it cannot be scored.
    pub score: f64,
    /// Its parts, in the order of [`TERMS`].
    pub terms: [f64; 4],
    /// The character in it.
    pub actor: Actor,
    /// How its motion is made and judged.
    pub lane: Arc<Lane>,
    /// When it came, seconds since the window opened; in the past for those that came first.
    pub came_at_secs: f64,
}

/// How cards are ordered.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Order {
    /// Whether those that were known stay where they are.
    pub are_held: bool,
    /// Now, seconds since the window opened.
    pub now_secs: f64,
}

/// So long a take is new, seconds.
pub const NEW_SECS: f64 = 6.0;

/// How a motion is made and judged.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Lane {
    /// What is shown, in order.
    pub pieces: Vec<Piece>,
    /// Where one piece goes over into the next.
    pub cuts: Vec<Cut>,
    /// How far off each constraint is, after correction.
    pub misses: Vec<ConstraintReport>,
    /// How far off each constraint was before correction.
    pub raw_misses: Vec<ConstraintReport>,
    /// When the left foot is planted, and when the right one is.
    pub plants: [Vec<Range<usize>>; 2],
    /// When each foot slides or sinks though it is planted.
    pub foot_faults: [Vec<Range<usize>>; 2],
    /// Speed of the root over the ground at every frame, metres per second.
    pub speed_m_s: Vec<f32>,
    /// How fast the root turns to the left at every frame, degrees per second.
    pub turn_deg_s: Vec<f32>,
    /// Mean speed of planted feet, cm/s.
    pub foot_slide_cm_per_s: Option<f64>,
}

/// Frames of a clip in a motion.
#[derive(Clone, Debug, PartialEq)]
pub struct Piece {
    /// The clip's id.
    pub clip: String,
    /// Frames of the motion.
    pub frames: Range<usize>,
    /// The clip's first and last frame that are shown.
    pub of_clip: (u32, u32),
}

/// A cut.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Cut {
    /// The first frame of the new piece.
    pub frame: usize,
    /// What it costs.
    pub cost: f64,
    /// Whether it joins what the threshold alone leaves apart.
    pub is_bridge: bool,
}

impl TakeCard {
    /// Frames of its motion, at least 1.
    pub fn n_frames(&self) -> usize {
        self.actor.n_frames().max(1)
    }

    /// Whether it came a moment ago.
    pub fn is_new(&self, now_secs: f64) -> bool {
        now_secs - self.came_at_secs < NEW_SECS
    }

    /// What it is called.
    pub fn title(&self) -> String {
        self.name.clone().unwrap_or_else(|| format!("Take {}", self.number))
    }
}

/// The active character's takes that have a motion: the pinned ones, then the best first. Where
/// they are held, those that were `known` stay where they are and new ones come last.
pub fn cards_of(
    session: &Session,
    theme: Theme,
    known: &[TakeCard],
    order: Order,
) -> Vec<TakeCard> {
    let active = session.active();
    let Some(found) = session.snapshot().character(active) else { return Vec::new() };
    let takes = session.document().takes();
    // Of the first, all are new, so none is.
    let first_secs = if known.is_empty() { f64::NEG_INFINITY } else { order.now_secs };
    let mut cards: Vec<TakeCard> = Vec::new();
    for take in &found.takes {
        let Some(made) = &take.made else { continue };
        let before = ancestor(take, known, &found.takes);
        let stored = takes.get(&found.name, take.id);
        let same = before.filter(|card| Arc::ptr_eq(&card.actor.motion, &made.motion));
        let Some(actor) = session.actor_in(active, take.id, theme) else { continue };
        let lane = same.map_or_else(|| Arc::new(lane_of(made, &actor)), |c| Arc::clone(&c.lane));
        let t = &take.terms;
        cards.push(TakeCard {
            id: take.id,
            number: before.map_or(usize::MAX, |card| card.number),
            hue: before.map_or(N_HUES, |card| card.hue),
            name: stored.and_then(|stored| stored.name.clone()),
            is_pinned: stored.is_some_and(|stored| stored.pinned),
            is_stale: found.is_stale(take),
            is_by_hand: take.by_hand.as_ref().is_some_and(|by_hand| !by_hand.layer.is_empty()),
            score: f64::from(take.score),
            terms: [t.continuity, t.length, t.body, t.environment].map(f64::from),
            actor,
            lane,
            came_at_secs: before.map_or(first_secs, |card| card.came_at_secs),
        });
    }
    // Stable: what is equal stays as the search has it.
    if order.are_held {
        cards.sort_by_key(|card| card.number);
    } else {
        cards.sort_by(|a, b| {
            b.is_pinned.cmp(&a.is_pinned).then_with(|| a.score.total_cmp(&b.score))
        });
    }
    for nth in 0..cards.len() {
        cards[nth].number = nth + 1;
        if cards[nth].hue == N_HUES {
            cards[nth].hue = free_hue(&cards);
        }
    }
    cards
}

/// The card of this take, or of the take that it was made of if that is gone.
fn ancestor<'a>(take: &Take, known: &'a [TakeCard], found: &[Take]) -> Option<&'a TakeCard> {
    let own = known.iter().find(|card| card.id == take.id);
    own.or_else(|| {
        let parent = take.parent.filter(|parent| found.iter().all(|other| other.id != *parent))?;
        known.iter().find(|card| card.id == parent)
    })
}

/// The hue that the fewest cards have.
fn free_hue(cards: &[TakeCard]) -> usize {
    let count = |hue: &usize| cards.iter().filter(|card| card.hue == *hue).count();
    (0..N_HUES).min_by_key(count).unwrap_or_default()
}

fn lane_of(made: &Made, actor: &Actor) -> Lane {
    let report: &AlternativeReport = &made.report;
    let mut pieces = Vec::with_capacity(report.pieces.len());
    for (nth, piece) in report.pieces.iter().enumerate() {
        let frame_of = |nth: usize| report.seams.get(nth).map(|seam| seam.frame as usize);
        let from = nth.checked_sub(1).and_then(frame_of).unwrap_or_default();
        let to = frame_of(nth).unwrap_or(report.frames as usize);
        pieces.push(Piece {
            clip: piece.clip.clone(),
            frames: from..to.max(from),
            of_clip: (piece.from, piece.to),
        });
    }
    let cut = |seam: &SeamReport| Cut {
        frame: seam.frame as usize,
        cost: seam.cost,
        is_bridge: seam.bridge,
    };
    let (plants, foot_faults) = feet_of(actor);
    Lane {
        pieces,
        cuts: report.seams.iter().map(cut).collect(),
        misses: report.final_.clone(),
        raw_misses: report.raw.clone(),
        plants,
        foot_faults,
        speed_m_s: root_speeds_m_s(&actor.motion),
        turn_deg_s: root_turns_deg_s(&actor.motion),
        foot_slide_cm_per_s: report.quality.as_ref().and_then(|q| q.foot_slide_cm_per_s),
    }
}

/// Stretches of frames of each foot.
type Feet = [Vec<Range<usize>>; 2];

/// When each foot is planted, and when it slides or sinks meanwhile.
fn feet_of(actor: &Actor) -> (Feet, Feet) {
    let fps = actor.motion.fps();
    let feet = Side::BOTH.map(|side| {
        let Some(toe) = contacts::toe_joint(&actor.skeleton, side) else {
            return Default::default();
        };
        let path_m = actor.motion.joint_path_m(&actor.skeleton, toe);
        let planted = contacts::planted_on_lowest(&path_m, fps);
        let plants = contacts::runs(planted.len(), |frame| planted[frame]);
        let faults = foot_faults(&path_m, fps, &plants);
        (plants, faults)
    });
    let [(left, left_faults), (right, right_faults)] = feet;
    ([left, right], [left_faults, right_faults])
}
