//! Takes and their copies: which clips show the same moment of the same capture.
//!
//! A library may hold a take several times: mirrored, or slower, faster, disturbed. Such copies
//! are a **family**. What is most like a frame is then its own image in a copy, and cutting
//! there is no cut: the same goes on. And a copy is no other clip when τ is chosen.
//!
//! Families are declared by ids: a clip called `TAKE~ANYTHING` is a copy of `TAKE`, and
//! `…@mirror` its mirror image.

use std::collections::HashMap;

use crate::ids::ClipId;
use crate::skeleton::mirror::MIRROR_SUFFIX;

/// What parts a take's id from what its copy is called.
pub const COPY_SEPARATOR: char = '~';

/// The take that a clip shows, and whether in the mirror.
///
/// ```
/// use motion_core::similarity::families::take_of;
///
/// assert_eq!(take_of("16_15~slow@mirror"), ("16_15", true));
/// assert_eq!(take_of("16_15"), ("16_15", false));
/// ```
pub fn take_of(clip_id: &str) -> (&str, bool) {
    let (id, is_mirrored) = match clip_id.strip_suffix(MIRROR_SUFFIX) {
        Some(original) => (original, true),
        None => (clip_id, false),
    };
    // A name that begins with the separator is a name.
    match id.find(COPY_SEPARATOR) {
        Some(end) if end > 0 => (&id[..end], is_mirrored),
        _ => (id, is_mirrored),
    }
}

/// Families of a library's clips.
///
/// Invariant: clips of one hand are of one family.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Families {
    family_of_clip: Vec<u32>,
    hand_of_clip: Vec<u32>,
    /// Frames of each clip.
    clip_frames: Vec<u32>,
}

impl Families {
    /// The families that clips called `ids` say of themselves.
    ///
    /// # Panics
    /// When there is not a number of frames for each id.
    pub fn of_ids<'a>(ids: impl IntoIterator<Item = &'a str>, clip_frames: &[u32]) -> Self {
        let mut families: HashMap<&str, u32> = HashMap::new();
        let (mut family_of_clip, mut hand_of_clip) = (Vec::new(), Vec::new());
        for id in ids {
            let (take, is_mirrored) = take_of(id);
            let next = families.len() as u32;
            let family = *families.entry(take).or_insert(next);
            family_of_clip.push(family);
            hand_of_clip.push(2 * family + u32::from(is_mirrored));
        }
        assert_eq!(family_of_clip.len(), clip_frames.len(), "frames for each clip");
        Self { family_of_clip, hand_of_clip, clip_frames: clip_frames.to_vec() }
    }

    /// Every clip a family of its own.
    pub fn none(clip_frames: &[u32]) -> Self {
        let family_of_clip: Vec<u32> = (0..clip_frames.len() as u32).collect();
        let hand_of_clip = family_of_clip.iter().map(|family| 2 * family).collect();
        Self { family_of_clip, hand_of_clip, clip_frames: clip_frames.to_vec() }
    }

    /// The family of a clip; a clip and its mirror image have the same.
    #[inline]
    pub fn family(&self, clip: ClipId) -> u32 {
        self.family_of_clip[clip.idx()]
    }

    /// The hand of a clip: copies of a take that are mirrored alike. Only they show the same
    /// moments, since in the mirror the other foot is ahead.
    #[inline]
    pub fn hand(&self, clip: ClipId) -> u32 {
        self.hand_of_clip[clip.idx()]
    }

    /// Whether frames of two clips show the same moment, within `min_jump` frames of the longer
    /// one: they are copies of one hand, and are as far into their clips, as a share of the
    /// whole. Within one clip: whether a cut would jump fewer than `min_jump` frames.
    #[inline]
    pub fn is_same_moment(&self, a: (ClipId, u32), b: (ClipId, u32), min_jump: u32) -> bool {
        if self.hand(a.0) != self.hand(b.0) {
            return false;
        }
        let last = |clip: ClipId| u64::from(self.clip_frames[clip.idx()]).max(2) - 1;
        let (last_a, last_b) = (last(a.0), last(b.0));
        // |a / last_a − b / last_b| · max(last_a, last_b) < min_jump, in whole numbers.
        let apart = (u64::from(a.1) * last_b).abs_diff(u64::from(b.1) * last_a);
        apart < u64::from(min_jump) * last_a.min(last_b)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn ids_say_the_take() {
        for (id, take, is_mirrored) in [
            ("walk", "walk", false),
            ("walk@mirror", "walk", true),
            ("walk~w03", "walk", false),
            ("walk~w03@mirror", "walk", true),
            ("walk~w03~w04", "walk", false),
            ("~walk", "~walk", false),
        ] {
            assert_eq!(take_of(id), (take, is_mirrored), "{id}");
        }
    }

    #[test]
    fn mirror_images_are_family_and_other_moments() {
        let ids = ["a", "b", "a@mirror", "a~1", "a~1@mirror"];
        let families = Families::of_ids(ids, &[10; 5]);
        let family = |clip| families.family(ClipId(clip));
        let hand = |clip| families.hand(ClipId(clip));
        assert!(family(0) == family(2) && family(0) == family(4) && family(0) != family(1));
        assert!(hand(0) == hand(3) && hand(2) == hand(4) && hand(0) != hand(2));
    }

    #[test]
    fn within_a_clip_the_moment_is_the_frame() {
        let families = Families::none(&[100]);
        let clip = ClipId(0);
        for (i, j) in [(0, 8), (50, 58), (58, 50), (99, 91)] {
            assert!(families.is_same_moment((clip, i), (clip, j), 9), "{i} {j}");
        }
        for (i, j) in [(0, 9), (50, 59), (59, 50), (99, 90)] {
            assert!(!families.is_same_moment((clip, i), (clip, j), 9), "{i} {j}");
        }
    }

    #[test]
    fn a_copy_of_twice_the_length_has_its_moments_twice_as_late() {
        let families = Families::of_ids(["a", "a~slow", "a@mirror"], &[51, 101, 51]);
        let same = |i, j| families.is_same_moment((ClipId(0), i), (ClipId(1), j), 9);
        assert!(same(25, 50) && same(25, 58) && same(25, 42), "frames of the longer one");
        assert!(!same(25, 59) && !same(25, 41) && !same(50, 50));
        let mirrored = families.is_same_moment((ClipId(0), 25), (ClipId(2), 25), 9);
        assert!(!mirrored, "in the mirror it is another moment");
    }
}
