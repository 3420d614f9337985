//! What was typed after `gaitway render`.

use std::ops::RangeInclusive;
use std::path::PathBuf;
use std::str::FromStr;

use motion_core::units::Fps;

use super::{Reading, fps, positive};

/// `gaitway render`.
#[derive(Debug, clap::Args)]
pub(crate) struct Render {
    /// A project (its best motion is shown), or a motion: .gaitway, .bvh, .glb, .gltf
    pub(crate) input: PathBuf,
    /// The picture or film to write: .png, .gif, .mp4 or .webm (the last two need ffmpeg)
    #[arg(short, long, value_name = "FILE")]
    pub(crate) output: PathBuf,
    /// Columns and rows, 16 to 8192 each [default: 1600x1000 a sheet, 640x360 a GIF, else 1280x720]
    #[arg(long, value_name = "WxH")]
    pub(crate) size: Option<Size>,
    /// From where it is looked at
    #[arg(long, value_name = "CAMERA", value_enum, default_value = "three-quarter")]
    pub(crate) camera: Camera,
    /// One picture of this frame, in place of a contact sheet
    #[arg(long, value_name = "N", conflicts_with_all = ["frames", "fps"])]
    pub(crate) frame: Option<u32>,
    /// These frames only, both ends shown
    #[arg(long, value_name = "A-B")]
    pub(crate) frames: Option<FrameRange>,
    /// Pictures per second of a film [default: as the motion has]
    #[arg(long, value_name = "RATE", value_parser = fps, allow_negative_numbers = true)]
    pub(crate) fps: Option<Fps>,
    /// A glTF file whose body is to be seen
    #[arg(long, value_name = "FILE")]
    pub(crate) character: Option<PathBuf>,
    /// Show so many poses of the whole motion at once (in a contact sheet: at most so many)
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u8).range(0..=64))]
    pub(crate) ghosts: Option<u8>,
    /// Draw the way over the floor, dot by dot
    #[arg(long)]
    pub(crate) trail: bool,
    /// Leave out what the project asks for
    #[arg(long)]
    pub(crate) no_marks: bool,
    /// Light or dark surroundings
    #[arg(long, value_name = "THEME", value_enum, default_value = "dark")]
    pub(crate) theme: Theme,
    /// Which of a project's motions, from 1, the best
    #[arg(long, value_name = "N", default_value = "1", value_parser = clap::value_parser!(u16).range(1..=1000))]
    pub(crate) take: u16,
    /// A .gwlib file, a folder of clips or `builtin`, instead of the project's choice
    #[arg(long, value_name = "LIBRARY")]
    pub(crate) library: Option<PathBuf>,
    /// Search for so many rounds [default: 60]
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u64).range(1..), conflicts_with = "time")]
    pub(crate) iterations: Option<u64>,
    /// Search for so many seconds; the picture then depends on the machine
    #[arg(long, value_name = "SECONDS", value_parser = positive, allow_negative_numbers = true)]
    pub(crate) time: Option<f64>,
    /// Draw without a graphics card
    #[arg(long)]
    pub(crate) software: bool,
    #[command(flatten)]
    pub(crate) reading: Reading,
}

/// From where a motion is looked at.
#[derive(Clone, Copy, Debug, PartialEq, Eq, clap::ValueEnum)]
pub(crate) enum Camera {
    /// From beside and a little above; all of the motion is in the picture
    ThreeQuarter,
    /// Going with the body
    Follow,
    /// Going with the body and round it once
    Turntable,
    /// From +Z, which a body at rest faces
    Front,
    /// From −X: ahead is to the right
    Side,
    /// From above
    Top,
}

/// Surroundings.
#[derive(Clone, Copy, Debug, PartialEq, Eq, clap::ValueEnum)]
pub(crate) enum Theme {
    /// Light things on dark ground
    Dark,
    /// Dark things on light ground
    Light,
}

/// Columns and rows of a picture.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Size {
    pub(crate) width: u32,
    pub(crate) height: u32,
}

impl Size {
    const SIDES: RangeInclusive<u32> = 16..=8192;
    /// What a picture and its way to the file take in memory stays below a gigabyte.
    const MOST_PIXELS: u32 = 8192 * 4096;
}

impl FromStr for Size {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        let sides = text.split_once(['x', 'X', '×']);
        let number = |side: &str| side.trim().parse::<u32>().ok();
        let Some((Some(width), Some(height))) = sides.map(|(w, h)| (number(w), number(h))) else {
            return Err("use WIDTHxHEIGHT, such as 640x360".to_owned());
        };
        if !Self::SIDES.contains(&width) || !Self::SIDES.contains(&height) {
            return Err("each side has 16 to 8192 pixels".to_owned());
        }
        if width * height > Self::MOST_PIXELS {
            return Err("a picture has at most 8192x4096 pixels".to_owned());
        }
        Ok(Self { width, height })
    }
}

/// The first and the last frame of a part of a motion.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct FrameRange {
    pub(crate) first: u32,
    pub(crate) last: u32,
}

impl FromStr for FrameRange {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        let ends = text.split_once('-');
        let number = |end: &str| end.trim().parse::<u32>().ok();
        match ends.map(|(first, last)| (number(first), number(last))) {
            Some((Some(first), Some(last))) if first <= last => Ok(Self { first, last }),
            _ => Err("use FIRST-LAST, such as 30-90".to_owned()),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn sizes_have_two_sides_within_limits() {
        let size = |text: &str| text.parse::<Size>().map(|size| (size.width, size.height));
        assert_eq!(size("640x360"), Ok((640, 360)));
        assert_eq!(size("16X8192"), Ok((16, 8192)));
        for bad in ["", "640", "0x0", "x", "640x", "-1x20", "15x100", "8193x100", "1e3x20"] {
            assert!(size(bad).is_err(), "{bad}");
        }
        assert_eq!(size("8192x8192"), Err("a picture has at most 8192x4096 pixels".to_owned()));
    }

    #[test]
    fn ranges_have_two_ends_in_order() {
        let range = |text: &str| text.parse::<FrameRange>().map(|range| (range.first, range.last));
        assert_eq!(range("30-90"), Ok((30, 90)));
        assert_eq!(range("7-7"), Ok((7, 7)));
        for bad in ["", "5", "9-3", "-3", "a-b", "1-", "1-99999999999"] {
            assert!(range(bad).is_err(), "{bad}");
        }
    }
}
