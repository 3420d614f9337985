//! What a library can do and what it cannot: how fast its bodies travel and turn, how high and low
//! they get, where its clips lead, and what would be worth recording (`docs/coverage.md`).

mod capture;
mod heights;
mod travel;
mod ways;

use crate::clip::ClipSet;
use crate::graph::MotionGraph;
use crate::tags::{FOUND_TAGS, TagSpan};

pub use capture::{Gait, Missing, Turn};
pub use heights::{Heights, Jump};
pub use travel::{Cell, EMPTY_SECS, SpeedClass, Travel, TurnClass};
pub use ways::{ClipWays, Parts, Ways};

/// What there is of a tag.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct TagCover {
    /// The tag, one of [`FOUND_TAGS`].
    pub tag: &'static str,
    /// How long it goes on in all clips together, seconds.
    pub secs: f64,
    /// In how many clips it is.
    pub n_clips: usize,
}

/// What the clips and their graph can do.
#[derive(Clone, Debug, PartialEq)]
pub struct Coverage {
    /// How many clips.
    pub n_clips: usize,
    /// How long they are together, seconds.
    pub secs: f64,
    /// Whether the body has legs that are known: without them there are no tags, no heights and no
    /// list of what to record for a person.
    pub has_legs: bool,
    /// Travel and turning.
    pub travel: Travel,
    /// Jumps, crouches, steps.
    pub heights: Heights,
    /// Tags found in the motions, every one, those that are not there too.
    pub tags: Vec<TagCover>,
    /// Where clips lead, and which hang together.
    pub ways: Ways,
    /// What is missing, the most useful first.
    pub missing: Vec<Missing>,
}

impl Coverage {
    /// The coverage of clips with their graph. Takes some milliseconds per thousand frames.
    pub fn new(clips: &ClipSet, graph: &MotionGraph) -> Self {
        let fps = clips.fps();
        let has_legs = clips.skeleton().leg_length_m().is_some();
        let tags = FOUND_TAGS.iter().map(|&tag| {
            let of = |spans: &[TagSpan]| -> usize {
                let own = spans.iter().filter(|span| span.tag == tag);
                own.map(TagSpan::n_frames).sum()
            };
            let per_clip = clips.clips().iter().map(|clip| of(&clip.tag_spans));
            let (n_frames, n_clips) =
                per_clip.fold((0, 0), |(sum, n), own| (sum + own, n + usize::from(own > 0)));
            TagCover { tag, secs: n_frames as f64 * fps.frame_secs(), n_clips }
        });
        let mut coverage = Self {
            n_clips: clips.clips().len(),
            secs: clips.clips().iter().map(|clip| fps.duration_secs(clip.n_frames())).sum(),
            has_legs,
            travel: Travel::new(clips),
            heights: Heights::new(clips),
            tags: tags.collect(),
            ways: Ways::new(clips, graph),
            missing: Vec::new(),
        };
        coverage.missing = capture::missing(clips, &coverage);
        coverage
    }

    /// How long a tag goes on, seconds.
    pub fn tag_secs(&self, tag: &str) -> f64 {
        self.tags.iter().find(|cover| cover.tag == tag).map_or(0.0, |cover| cover.secs)
    }
}

#[cfg(test)]
mod tests;
