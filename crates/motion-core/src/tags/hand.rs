//! Tags that a person gives to clips and to stretches of them.

use std::collections::BTreeMap;

use super::words::{has_words, mirrored};
use crate::clip::Clip;
use crate::skeleton::mirror::MIRROR_SUFFIX;
use crate::units::FrameIdx;

/// A tag given by hand.
#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub struct HandTag {
    /// The tag.
    pub tag: String,
    /// First and last frame that have it; the whole clip where there are none.
    pub frames: Option<(FrameIdx, FrameIdx)>,
}

impl HandTag {
    /// Whether the frame has it.
    pub fn has(&self, frame: FrameIdx) -> bool {
        self.frames.is_none_or(|(from, to)| from <= frame && frame <= to)
    }
}

/// Tags given by hand, by the id of the clip. They add to what was found in a clip and to what its
/// name says, and a clip's mirror image has them too, left and right exchanged.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct HandTags {
    by_clip: BTreeMap<String, Vec<HandTag>>,
}

impl HandTags {
    /// Whether there are none.
    pub fn is_empty(&self) -> bool {
        self.by_clip.is_empty()
    }

    /// The tags of the clip called `id` itself, in the order in which they were given.
    pub fn of(&self, id: &str) -> &[HandTag] {
        self.by_clip.get(id).map_or(&[], Vec::as_slice)
    }

    /// Clips with their tags, by id.
    pub fn iter(&self) -> impl Iterator<Item = (&str, &[HandTag])> {
        self.by_clip.iter().map(|(id, tags)| (id.as_str(), tags.as_slice()))
    }

    /// Gives a clip a tag; one that it has already is not given twice.
    pub fn give(&mut self, id: &str, tag: HandTag) {
        let own = self.by_clip.entry(id.to_owned()).or_default();
        if !own.contains(&tag) {
            own.push(tag);
        }
    }

    /// Takes a tag from a clip; whether it had it.
    pub fn take(&mut self, id: &str, tag: &HandTag) -> bool {
        let Some(own) = self.by_clip.get_mut(id) else { return false };
        let n_before = own.len();
        own.retain(|own| own != tag);
        let is_taken = own.len() < n_before;
        if own.is_empty() {
            self.by_clip.remove(id);
        }
        is_taken
    }

    /// The tags of a clip: its own, and in the mirror those of the clip that it is the image of.
    pub fn effective(&self, id: &str) -> Vec<HandTag> {
        let mut all = self.of(id).to_vec();
        if let Some(source) = id.strip_suffix(MIRROR_SUFFIX) {
            let image = |tag: &HandTag| HandTag { tag: mirrored(&tag.tag), frames: tag.frames };
            all.extend(self.of(source).iter().map(image));
        }
        all
    }

    /// [`Clip::frames_with_tag`], with what was given by hand.
    pub fn frames_with_tag(&self, clip: &Clip, tag: &str) -> Vec<bool> {
        let mut mask = clip.frames_with_tag(tag);
        for own in self.effective(&clip.id) {
            if has_words(tag, [own.tag.as_str()]) {
                for (frame, has) in mask.iter_mut().enumerate() {
                    *has |= own.has(FrameIdx::from_idx(frame));
                }
            }
        }
        mask
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn over(tag: &str, frames: Option<(u32, u32)>) -> HandTag {
        let frames = frames.map(|(from, to)| (FrameIdx(from), FrameIdx(to)));
        HandTag { tag: tag.to_owned(), frames }
    }

    #[test]
    fn tags_are_given_once_and_taken() {
        let mut tags = HandTags::default();
        tags.give("walk", over("tired", None));
        tags.give("walk", over("tired", None));
        assert_eq!(tags.of("walk").len(), 1);
        assert!(!tags.take("walk", &over("tired", Some((0, 3)))));
        assert!(tags.take("walk", &over("tired", None)));
        assert!(tags.is_empty(), "a clip without tags is not kept");
    }

    #[test]
    fn an_image_has_the_tags_of_its_clip_mirrored() {
        let mut tags = HandTags::default();
        tags.give("walk", over("limp left", Some((2, 4))));
        tags.give("walk@mirror", over("odd", None));
        let image = tags.effective("walk@mirror");
        assert_eq!(image, [over("odd", None), over("limp right", Some((2, 4)))]);
        assert_eq!(tags.effective("walk"), [over("limp left", Some((2, 4)))]);
    }

    #[test]
    fn a_stretch_by_hand_adds_to_what_was_found() {
        let mut clip = crate::testing::walks().clips()[0].clone();
        let span = |from, to| crate::tags::TagSpan {
            tag: "walk".into(),
            from: FrameIdx(from),
            to: FrameIdx(to),
        };
        clip.tag_spans = vec![span(10, 19)];
        let mut tags = HandTags::default();
        tags.give("0", over("walk", Some((15, 24))));
        let n_with = |tag| tags.frames_with_tag(&clip, tag).into_iter().filter(|has| *has).count();
        assert_eq!((n_with("walk"), n_with("WALK"), n_with("tired")), (15, 15, 0));
    }
}
