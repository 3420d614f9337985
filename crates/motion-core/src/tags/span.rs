//! Stretches of frames that carry a tag, and how they come from what is true of single frames.

use crate::units::{Fps, FrameIdx};

/// A tag over a stretch of a clip.
#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub struct TagSpan {
    /// The tag, in small letters; may be of several words.
    pub tag: String,
    /// The first frame that has it.
    pub from: FrameIdx,
    /// The last frame that has it.
    pub to: FrameIdx,
}

impl TagSpan {
    /// Whether the frame is within the stretch.
    #[inline]
    pub fn has(&self, frame: FrameIdx) -> bool {
        self.from <= frame && frame <= self.to
    }

    /// How many frames it has.
    #[inline]
    pub fn n_frames(&self) -> usize {
        self.to.idx() + 1 - self.from.idx()
    }
}

/// Frames `from..=to` as they are found, before they have a name.
pub(super) type Stretch = (usize, usize);

/// What keeps a rule from flickering: it begins where a value is past `enter`, goes on until it is
/// short of `leave`, and lasts.
#[derive(Clone, Copy, Debug)]
pub(super) struct Hysteresis {
    pub(super) enter: f32,
    pub(super) leave: f32,
}

impl Hysteresis {
    /// For each frame whether its value is in. A stretch reaches back to where the value came past
    /// `leave`: it is in wherever `leave` holds and `enter` is met before `leave` ends.
    pub(super) fn mask(self, values: impl IntoIterator<Item = f32>) -> Vec<bool> {
        let values: Vec<f32> = values.into_iter().collect();
        let mut mask = vec![false; values.len()];
        for (from, to) in stretches(values.iter().map(|&value| value >= self.leave)) {
            if values[from..=to].iter().any(|&value| value >= self.enter) {
                mask[from..=to].fill(true);
            }
        }
        mask
    }
}

/// The stretches in which `mask` holds.
pub(super) fn stretches(mask: impl IntoIterator<Item = bool>) -> Vec<Stretch> {
    let mut found: Vec<Stretch> = Vec::new();
    for (frame, is_in) in mask.into_iter().enumerate() {
        match found.last_mut() {
            _ if !is_in => {}
            Some(last) if last.1 + 1 == frame => last.1 = frame,
            _ => found.push((frame, frame)),
        }
    }
    found
}

/// The stretches of `mask` after gaps of fewer than `gap_secs` between them were filled and what
/// is then shorter than `min_secs` was dropped. A clip that is shorter than that as a whole may
/// have a stretch as long as itself.
pub(super) fn lasting(mask: &[bool], gap_secs: f64, min_secs: f64, fps: Fps) -> Vec<Stretch> {
    let (gap, min) = (fps.frames_in_secs(gap_secs), fps.frames_in_secs(min_secs).max(1));
    let mut joined: Vec<Stretch> = Vec::new();
    for stretch in stretches(mask.iter().copied()) {
        match joined.last_mut() {
            Some(last) if stretch.0 - last.1 <= gap => last.1 = stretch.1,
            _ => joined.push(stretch),
        }
    }
    joined.retain(|(from, to)| to + 1 - from >= min.min(mask.len()));
    joined
}

/// Gives stretches their tag.
pub(super) fn tagged(tag: &str, stretches: Vec<Stretch>) -> impl Iterator<Item = TagSpan> {
    stretches.into_iter().map(move |(from, to)| TagSpan {
        tag: tag.to_owned(),
        from: FrameIdx::from_idx(from),
        to: FrameIdx::from_idx(to),
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_stretch_needs_one_value_past_enter_and_all_past_leave() {
        let band = Hysteresis { enter: 2.0, leave: 1.0 };
        let mask = band.mask([0.5, 1.2, 2.1, 1.1, 0.9, 1.5, 1.9, 0.0, 3.0]);
        assert_eq!(mask, [false, true, true, true, false, false, false, false, true]);
        assert_eq!(stretches(mask), [(1, 3), (8, 8)]);
    }

    #[test]
    fn short_gaps_are_filled_and_short_stretches_dropped() {
        let mask: Vec<bool> = "xxx.xx......x....xxxxx".chars().map(|c| c == 'x').collect();
        assert_eq!(lasting(&mask, 0.1, 0.1, Fps::THIRTY), [(0, 5), (17, 21)]);
        assert_eq!(lasting(&[true, true], 0.1, 0.5, Fps::THIRTY), [(0, 1)]);
        assert_eq!(lasting(&[], 0.1, 0.5, Fps::THIRTY), []);
    }
}
