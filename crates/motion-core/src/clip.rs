//! Clips: motions of one skeleton at one rate, with what was found out about them.

use crate::ground::GroundTrack;
use crate::ids::ClipId;
use crate::motion::Motion;
use crate::skeleton::Skeleton;
use crate::tags::{self, TagSpan};
use crate::units::{Fps, FrameIdx};

/// A motion of the library.
#[derive(Clone, Debug, PartialEq)]
pub struct Clip {
    /// The file's stem; a mirror image has `@mirror` appended. Unique in its set.
    pub id: String,
    /// Words for what happens in it, by its name: they are about the clip as a whole.
    pub tags: Vec<String>,
    /// What was found to happen in it, and where. Kept whole by [`Clip::found`].
    pub tag_spans: Vec<TagSpan>,
    /// What the body does.
    pub motion: Motion,
    /// Where it is on the ground.
    pub track: GroundTrack,
}

impl Clip {
    /// A clip with the stretches that [`tags::find`] finds in it; `motion` is one of `skeleton`
    /// with `track` as its own, floors calibrated.
    pub fn found(
        skeleton: &Skeleton,
        id: String,
        tags: Vec<String>,
        motion: Motion,
        track: GroundTrack,
    ) -> Self {
        let tag_spans = tags::find(skeleton, &motion, &track);
        Self { id, tags, tag_spans, motion, track }
    }

    /// Whether a frame has a tag, small and capital letters alike. `turn` is had by what turns left
    /// or right.
    ///
    /// Where the tag was found anywhere in the clip, the stretches found rule; else the clip's name
    /// does, for all frames. For many frames ask [`Clip::frames_with_tag`].
    pub fn has_tag_at(&self, tag: &str, frame: FrameIdx) -> bool {
        if frame.idx() >= self.n_frames() {
            return false;
        }
        let mut found = self.spans_of(tag).peekable();
        match found.peek() {
            Some(_) => found.any(|span| span.has(frame)),
            None => tags::has_words(tag, self.tags.iter().map(String::as_str)),
        }
    }

    /// [`Clip::has_tag_at`] for each frame.
    pub fn frames_with_tag(&self, tag: &str) -> Vec<bool> {
        let n_frames = self.n_frames();
        let mut found = self.spans_of(tag).peekable();
        if found.peek().is_none() {
            return vec![tags::has_words(tag, self.tags.iter().map(String::as_str)); n_frames];
        }
        let mut mask = vec![false; n_frames];
        for span in found {
            let to = span.to.idx().min(n_frames.saturating_sub(1));
            mask[span.from.idx().min(to)..=to].fill(true);
        }
        mask
    }

    /// The found stretches whose tag is what is asked for.
    fn spans_of(&self, tag: &str) -> impl Iterator<Item = &TagSpan> {
        self.tag_spans.iter().filter(move |span| tags::has_words(tag, [span.tag.as_str()]))
    }

    /// How many frames the clip has.
    #[inline]
    pub fn n_frames(&self) -> usize {
        self.motion.n_frames()
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
