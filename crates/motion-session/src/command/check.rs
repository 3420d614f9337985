//! What numbers and names a project can hold: the limits of its file.

use motion_io::limits::{MAX_ABS_PLACE_M, MAX_PROJECT_FRAMES};
use motion_io::project_file::{Shape, Tolerance};

use super::CommandError;

/// As in the project file: headings may have many turns, but not so many that digits are lost.
const MAX_HEADING_DEG: f64 = 1e6;
/// As in the project file.
const MAX_WEIGHT: f64 = 1e9;

fn within(value: f64, limit: f64) -> bool {
    (-limit..=limit).contains(&value)
}

fn ensure(fine: bool, what: &'static str, allowed: &'static str) -> Result<(), CommandError> {
    if fine { Ok(()) } else { Err(CommandError::OutOfRange { what, allowed }) }
}

pub(super) fn place(metres: &[f64]) -> Result<(), CommandError> {
    let fine = metres.iter().all(|&value| within(value, MAX_ABS_PLACE_M));
    ensure(fine, "a place", "within 10 km of the origin")
}

pub(super) fn heading(degrees: Option<f64>) -> Result<(), CommandError> {
    let fine = degrees.is_none_or(|value| within(value, MAX_HEADING_DEG));
    ensure(fine, "a heading", "within a million degrees")
}

pub(super) fn weight(weight: Option<f64>) -> Result<(), CommandError> {
    let fine = weight.is_none_or(|value| (0.0..=MAX_WEIGHT).contains(&value));
    ensure(fine, "a weight", "a number from 0 to a thousand million")
}

pub(super) fn tolerance(tolerance: Option<&Tolerance>) -> Result<(), CommandError> {
    let Some(tolerance) = tolerance else { return Ok(()) };
    let parts = [tolerance.position_m, tolerance.heading_deg, tolerance.frames];
    let fine = parts.into_iter().flatten().all(|value| (0.0..=MAX_WEIGHT).contains(&value));
    ensure(fine, "a tolerance", "a number from 0 to a thousand million")
}

pub(super) fn frame(frame: u32) -> Result<(), CommandError> {
    ensure(frame < MAX_PROJECT_FRAMES, "a frame", "below a million")
}

pub(super) fn length(frames: u32) -> Result<(), CommandError> {
    let fine = (1..=MAX_PROJECT_FRAMES).contains(&frames);
    ensure(fine, "a length", "from 1 to a million frames")
}

pub(super) fn name(name: &str, of: &'static str) -> Result<(), CommandError> {
    if name.trim().is_empty() { Err(CommandError::NoName(of)) } else { Ok(()) }
}

pub(super) fn shape(shape: &Shape) -> Result<(), CommandError> {
    let size = |lengths: &[f64]| {
        let fine = lengths.iter().all(|value| (0.0..=MAX_ABS_PLACE_M).contains(value));
        ensure(fine, "an edge", "from 0 to 10 km")
    };
    match shape {
        Shape::Box { center_m, size_m, heading_deg }
        | Shape::Ceiling { center_m, size_m, heading_deg } => {
            place(center_m)?;
            size(size_m)?;
            heading(Some(*heading_deg))
        }
        Shape::Cylinder { center_m, radius_m, height_m } => {
            place(center_m)?;
            size(&[*radius_m, *height_m])
        }
    }
}

/// There is room for one more.
pub(super) fn room(n: usize, max: usize, what: &'static str) -> Result<(), CommandError> {
    if n < max { Ok(()) } else { Err(CommandError::TooMany { what, max }) }
}
