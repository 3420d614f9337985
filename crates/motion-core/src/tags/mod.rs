//! Tags: words for what happens in a clip, and in which frames of it.
//!
//! There are three kinds, and [`Clip::has_tag_at`] and [`HandTags::frames_with_tag`] know how they
//! combine:
//!
//! 1. **Found** in the motion itself ([`find`]): a rule per family, a file each, whose numbers are
//!    in that file and in `docs/tags.md`. They are about stretches of frames.
//! 2. **Named** by a file's name or its folder's `INDEX.tsv`: about whole clips.
//! 3. **Given by hand** ([`HandTags`]): about a clip or a stretch; they only add.
//!
//! Where a tag was found anywhere in a clip, the stretches found rule and the clip's name does not
//! count for that tag: in a clip called `run` whose first second stands still, that second is no
//! run. Where nothing was found, the name rules: it may mean what no rule knows.
//!
//! [`Clip::has_tag_at`]: crate::clip::Clip::has_tag_at

mod direction;
mod fall;
mod gait;
mod hand;
mod height;
mod jump;
mod signals;
mod span;
mod turn;
mod whole;
mod words;

use crate::ground::GroundTrack;
use crate::motion::Motion;
use crate::skeleton::Skeleton;

pub use hand::{HandTag, HandTags};
pub use signals::{REFERENCE_LEG_M, Signals, TRAVEL_SPAN_SECS, TURN_SPAN_SECS};
pub(crate) use signals::{travel_m_s, turn_rad_s};
pub use span::TagSpan;
pub use whole::{STATE_SHARE, found_of, whole_tags};
pub use words::{has_words, mirrored, words};

/// Every tag that [`find`] may find.
pub const FOUND_TAGS: [&str; 10] = [
    "walk",
    "run",
    "idle",
    "backward",
    "sideways",
    "turn left",
    "turn right",
    "crouch",
    "jump",
    "fall",
];

/// The stretches of a clip that have a tag by what the body does in them, in the order of
/// [`FOUND_TAGS`] and then of their frames.
///
/// `track` is the motion's own, floors calibrated. A body whose legs are not known (a dog, a robot
/// arm) has no tags. The same motion gives the same stretches at any size of the body.
pub fn find(skeleton: &Skeleton, motion: &Motion, track: &GroundTrack) -> Vec<TagSpan> {
    Signals::new(skeleton, motion, track).map_or_else(Vec::new, |signals| find_in(&signals))
}

/// [`find`] from signals that are there already.
pub fn find_in(signals: &Signals) -> Vec<TagSpan> {
    let families = [gait::find, direction::find, turn::find, height::find, jump::find, fall::find];
    let mut spans: Vec<TagSpan> = families.iter().flat_map(|find| find(signals)).collect();
    let place = |tag: &str| FOUND_TAGS.iter().position(|known| *known == tag);
    spans.sort_by_key(|span| (place(&span.tag), span.from));
    spans
}

/// The stretches as they are in the mirror: left and right exchanged, in the order of [`find`].
pub fn mirrored_spans(spans: &[TagSpan]) -> Vec<TagSpan> {
    let image = |span: &TagSpan| TagSpan { tag: mirrored(&span.tag), ..*span };
    let mut images: Vec<TagSpan> = spans.iter().map(image).collect();
    let place = |tag: &str| FOUND_TAGS.iter().position(|known| *known == tag);
    images.sort_by_key(|span| (place(&span.tag), span.from));
    images
}

#[cfg(test)]
mod tests;
