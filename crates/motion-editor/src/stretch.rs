//! Stretches of a take, by the clips that they show.

use motion_session::LockedPiece;

use crate::take_card::{Lane, Piece};

/// What a motion shows from frame `from` to frame `to` (both included): clips with exactly their
/// frames. What lies beyond the motion is left out.
pub fn pieces_in(lane: &Lane, from: usize, to: usize) -> Vec<LockedPiece> {
    let part = |piece: &Piece| {
        let first = piece.frames.start.max(from);
        let last = piece.frames.end.checked_sub(1)?.min(to);
        if first > last {
            return None;
        }
        let of_clip = |frame: usize| piece.of_clip.0 + (frame - piece.frames.start) as u32;
        Some(LockedPiece {
            clip: piece.clip.clone(),
            from: of_clip(first),
            to: of_clip(last),
            extra: Default::default(),
        })
    };
    lane.pieces.iter().filter_map(part).collect()
}

/// The first and last frame of the piece that is shown at `frame`; beyond the motion, of the last.
pub fn stretch_at(lane: &Lane, frame: usize) -> Option<(usize, usize)> {
    let at = lane.pieces.iter().find(|piece| piece.frames.contains(&frame));
    let frames = &at.or(lane.pieces.last())?.frames;
    Some((frames.start, frames.end.checked_sub(1)?))
}

#[cfg(test)]
mod tests {
    use super::*;

    /// `walk` 12–31 is shown at 0–19, `turn` 4–13 at 20–29, `run` 50–69 at 30–49.
    fn lane() -> Lane {
        let piece = |clip: &str, frames, of_clip| Piece { clip: clip.to_owned(), frames, of_clip };
        let pieces = vec![
            piece("walk", 0..20, (12, 31)),
            piece("turn", 20..30, (4, 13)),
            piece("run", 30..50, (50, 69)),
        ];
        Lane { pieces, ..Lane::default() }
    }

    #[test]
    fn stretches_may_begin_and_end_inside_pieces() {
        type Expected<'a> = &'a [(&'a str, u32, u32)];
        let table: [(usize, usize, Expected<'_>); 9] = [
            (0, 49, &[("walk", 12, 31), ("turn", 4, 13), ("run", 50, 69)]),
            (5, 35, &[("walk", 17, 31), ("turn", 4, 13), ("run", 50, 55)]),
            (5, 10, &[("walk", 17, 22)]),
            (19, 20, &[("walk", 31, 31), ("turn", 4, 4)]),
            (20, 29, &[("turn", 4, 13)]),
            (29, 29, &[("turn", 13, 13)]),
            (45, 90, &[("run", 65, 69)]),
            (50, 90, &[]),
            (30, 20, &[]),
        ];
        for (from, to, expected) in table {
            let found = pieces_in(&lane(), from, to);
            let found: Vec<_> = found.iter().map(|p| (p.clip.as_str(), p.from, p.to)).collect();
            assert_eq!(found, expected, "{from}–{to}");
            let n_frames: u32 = found.iter().map(|(_, from, to)| to - from + 1).sum();
            let asked = to.min(49).saturating_sub(from) + usize::from(from <= to.min(49));
            assert_eq!(n_frames as usize, asked, "as many frames as were asked for");
        }
    }

    #[test]
    fn the_stretch_at_a_frame_is_what_lies_between_two_cuts() {
        for (frame, expected) in
            [(0, (0, 19)), (19, (0, 19)), (20, (20, 29)), (49, (30, 49)), (400, (30, 49))]
        {
            assert_eq!(stretch_at(&lane(), frame), Some(expected), "{frame}");
        }
        assert_eq!(stretch_at(&Lane::default(), 0), None);
    }
}
