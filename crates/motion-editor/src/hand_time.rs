//! From the frames of a retimed motion to those of the motion before, and back.
//!
//! `frames` has for every output frame the source frame that is shown, never falling. Both ways are
//! linear between frames and go on a frame a frame beyond the ends.

/// The source frame at an output frame.
pub fn source_of(frames: &[f64], output: f64) -> f64 {
    let Some((&first, &last)) = frames.first().zip(frames.last()) else { return output };
    let end = (frames.len() - 1) as f64;
    if output <= 0.0 {
        return first + output;
    }
    if output >= end {
        return last + output - end;
    }
    let at = output.floor() as usize;
    let share = output - at as f64;
    frames[at] + share * (frames[at + 1] - frames[at])
}

/// The first output frame at which a source frame is reached.
pub fn output_of(frames: &[f64], source: f64) -> f64 {
    let Some((&first, &last)) = frames.first().zip(frames.last()) else { return source };
    if source <= first {
        return source - first;
    }
    if source > last {
        return (frames.len() - 1) as f64 + source - last;
    }
    let after = frames.partition_point(|frame| *frame < source);
    let Some(before) = after.checked_sub(1) else { return 0.0 };
    let step = frames[after] - frames[before];
    before as f64 + if step > 0.0 { (source - frames[before]) / step } else { 1.0 }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn there_and_back() {
        // Slow at first, standing still at 2, twice as fast at the end.
        let frames = [0.0, 0.5, 1.0, 2.0, 2.0, 2.0, 4.0, 6.0];
        for (output, source) in
            [(0.0, 0.0), (1.0, 0.5), (2.5, 1.5), (5.5, 3.0), (7.0, 6.0), (9.0, 8.0), (-2.0, -2.0)]
        {
            assert_eq!(source_of(&frames, output), source, "{output}");
            assert_eq!(output_of(&frames, source), output, "{source}");
        }
        assert_eq!(source_of(&frames, 4.0), 2.0);
        assert_eq!(output_of(&frames, 2.0), 3.0, "where it begins to stand");
        assert_eq!((source_of(&[], 3.0), output_of(&[], 3.0)), (3.0, 3.0));
        assert_eq!((source_of(&[0.0], 3.0), output_of(&[0.0], 3.0)), (3.0, 3.0));
    }
}
