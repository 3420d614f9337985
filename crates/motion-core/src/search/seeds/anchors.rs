//! Frames of clips that a seed must or should come through at certain times.

use std::sync::{Arc, OnceLock};

use glam::Vec2;

use super::super::hard::HardStretch;
use super::super::library::SearchLibrary;
use super::super::reading::Subject;
use super::super::target::Target;
use super::wayfinder::Wayfinder;
use crate::graph::EdgeId;
use crate::ids::ClipId;
use crate::path::Piece;
use crate::units::FrameIdx;

/// Frames of clips that joints' wishes are tried with.
const GUIDES_PER_JOINT: usize = 24;

/// Guides of one joint are at least so many frames apart in a clip.
const GUIDES_APART: u32 = 12;

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
}

impl Anchor {
    /// The first piece.
    #[inline]
    pub(crate) fn piece(&self) -> Piece {
        self.pieces[0]
    }
}

/// A frame whose pose has a joint where it is wished, up to a planar move.
#[derive(Debug)]
struct Guide {
    clip: ClipId,
    frame: u32,
    ways: OnceLock<Arc<Wayfinder>>,
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
                let still = crate::planar::PlanarTransform::IDENTITY;
                for frame in 0..library.n_frames(clip) {
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
        let ways = guide
            .ways
            .get_or_init(|| Arc::new(Wayfinder::new(library, scope, (guide.clip, guide.frame))));
        let frame = FrameIdx(guide.frame);
        Anchor {
            first: self.at,
            pieces: vec![Piece { clip: guide.clip, from: frame, to: frame }],
            cuts: Vec::new(),
            ways: Arc::clone(ways),
            ground_m: Some(self.wished_m),
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
        let anchor = |(hard, cuts): (&HardStretch, Vec<EdgeId>)| {
            let first = hard.pieces[0];
            Anchor {
                first: hard.first,
                ways: Arc::new(Wayfinder::new(library, scope, (first.clip, first.from.0))),
                pieces: hard.pieces.clone(),
                cuts,
                ground_m: None,
            }
        };
        let hard = target.hard.iter().zip(inner_cuts).map(anchor).collect();
        let joints = Arc::new(JointGuides::of(library, target, scope.0));
        Self { hard, joints }
    }
}
