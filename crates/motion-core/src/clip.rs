//! Clips: motions of one skeleton at one rate, with what was found out about them.

use crate::ground::GroundTrack;
use crate::ids::ClipId;
use crate::motion::Motion;
use crate::skeleton::Skeleton;
use crate::units::{Fps, FrameIdx};

/// A motion of the library.
#[derive(Clone, Debug, PartialEq)]
pub struct Clip {
    /// The file's stem; a mirror image has `@mirror` appended. Unique in its set.
    pub id: String,
    /// Words for what happens in it.
    pub tags: Vec<String>,
    /// What the body does.
    pub motion: Motion,
    /// Where it is on the ground.
    pub track: GroundTrack,
}

impl Clip {
    /// How many frames the clip has.
    #[inline]
    pub fn n_frames(&self) -> usize {
        self.motion.n_frames()
    }

    /// Whether what is done at `frame` is called `tag`; case does not matter.
    pub fn has_tag_at(&self, tag: &str, _frame: FrameIdx) -> bool {
        self.tags.iter().any(|own| own.eq_ignore_ascii_case(tag))
    }
}

/// Clips on one skeleton at one rate, in a fixed order.
///
/// Invariants, checked by [`ClipSet::new`]:
/// 1. Ids are unique.
/// 2. Every clip has the skeleton's number of joints and the set's rate.
/// 3. A clip's track has an entry per frame.
#[derive(Clone, Debug, PartialEq)]
pub struct ClipSet {
    skeleton: Skeleton,
    fps: Fps,
    clips: Vec<Clip>,
}

/// Why clips do not form a set.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum ClipSetError {
    /// Rule 1.
    #[error("two clips are called {0:?}")]
    Id(String),
    /// Rules 2 and 3.
    #[error("clip {0:?} does not fit the set's skeleton, rate or track")]
    Shape(String),
}

impl ClipSet {
    /// A set from clips that share `skeleton` and `fps`.
    pub fn new(skeleton: Skeleton, fps: Fps, clips: Vec<Clip>) -> Result<Self, ClipSetError> {
        let mut seen = std::collections::HashSet::new();
        for clip in &clips {
            let n_frames = clip.n_frames();
            let fits = clip.motion.n_joints() == skeleton.n_joints()
                && clip.motion.fps() == fps
                && clip.track.world_from_torso.len() == n_frames
                && clip.track.contacts.len() == n_frames;
            if !fits {
                return Err(ClipSetError::Shape(clip.id.clone()));
            }
            if !seen.insert(clip.id.as_str()) {
                return Err(ClipSetError::Id(clip.id.clone()));
            }
        }
        Ok(Self { skeleton, fps, clips })
    }

    /// The skeleton of all clips.
    pub fn skeleton(&self) -> &Skeleton {
        &self.skeleton
    }

    /// The rate of all clips.
    pub fn fps(&self) -> Fps {
        self.fps
    }

    /// The clips in order; [`ClipId`] indexes them.
    pub fn clips(&self) -> &[Clip] {
        &self.clips
    }

    /// The clip at `id`.
    #[inline]
    pub fn clip(&self, id: ClipId) -> &Clip {
        &self.clips[id.idx()]
    }

    /// The clip called `id`.
    pub fn by_id(&self, id: &str) -> Option<ClipId> {
        self.clips.iter().position(|clip| clip.id == id).map(ClipId::from_idx)
    }

    /// Frames of all clips together.
    pub fn n_frames(&self) -> usize {
        self.clips.iter().map(Clip::n_frames).sum()
    }
}
