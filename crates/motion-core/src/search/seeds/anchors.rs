//! Frames of clips that a seed must or should come through at certain times.

use std::sync::{Arc, OnceLock};

use glam::Vec2;
use rand::RngExt;
use rand_pcg::Pcg64Mcg;

use super::super::hard::HardStretch;
use super::super::library::{Cut, SearchLibrary};
use super::super::reading::Subject;
use super::super::target::Target;
use super::countdown::Countdown;
use super::wayfinder::Wayfinder;
use crate::graph::EdgeId;
use crate::ids::ClipId;
use crate::path::Piece;
use crate::units::FrameIdx;

/// Frames of clips that joints' wishes are tried with.
const GUIDES_PER_JOINT: usize = 24;

/// Frames before something hard of which the cost is known exactly, at most.
const LONGEST_COUNTDOWN: u32 = 300;

/// Guides of one joint are at least so many frames apart in a clip.
const GUIDES_APART: u32 = 12;

/// A frame that so many cuts lead to, from each of so many clips, is met by chance; with fewer, a way
/// in is chosen first.
const EASILY_ENTERED: (usize, usize) = (200, 6);

/// Ways in from one clip that are chosen from.
const ENTRIES_PER_CLIP: usize = 8;

/// A cut by which a stretch's clip is entered in time, and how to come to it in turn.
#[derive(Debug)]
struct Entry {
    cut: Cut,
    ways: OnceLock<Arc<Wayfinder>>,
    before: OnceLock<Entries>,
}

/// The clips from which a frame is entered, the cheapest first, and by which cuts; empty where they
/// are many.
type Entries = Vec<(ClipId, Vec<Entry>)>;

fn entries(library: &SearchLibrary, scope: (&[bool], bool), clip: ClipId, frame: u32) -> Entries {
    let (allowed, bridges) = scope;
    let mut all: Vec<(ClipId, Vec<Cut>)> = Vec::new();
    let mut n_rich = 0;
    for (from, pair) in library.pairs_into(clip) {
        if from == clip || !allowed[from.idx()] {
            continue;
        }
        let fits = |cut: &&Cut| {
            cut.to <= frame && cut.from >= 1 && (bridges || cut.id.0 < pair.first_bridge)
        };
        let mut cuts: Vec<Cut> = pair.leaves.iter().filter(fits).copied().collect();
        if cuts.is_empty() {
            continue;
        }
        n_rich += usize::from(cuts.len() >= EASILY_ENTERED.0);
        cuts.sort_by(|a, b| a.cost.total_cmp(&b.cost).then(a.id.cmp(&b.id)));
        all.push((from, cuts));
        if n_rich >= EASILY_ENTERED.1 {
            return Vec::new();
        }
    }
    all.sort_by(|(_, a), (_, b)| a[0].cost.total_cmp(&b[0].cost));
    let kept = |cuts: Vec<Cut>| {
        let mut kept: Vec<Cut> = Vec::new();
        for cut in cuts {
            let near = |c: &Cut| c.from.abs_diff(cut.from) < 8 && c.to.abs_diff(cut.to) < 8;
            if kept.len() < ENTRIES_PER_CLIP && !kept.iter().any(near) {
                kept.push(cut);
            }
        }
        let entry = |cut| Entry { cut, ways: OnceLock::new(), before: OnceLock::new() };
        kept.into_iter().map(entry).collect()
    };
    all.into_iter().map(|(from, cuts)| (from, kept(cuts))).collect()
}

/// The smaller of two draws: the first of `n` more often than the last.
fn rather_first(n: usize, rng: &mut Pcg64Mcg) -> usize {
    rng.random_range(0..n).min(rng.random_range(0..n))
}

/// A stretch to come through, and the ways to it.
#[derive(Clone, Debug)]
pub(crate) struct Anchor {
    /// The motion's frame that shows the first of it.
    pub(crate) first: u32,
    pub(crate) pieces: Vec<Piece>,
    /// The cuts between the pieces.
    pub(crate) cuts: Vec<EdgeId>,
    pub(crate) ways: Arc<Wayfinder>,
    /// Where the torso should be then, if the anchor stands for a joint's wish.
    pub(crate) ground_m: Option<Vec2>,
    /// Ways into it, where there are few.
    entries: Arc<Entries>,
    /// What it costs to be there in time, for what is hard.
    pub(crate) countdown: Option<Arc<Countdown>>,
}

impl Anchor {
    /// The first piece.
    #[inline]
    pub(crate) fn piece(&self) -> Piece {
        self.pieces[0]
    }

    /// The anchor with ways in chosen by chance before it, where few lead to it: what remains is a
    /// frame that is easily met at its time. Not before the motion's frame `earliest`.
    pub(crate) fn entered_by_chance(
        &self,
        library: &SearchLibrary,
        scope: (&[bool], bool),
        earliest: u32,
        rng: &mut Pcg64Mcg,
    ) -> Self {
        let mut anchor = self.clone();
        let mut entries: &Entries = &self.entries;
        for _ in 0..MAX_ENTRIES_DEEP {
            let piece = anchor.piece();
            if piece.from.0 >= anchor.first && rng.random_range(0..2) == 0 {
                // Playing in from the motion's start does too.
                return anchor;
            }
            // In time, and not from where one has been: clips of an island know each other well.
            let in_time = |entry: &&Entry| piece.from.0 - entry.cut.to + earliest < anchor.first;
            let fits: Vec<(ClipId, Vec<&Entry>)> = entries
                .iter()
                .filter(|(from, _)| anchor.pieces.iter().all(|piece| piece.clip != *from))
                .map(|(from, entries)| (*from, entries.iter().filter(in_time).collect()))
                .filter(|(_, entries): &(_, Vec<&Entry>)| !entries.is_empty())
                .collect();
            if fits.is_empty() {
                return anchor;
            }
            let (from, fits) = &fits[rather_first(fits.len(), rng)];
            let entry = fits[rather_first(fits.len(), rng)];
            let (left, entered) = (entry.cut.from - 1, entry.cut.to);
            anchor.first -= piece.from.0 - entered + 1;
            anchor.pieces[0].from = FrameIdx(entered);
            let before = Piece { clip: *from, from: FrameIdx(left), to: FrameIdx(left) };
            anchor.pieces.insert(0, before);
            anchor.cuts.insert(0, entry.cut.id);
            let ways =
                entry.ways.get_or_init(|| Arc::new(Wayfinder::new(library, scope, (*from, left))));
            anchor.ways = Arc::clone(ways);
            entries = entry.before.get_or_init(|| self::entries(library, scope, *from, left));
        }
        anchor
    }
}

/// Ways in that are chosen one before the other.
const MAX_ENTRIES_DEEP: usize = 3;

/// A frame whose pose has a joint where it is wished, up to a planar move.
#[derive(Debug)]
struct Guide {
    clip: ClipId,
    frame: u32,
    ways: OnceLock<(Arc<Wayfinder>, Arc<Entries>)>,
}

/// The frames of the library that suit one joint's wish best.
#[derive(Debug)]
pub(crate) struct JointGuides {
    at: u32,
    wished_m: Vec2,
    guides: Vec<Guide>,
}

impl JointGuides {
    /// For every wished joint that stands apart from where the joint is on average.
    pub(crate) fn of(library: &SearchLibrary, target: &Target, allowed: &[bool]) -> Vec<Self> {
        let is_joint = |subject| matches!(subject, Subject::Joint(_));
        let wishes = target.readings.iter().filter(|reading| is_joint(reading.subject));
        let mut all = Vec::new();
        for reading in wishes {
            let Subject::Joint(joint) = reading.subject else { continue };
            // Height is what a planar move cannot mend; a velocity's size is another.
            let velocity = target.readings.iter().find(|other| {
                other.frame == reading.frame && other.subject == Subject::Velocity(joint)
            });
            let mut errors: Vec<(f32, ClipId, u32)> = Vec::new();
            for clip in (0..library.graph().n_clips()).map(ClipId::from_idx) {
                if !allowed[clip.idx()] {
                    continue;
                }
                for frame in 0..library.n_frames(clip) {
                    // Heights over what the body stands on: a step of the clip is not there.
                    let still = library.torsos(clip)[frame as usize].inverse();
                    let (point, _) = reading.read(library, still, clip, frame);
                    let mut error = reading.height * (point.y - reading.wished.y).powi(2);
                    if let Some(wish) = velocity {
                        let (moving, _) = wish.read(library, still, clip, frame);
                        let ground = |v: glam::Vec3| Vec2::new(v.x, v.z).length();
                        error += wish.height * (moving.y - wish.wished.y).powi(2)
                            + wish.ground * (ground(moving) - ground(wish.wished)).powi(2);
                    }
                    errors.push((error, clip, frame));
                }
            }
            errors.sort_unstable_by(|a, b| a.0.total_cmp(&b.0).then((a.1, a.2).cmp(&(b.1, b.2))));
            // Where most frames would do, the wish is no rare one and needs no guide.
            let common = errors.get(errors.len() / 4).is_none_or(|(error, ..)| *error < 1.0);
            if common {
                continue;
            }
            let mut guides: Vec<Guide> = Vec::new();
            for &(error, clip, frame) in &errors {
                let near = |g: &Guide| g.clip == clip && g.frame.abs_diff(frame) < GUIDES_APART;
                if guides.len() == GUIDES_PER_JOINT || error > errors[0].0 + 9.0 {
                    break;
                }
                if !guides.iter().any(near) {
                    guides.push(Guide { clip, frame, ways: OnceLock::new() });
                }
            }
            let wished_m = Vec2::new(reading.wished.x, reading.wished.z);
            all.push(Self { at: reading.frame, wished_m, guides });
        }
        all
    }

    /// How many frames there are to choose from.
    pub(crate) fn len(&self) -> usize {
        self.guides.len()
    }

    /// The `nth` frame as an anchor.
    pub(crate) fn anchor(
        &self,
        nth: usize,
        library: &SearchLibrary,
        scope: (&[bool], bool),
    ) -> Anchor {
        let guide = &self.guides[nth];
        let ways = guide.ways.get_or_init(|| {
            let ways = Wayfinder::new(library, scope, (guide.clip, guide.frame));
            (Arc::new(ways), Arc::new(entries(library, scope, guide.clip, guide.frame)))
        });
        let frame = FrameIdx(guide.frame);
        Anchor {
            first: self.at,
            pieces: vec![Piece { clip: guide.clip, from: frame, to: frame }],
            cuts: Vec::new(),
            ways: Arc::clone(&ways.0),
            ground_m: Some(self.wished_m),
            entries: Arc::clone(&ways.1),
            countdown: None,
        }
    }
}

/// Everything that seeds of one problem come through.
#[derive(Clone, Debug, Default)]
pub(crate) struct Anchors {
    /// Poses and locks: always.
    pub(crate) hard: Vec<Anchor>,
    /// Joints' wishes: in some seeds.
    pub(crate) joints: Arc<Vec<JointGuides>>,
}

impl Anchors {
    /// The anchors of a target whose locks have their cuts (`inner_cuts`, one list a stretch).
    pub(crate) fn new(
        library: &SearchLibrary,
        target: &Target,
        scope: (&[bool], bool),
        inner_cuts: Vec<Vec<EdgeId>>,
    ) -> Self {
        let mut free_from = 0;
        let anchor = |(hard, cuts): (&HardStretch, Vec<EdgeId>)| {
            let first = hard.pieces[0];
            let longest = hard.first.saturating_sub(free_from).min(LONGEST_COUNTDOWN);
            free_from = hard.last;
            let countdown = Countdown::new(library, scope, (first.clip, first.from.0), longest);
            Anchor {
                first: hard.first,
                ways: Arc::new(Wayfinder::new(library, scope, (first.clip, first.from.0))),
                pieces: hard.pieces.clone(),
                cuts,
                ground_m: None,
                entries: match countdown {
                    Some(_) => Arc::default(),
                    None => Arc::new(entries(library, scope, first.clip, first.from.0)),
                },
                countdown: countdown.map(Arc::new),
            }
        };
        let hard = target.hard.iter().zip(inner_cuts).map(anchor).collect();
        let joints = Arc::new(JointGuides::of(library, target, scope.0));
        Self { hard, joints }
    }
}
