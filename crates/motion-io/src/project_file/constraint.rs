//! Constraints of a character, from JSON.

use std::collections::HashSet;

use super::decode::{MAX_HEADING_DEG, MAX_WEIGHT};
use super::model::{
    Constraint, ConstraintKind, Length, LengthMode, LockedPiece, PathHeading, Tolerance,
};
use super::names::Ids;
use crate::diagnostic::{FileError, quoted};
use crate::json::{Node, Object};
use crate::limits::{MAX_ABS_PLACE_M, MAX_CONSTRAINTS, MAX_LIST, MAX_PROJECT_FRAMES};

/// The constraints of a character whose motion has `length`.
pub(super) fn decode_constraints(
    list: &Node<'_>,
    length: Option<&Length>,
) -> Result<Vec<Constraint>, FileError> {
    let exact_frames =
        length.filter(|length| length.mode == LengthMode::Exact).and_then(|length| length.frames);
    let mut ids = Ids::default();
    let mut body_frames = HashSet::new();
    let mut constraints = Vec::new();
    for node in list.array(MAX_CONSTRAINTS)? {
        let mut object = node.clone().object()?;
        let id = ids.read(&mut object)?;
        let kind = decode_kind(&mut object)?;
        if let ConstraintKind::Body { frame, .. } = kind
            && !body_frames.insert(frame)
        {
            return Err(node.error(
                format!("is a second body constraint at frame {frame}"),
                "keep one of them or move one to another frame",
            ));
        }
        if let Some(n_frames) = exact_frames.filter(|&n| kind.last_frame() >= n) {
            return Err(node.error(
                format!("speaks of frame {}, but the length is {n_frames}", kind.last_frame()),
                format!("use frames up to {}", n_frames - 1),
            ));
        }
        let weight = object.get("weight").map(|n| n.number_from_zero(MAX_WEIGHT)).transpose()?;
        let tolerance = object.get("tolerance").map(decode_tolerance).transpose()?;
        constraints.push(Constraint { id, kind, weight, tolerance, extra: object.rest() });
    }
    ids.complete(constraints.iter_mut().map(|c| (&mut c.id, c.kind.name())));
    Ok(constraints)
}

fn decode_kind(object: &mut Object<'_>) -> Result<ConstraintKind, FileError> {
    let kind = object.require("kind", "\"body\"")?;
    Ok(match kind.string()?.as_str() {
        "body" => ConstraintKind::Body {
            frame: frame(object, "frame")?,
            position_m: object.require("position", "[0, 0]")?.numbers(MAX_ABS_PLACE_M)?,
            heading_deg: heading(object)?,
            height_m: height(object)?,
        },
        "joint" => ConstraintKind::Joint {
            frame: frame(object, "frame")?,
            joint: object.require("joint", "\"Head\"")?.name()?,
            position_m: object.require("position", "[0, 1.7, 0]")?.numbers(MAX_ABS_PLACE_M)?,
            velocity_m_s: object
                .get("velocity")
                .map(|node| node.numbers(MAX_ABS_PLACE_M))
                .transpose()?,
        },
        "pose" => ConstraintKind::Pose {
            frame: frame(object, "frame")?,
            clip: object.require("clip", "\"16_15\"")?.name()?,
            clip_frame: frame(object, "clip_frame")?,
            position_m: object
                .get("position")
                .map(|node| node.numbers(MAX_ABS_PLACE_M))
                .transpose()?,
            heading_deg: heading(object)?,
            height_m: height(object)?,
        },
        "style" => {
            let (from, to) = span(object)?;
            ConstraintKind::Style { from, to, tag: object.require("tag", "\"run\"")?.name()? }
        }
        "path" => {
            let (from, to) = span(object)?;
            let points = object.require("points", "[[0, 0], [0, 3]]")?;
            let points_m = points
                .array(MAX_LIST)?
                .iter()
                .map(|node| node.numbers(MAX_ABS_PLACE_M))
                .collect::<Result<Vec<_>, _>>()?;
            if points_m.len() < 2 {
                return Err(points.error("has fewer than 2 points", "add points [x, z]"));
            }
            let heading = object.get("heading").map(decode_path_heading).transpose()?;
            ConstraintKind::Path { from, to, points_m, heading: heading.unwrap_or_default() }
        }
        "lock" => {
            let (from, to) = span(object)?;
            let pieces = object
                .require("pieces", "[{\"clip\": \"16_15\", \"from\": 0, \"to\": 60}]")?
                .array(MAX_LIST)?
                .into_iter()
                .map(decode_piece)
                .collect::<Result<_, _>>()?;
            ConstraintKind::Lock { from, to, pieces }
        }
        other => {
            return Err(kind.error(
                format!("is {}", quoted(other.as_bytes())),
                "write \"body\", \"joint\", \"pose\", \"style\", \"path\" or \"lock\"",
            ));
        }
    })
}

fn decode_path_heading(node: Node<'_>) -> Result<PathHeading, FileError> {
    let name = node.string()?;
    let known = PathHeading::ALL.into_iter().find(|(known, _)| *known == name);
    let unknown =
        || node.error(format!("is {}", quoted(name.as_bytes())), "write \"free\" or \"along\"");
    Ok(known.ok_or_else(unknown)?.1)
}

fn decode_piece(node: Node<'_>) -> Result<LockedPiece, FileError> {
    let mut object = node.object()?;
    let clip = object.require("clip", "\"16_15\"")?.name()?;
    let (from, to) = span(&mut object)?;
    Ok(LockedPiece { clip, from, to, extra: object.rest() })
}

fn decode_tolerance(node: Node<'_>) -> Result<Tolerance, FileError> {
    if node.value().is_number() {
        let position_m = Some(node.number_from_zero(MAX_WEIGHT)?);
        return Ok(Tolerance { position_m, ..Tolerance::default() });
    }
    let mut object = node.object()?;
    let mut number = |key| object.get(key).map(|n| n.number_from_zero(MAX_WEIGHT)).transpose();
    let (position_m, heading_deg, frames) =
        (number("position")?, number("heading")?, number("frames")?);
    Ok(Tolerance { position_m, heading_deg, frames, extra: object.rest() })
}

fn frame(object: &mut Object<'_>, key: &'static str) -> Result<u32, FileError> {
    object.require(key, "0")?.whole_number(MAX_PROJECT_FRAMES)
}

fn heading(object: &mut Object<'_>) -> Result<Option<f64>, FileError> {
    object.get("heading").map(|node| node.number(MAX_HEADING_DEG)).transpose()
}

fn height(object: &mut Object<'_>) -> Result<Option<f64>, FileError> {
    object.get("height").map(|node| node.number(MAX_ABS_PLACE_M)).transpose()
}

/// `from` and `to`, in order.
fn span(object: &mut Object<'_>) -> Result<(u32, u32), FileError> {
    let from = frame(object, "from")?;
    let to_node = object.require("to", "100")?;
    let to = to_node.whole_number(MAX_PROJECT_FRAMES)?;
    if to < from {
        return Err(to_node.error(
            format!("is {to}, before \"from\" at {from}"),
            "write the earlier frame first",
        ));
    }
    Ok((from, to))
}
