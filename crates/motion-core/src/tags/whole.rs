//! Which tags a clip has as a whole, as palettes and lists see it.

use super::{FOUND_TAGS, HandTags};
use crate::clip::Clip;

/// What goes on for a while is a clip's tag where it is this share of its frames or more. What
/// happens once (a turn, a jump, a fall) is, however short.
pub const STATE_SHARE: f64 = 0.25;

/// The tags found that are over with in a moment.
const EVENTS: [&str; 4] = ["turn left", "turn right", "jump", "fall"];

/// The found tags of a clip as a whole, in the order of [`FOUND_TAGS`]: see [`STATE_SHARE`].
pub fn found_of(clip: &Clip) -> Vec<&'static str> {
    let has = |tag: &&str| {
        let spans = clip.tag_spans.iter().filter(|span| span.tag == **tag);
        let n_tagged: usize = spans.map(super::TagSpan::n_frames).sum();
        let needed = if EVENTS.contains(tag) { 0.0 } else { STATE_SHARE * clip.n_frames() as f64 };
        n_tagged > 0 && n_tagged as f64 >= needed
    };
    FOUND_TAGS.iter().copied().filter(has).collect()
}

/// Every tag of a clip as a whole, each once: what its name says, what was found, and what it or a
/// stretch of it was given by hand. A name is not taken back by what was found: it is how people
/// look for a clip.
pub fn whole_tags(clip: &Clip, by_hand: &HandTags) -> Vec<String> {
    let mut all = clip.tags.clone();
    let found = found_of(clip).into_iter().map(str::to_owned);
    let given = by_hand.effective(&clip.id).into_iter().map(|own| own.tag);
    for tag in found.chain(given) {
        let is_there = all.iter().any(|own| own.to_lowercase() == tag.to_lowercase());
        if !is_there {
            all.push(tag);
        }
    }
    all
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::tags::{HandTag, TagSpan};
    use crate::units::FrameIdx;

    fn span(tag: &str, from: u32, to: u32) -> TagSpan {
        TagSpan { tag: tag.into(), from: FrameIdx(from), to: FrameIdx(to) }
    }

    #[test]
    fn states_need_a_quarter_and_events_a_moment() {
        let mut clip = crate::testing::walks().clips()[0].clone();
        clip.tags = vec!["Walk".into(), "late".into()];
        clip.tag_spans =
            vec![span("walk", 0, 50), span("run", 51, 59), span("idle", 0, 14), span("jump", 3, 5)];
        assert_eq!(clip.n_frames(), 60);
        assert_eq!(found_of(&clip), ["walk", "idle", "jump"]);
        let mut by_hand = HandTags::default();
        by_hand.give("0", HandTag { tag: "tired".into(), frames: None });
        assert_eq!(whole_tags(&clip, &by_hand), ["Walk", "late", "idle", "jump", "tired"]);
    }
}
