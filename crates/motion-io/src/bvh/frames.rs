//! The MOTION part of a BVH file: a header of two lines, then a line per frame.

use std::path::Path;

use motion_core::units::Fps;

use crate::diagnostic::{FileError, quoted};
use crate::limits;
use crate::text::{Line, Text, decimal_places, parse_number, within};

/// The rate and the numbers of all frames, frame-major; `text` stands behind the word MOTION.
///
/// Nothing is allocated for frames that the rest of the file is too short to hold.
pub(super) fn read_frames(
    text: &mut Text<'_>,
    n_channels: usize,
    path: &Path,
) -> Result<(Fps, Vec<f64>), FileError> {
    let frames = header_line(text, path, "Frames")?;
    let n_frames = number_of_frames(frames, path)?;
    let frame_time = header_line(text, path, "Frame Time")?;
    let fps = rate_of(frame_time, path)?;

    // A number takes a digit and a separator; only the last separator may be missing.
    let n_values = n_frames.saturating_mul(n_channels);
    if n_values.saturating_mul(2) > text.remaining_bytes().saturating_add(1) {
        return Err(too_few_frames(text, path, n_frames, n_channels, frames.number));
    }
    let mut values = Vec::with_capacity(n_values);
    let mut n_read = 0;
    while let Some(line) = text.next_line() {
        if line.is_blank() {
            continue;
        }
        if n_read == n_frames {
            return Err(FileError::new(
                path,
                format!(
                    "there are more frames than the {n_frames} that line {} says",
                    frames.number
                ),
                "correct the number behind Frames:",
            )
            .at_line(line.number));
        }
        read_frame(line, n_channels, path, &mut values)?;
        n_read += 1;
    }
    if n_read < n_frames {
        return Err(ends_early(path, text.line(), n_read, n_frames, frames.number));
    }
    Ok((fps, values))
}

/// One `Key: value` line of the header.
#[derive(Clone, Copy)]
struct HeaderLine<'a> {
    number: u32,
    value: &'a [u8],
}

fn header_line<'a>(
    text: &mut Text<'a>,
    path: &Path,
    key: &str,
) -> Result<HeaderLine<'a>, FileError> {
    let line = loop {
        match text.next_line() {
            Some(line) if line.is_blank() => {}
            Some(line) => break line,
            None => {
                return Err(FileError::new(
                    path,
                    format!("the file ends before {key}:"),
                    "export it again, it is cut off",
                )
                .at_line(text.line()));
            }
        }
    };
    let colon = line.bytes.iter().position(|&b| b == b':');
    let (found, value) = line.bytes.split_at(colon.unwrap_or(0));
    let words = found.split(u8::is_ascii_whitespace).filter(|w| !w.is_empty());
    if colon.is_none() || !words.map(<[u8]>::to_ascii_lowercase).eq(key_words(key)) {
        return Err(FileError::new(
            path,
            format!("{} stands where {key}: is expected", quoted(line.bytes.trim_ascii())),
            "write Frames: and Frame Time: behind MOTION",
        )
        .at_line(line.number));
    }
    Ok(HeaderLine { number: line.number, value: value[1..].trim_ascii() })
}

fn key_words(key: &str) -> impl Iterator<Item = Vec<u8>> {
    key.split(' ').map(|word| word.to_ascii_lowercase().into_bytes())
}

fn number_of_frames(line: HeaderLine<'_>, path: &Path) -> Result<usize, FileError> {
    let error = |what: String, what_to_do: &str| {
        Err(FileError::new(path, what, what_to_do).at_line(line.number))
    };
    let number: Option<u128> = std::str::from_utf8(line.value).ok().and_then(|v| v.parse().ok());
    match number.map(usize::try_from) {
        None => error(
            format!("the number of frames {} is not a whole number", quoted(line.value)),
            "write how many lines of numbers follow",
        ),
        Some(Ok(0)) => error("there are no frames".to_owned(), "export at least one"),
        Some(Ok(n)) if n <= limits::MAX_CLIP_FRAMES => Ok(n),
        Some(_) => error(
            format!(
                "{} frames are more than the {} that are allowed",
                String::from_utf8_lossy(line.value),
                limits::MAX_CLIP_FRAMES
            ),
            "split the motion into several files",
        ),
    }
}

fn rate_of(line: HeaderLine<'_>, path: &Path) -> Result<Fps, FileError> {
    let error = |what: String| {
        Err(FileError::new(path, what, "write the seconds between frames, like 0.0333333")
            .at_line(line.number))
    };
    let shown = quoted(line.value);
    let Some(frame_secs) = parse_number(line.value) else {
        return error(format!("the frame time {shown} is not a number"));
    };
    if !(limits::MIN_FRAME_SECS..=limits::MAX_FRAME_SECS).contains(&frame_secs) {
        return error(format!(
            "the frame time {shown} is not within {} to {} seconds",
            limits::MIN_FRAME_SECS,
            limits::MAX_FRAME_SECS
        ));
    }
    let fps = nominal_rate(frame_secs, decimal_places(line.value).unwrap_or(i32::MAX));
    Fps::new(fps).or_else(|bad| error(bad.to_string()))
}

/// The rate that a frame time means which was rounded to so many decimal places: 120 for
/// 0.0083333, 29.97 (30000/1001) for 0.033367, 30 for 0.033.
///
/// Exact rates matter because resampling by a whole ratio takes frames as they are. Among rates
/// that round to the same text a usual one is preferred; where none does, the reciprocal stands.
pub(super) fn nominal_rate(frame_secs: f64, decimal_places: i32) -> f64 {
    const USUAL: [f64; 17] = [
        30.0,
        60.0,
        120.0,
        24.0,
        25.0,
        50.0,
        100.0,
        48.0,
        90.0,
        72.0,
        240.0,
        200.0,
        15.0,
        12.0,
        30_000.0 / 1001.0,
        60_000.0 / 1001.0,
        24_000.0 / 1001.0,
    ];
    let exact = 1.0 / frame_secs;
    // Slightly more than half a unit of the last place: some programs cut off where they should
    // round, but nobody's last digit is wrong by more than one.
    // Short texts say little, but no rate is misread by more than a fiftieth.
    let rounding_secs = 1.01 * 10f64.powi(-decimal_places.clamp(0, 17));
    let slack_secs = rounding_secs.min(0.02 * frame_secs);
    let fits = |rate: f64| (1.0 / rate - frame_secs).abs() <= slack_secs;
    let nearest_usual = USUAL
        .into_iter()
        .filter(|&rate| fits(rate))
        .min_by(|a, b| (a - exact).abs().total_cmp(&(b - exact).abs()));
    match nearest_usual {
        Some(rate) => rate,
        None if fits(exact.round()) && exact >= 1.0 => exact.round(),
        None => exact,
    }
}

fn read_frame(
    line: Line<'_>,
    n_channels: usize,
    path: &Path,
    values: &mut Vec<f64>,
) -> Result<(), FileError> {
    let error = |what: String, what_to_do: &str| {
        Err(FileError::new(path, what, what_to_do).at_line(line.number))
    };
    if line.bytes.len() > limits::MAX_LINE_BYTES {
        let what = format!("the line is longer than {} bytes", limits::MAX_LINE_BYTES);
        return error(what, "check that it is the right file");
    }
    let mut n_read = 0;
    for word in line.words() {
        if n_read == n_channels {
            let n_words = line.words().count();
            return error(
                format!("the frame has {n_words} numbers instead of {n_channels}"),
                "export it again, or correct the CHANNELS",
            );
        }
        let Some(value) = parse_number(word) else {
            let comma = word.contains(&b',');
            return error(
                format!("{} is not a number", quoted(word)),
                if comma { "write decimals with a point" } else { "export it again" },
            );
        };
        if !within(value, limits::MAX_ABS_VALUE) {
            return error(
                format!("the value {} is not within ±{}", quoted(word), limits::MAX_ABS_VALUE),
                "export it again, the motion is damaged",
            );
        }
        values.push(value);
        n_read += 1;
    }
    if n_read < n_channels {
        return error(
            format!("the frame has {n_read} numbers instead of {n_channels}"),
            "export it again, or correct the CHANNELS",
        );
    }
    Ok(())
}

/// The file is too short for its frames: says at which line it stops being right, without
/// keeping what it reads.
fn too_few_frames(
    text: &mut Text<'_>,
    path: &Path,
    n_frames: usize,
    n_channels: usize,
    header_line: u32,
) -> FileError {
    let mut n_read = 0;
    let mut values = Vec::new();
    while let Some(line) = text.next_line() {
        if line.is_blank() {
            continue;
        }
        values.clear();
        if let Err(error) = read_frame(line, n_channels, path, &mut values) {
            return error;
        }
        n_read += 1;
    }
    ends_early(path, text.line(), n_read, n_frames, header_line)
}

fn ends_early(
    path: &Path,
    line: u32,
    n_read: usize,
    n_frames: usize,
    header_line: u32,
) -> FileError {
    FileError::new(
        path,
        format!(
            "the file ends after {n_read} of the {n_frames} frames that line {header_line} says"
        ),
        "export it again, it is cut off",
    )
    .at_line(line)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn rounded_frame_times_are_exact_rates() {
        for (text, fps) in [
            ("0.0083333", 120.0),
            ("0.008333", 120.0),
            ("8.33333e-3", 120.0),
            ("0.033333", 30.0),
            ("0.0333", 30.0),
            ("0.033", 30.0),
            ("0.03336667", 30_000.0 / 1001.0),
            ("0.041667", 24.0),
            ("0.04", 25.0),
            ("0.02", 50.0),
            ("0.016667", 60.0),
            ("0.01", 100.0),
            ("0.0066667", 150.0),
            ("0.0071428571", 140.0),
            ("1", 1.0),
            ("0.001", 1000.0),
        ] {
            let secs = parse_number(text.as_bytes()).unwrap();
            let places = decimal_places(text.as_bytes()).unwrap();
            assert_eq!(nominal_rate(secs, places), fps, "{text}");
        }
    }

    #[test]
    fn an_odd_rate_stays_what_it_is() {
        assert_eq!(nominal_rate(0.012_567_8, 7), 1.0 / 0.012_567_8);
    }
}
