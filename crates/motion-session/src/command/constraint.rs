//! Commands about what a motion must meet.

use std::sync::Arc;

use motion_io::limits::{MAX_CONSTRAINTS, MAX_LIST};
use motion_io::project_file::{
    Character, Constraint, ConstraintKind, Extra, LengthMode, PathHeading, Tolerance,
};

use super::{CommandError, check};
use crate::document::{CharacterIdx, ConstraintRef, Document};

/// The character, to be changed.
pub(super) fn character_mut(
    document: &mut Document,
    character: CharacterIdx,
) -> Result<&mut Character, CommandError> {
    if character.0 >= document.characters.len() {
        return Err(CommandError::NoCharacter);
    }
    Ok(Arc::make_mut(&mut Arc::make_mut(&mut document.characters)[character.0]))
}

/// Changes what a constraint says; the whole is checked afterwards.
fn change(
    document: &mut Document,
    at: &ConstraintRef,
    change: impl FnOnce(&mut Constraint) -> Result<(), CommandError>,
) -> Result<(), CommandError> {
    let no_constraint = || CommandError::NoConstraint(at.id.clone());
    // Before it is copied to be changed, so that a refusal costs nothing.
    let before = document.constraint(at).ok_or_else(no_constraint)?.kind.clone();
    let character = character_mut(document, at.character)?;
    let nth = character.constraints.iter().position(|c| c.id == at.id).ok_or_else(no_constraint)?;
    change(&mut character.constraints[nth])?;
    check_kind(character, nth, Some(&before))
}

pub(super) fn add(
    document: &mut Document,
    character: CharacterIdx,
    kind: ConstraintKind,
) -> Result<(), CommandError> {
    let id = document.next_id(character, kind.name());
    let extra = Extra::new();
    push(document, character, Constraint { id, kind, weight: None, tolerance: None, extra })
}

pub(super) fn duplicate(
    document: &mut Document,
    at: &ConstraintRef,
    frame: u32,
) -> Result<(), CommandError> {
    let source = document.constraint(at).ok_or(CommandError::NoConstraint(at.id.clone()))?;
    let mut copy = source.clone();
    copy.id = document.next_id(at.character, copy.kind.name());
    shift_to(&mut copy.kind, frame)?;
    push(document, at.character, copy)
}

fn push(
    document: &mut Document,
    character: CharacterIdx,
    constraint: Constraint,
) -> Result<(), CommandError> {
    let character = character_mut(document, character)?;
    check::room(character.constraints.len(), MAX_CONSTRAINTS, "constraints of a character")?;
    character.constraints.push(constraint);
    check_kind(character, character.constraints.len() - 1, None)
}

pub(super) fn remove(document: &mut Document, at: &ConstraintRef) -> Result<(), CommandError> {
    let gone = document.constraint(at).ok_or(CommandError::NoConstraint(at.id.clone()))?;
    let gone_frame = body_frame(&gone.kind);
    let character = character_mut(document, at.character)?;
    if let Some(frame) = gone_frame {
        let frames = || character.constraints.iter().filter_map(|c| body_frame(&c.kind));
        if frames().count() <= 2 {
            return Err(CommandError::LastTwoCheckpoints);
        }
        if frames().min() == Some(frame) {
            return Err(CommandError::StartStays);
        }
    }
    character.constraints.retain(|c| c.id != at.id);
    Ok(())
}

pub(super) fn move_to(
    document: &mut Document,
    at: &ConstraintRef,
    to_m: [f64; 2],
) -> Result<(), CommandError> {
    change(document, at, |constraint| match &mut constraint.kind {
        ConstraintKind::Body { position_m, .. } => {
            *position_m = to_m;
            Ok(())
        }
        ConstraintKind::Pose { position_m, .. } => {
            *position_m = Some(to_m);
            Ok(())
        }
        other => Err(lacks(other, "place on the floor")),
    })
}

pub(super) fn set_place(
    document: &mut Document,
    at: &ConstraintRef,
    to_m: Option<[f64; 2]>,
) -> Result<(), CommandError> {
    change(document, at, |constraint| match &mut constraint.kind {
        ConstraintKind::Pose { position_m, .. } => {
            *position_m = to_m;
            Ok(())
        }
        other => Err(lacks(other, "place that may be any")),
    })
}

pub(super) fn turn(
    document: &mut Document,
    at: &ConstraintRef,
    to_deg: Option<f64>,
) -> Result<(), CommandError> {
    change(document, at, |constraint| match &mut constraint.kind {
        ConstraintKind::Body { heading_deg, .. } | ConstraintKind::Pose { heading_deg, .. } => {
            *heading_deg = to_deg;
            Ok(())
        }
        other => Err(lacks(other, "heading")),
    })
}

pub(super) fn raise(
    document: &mut Document,
    at: &ConstraintRef,
    to_m: Option<f64>,
) -> Result<(), CommandError> {
    change(document, at, |constraint| match &mut constraint.kind {
        ConstraintKind::Body { height_m, .. } | ConstraintKind::Pose { height_m, .. } => {
            *height_m = to_m;
            Ok(())
        }
        other => Err(lacks(other, "height of its ground")),
    })
}

pub(super) fn move_joint(
    document: &mut Document,
    at: &ConstraintRef,
    to_m: [f64; 3],
) -> Result<(), CommandError> {
    change(document, at, |constraint| match &mut constraint.kind {
        ConstraintKind::Joint { position_m, .. } => {
            *position_m = to_m;
            Ok(())
        }
        other => Err(lacks(other, "joint")),
    })
}

pub(super) fn set_joint(
    document: &mut Document,
    at: &ConstraintRef,
    new: String,
) -> Result<(), CommandError> {
    change(document, at, |constraint| match &mut constraint.kind {
        ConstraintKind::Joint { joint, .. } => {
            *joint = new;
            Ok(())
        }
        other => Err(lacks(other, "joint")),
    })
}

pub(super) fn set_pose_source(
    document: &mut Document,
    at: &ConstraintRef,
    new: String,
    new_frame: u32,
) -> Result<(), CommandError> {
    change(document, at, |constraint| match &mut constraint.kind {
        ConstraintKind::Pose { clip, clip_frame, .. } => {
            (*clip, *clip_frame) = (new, new_frame);
            Ok(())
        }
        other => Err(lacks(other, "pose of a clip")),
    })
}

pub(super) fn set_velocity(
    document: &mut Document,
    at: &ConstraintRef,
    to_m_s: Option<[f64; 3]>,
) -> Result<(), CommandError> {
    change(document, at, |constraint| match &mut constraint.kind {
        ConstraintKind::Joint { velocity_m_s, .. } => {
            *velocity_m_s = to_m_s;
            Ok(())
        }
        other => Err(lacks(other, "velocity")),
    })
}

pub(super) fn set_tag(
    document: &mut Document,
    at: &ConstraintRef,
    new: String,
) -> Result<(), CommandError> {
    change(document, at, |constraint| match &mut constraint.kind {
        ConstraintKind::Style { tag, .. } => {
            *tag = new;
            Ok(())
        }
        other => Err(lacks(other, "tag")),
    })
}

pub(super) fn reshape(
    document: &mut Document,
    at: &ConstraintRef,
    new_m: Vec<[f64; 2]>,
) -> Result<(), CommandError> {
    change(document, at, |constraint| match &mut constraint.kind {
        ConstraintKind::Path { points_m, .. } => {
            *points_m = new_m;
            Ok(())
        }
        other => Err(lacks(other, "points")),
    })
}

pub(super) fn set_path_heading(
    document: &mut Document,
    at: &ConstraintRef,
    new: PathHeading,
) -> Result<(), CommandError> {
    change(document, at, |constraint| match &mut constraint.kind {
        ConstraintKind::Path { heading, .. } => {
            *heading = new;
            Ok(())
        }
        other => Err(lacks(other, "way to look along")),
    })
}

pub(super) fn retime(
    document: &mut Document,
    at: &ConstraintRef,
    frame: u32,
) -> Result<(), CommandError> {
    change(document, at, |constraint| shift_to(&mut constraint.kind, frame))
}

pub(super) fn retime_span(
    document: &mut Document,
    at: &ConstraintRef,
    new_from: u32,
    new_to: u32,
) -> Result<(), CommandError> {
    change(document, at, |constraint| match &mut constraint.kind {
        ConstraintKind::Style { from, to, .. }
        | ConstraintKind::Path { from, to, .. }
        | ConstraintKind::Lock { from, to, .. } => {
            (*from, *to) = (new_from, new_to);
            Ok(())
        }
        other => Err(lacks(other, "stretch of time")),
    })
}

pub(super) fn set_weight(
    document: &mut Document,
    at: &ConstraintRef,
    weight: Option<f64>,
) -> Result<(), CommandError> {
    check::weight(weight)?;
    change(document, at, |constraint| {
        constraint.weight = weight;
        Ok(())
    })
}

pub(super) fn set_tolerance(
    document: &mut Document,
    at: &ConstraintRef,
    tolerance: Option<Tolerance>,
) -> Result<(), CommandError> {
    check::tolerance(tolerance.as_ref())?;
    change(document, at, |constraint| {
        constraint.tolerance = tolerance;
        Ok(())
    })
}

fn lacks(kind: &ConstraintKind, what: &'static str) -> CommandError {
    CommandError::NotOfThisKind { kind: kind.name(), what }
}

fn body_frame(kind: &ConstraintKind) -> Option<u32> {
    match kind {
        ConstraintKind::Body { frame, .. } => Some(*frame),
        _ => None,
    }
}

/// Moves a constraint in time so that it begins at `frame`.
fn shift_to(kind: &mut ConstraintKind, new: u32) -> Result<(), CommandError> {
    check::frame(new)?;
    match kind {
        ConstraintKind::Body { frame, .. }
        | ConstraintKind::Joint { frame, .. }
        | ConstraintKind::Pose { frame, .. } => *frame = new,
        ConstraintKind::Style { from, to, .. }
        | ConstraintKind::Path { from, to, .. }
        | ConstraintKind::Lock { from, to, .. } => {
            *to = to.saturating_sub(*from).saturating_add(new);
            *from = new;
        }
    }
    Ok(())
}

/// Checks the constraint `nth` of a character, which was `before` if it was there.
fn check_kind(
    character: &Character,
    nth: usize,
    before: Option<&ConstraintKind>,
) -> Result<(), CommandError> {
    let kind = &character.constraints[nth].kind;
    match kind {
        ConstraintKind::Body { frame, position_m, heading_deg, height_m } => {
            check::place(position_m)?;
            check::place(height_m.as_slice())?;
            check::heading(*heading_deg)?;
            let was = before.and_then(body_frame);
            if was == Some(0) && *frame != 0 {
                return Err(CommandError::StartIsAtZero);
            }
            let others = character.constraints.iter().enumerate().filter(|(i, _)| *i != nth);
            if others.filter_map(|(_, c)| body_frame(&c.kind)).any(|taken| taken == *frame) {
                return Err(CommandError::FrameTaken(*frame));
            }
        }
        ConstraintKind::Joint { joint, position_m, velocity_m_s, .. } => {
            check::name(joint, "a joint target's joint")?;
            check::place(position_m)?;
            check::place(velocity_m_s.as_ref().map_or(&[][..], |v| v))?;
        }
        ConstraintKind::Pose { clip, clip_frame, position_m, heading_deg, height_m, .. } => {
            check::name(clip, "a pose's clip")?;
            check::frame(*clip_frame)?;
            check::place(position_m.as_ref().map_or(&[][..], |p| p))?;
            check::place(height_m.as_slice())?;
            check::heading(*heading_deg)?;
        }
        ConstraintKind::Style { from, to, tag } => {
            check::name(tag, "a style")?;
            check_span(*from, *to)?;
        }
        ConstraintKind::Path { from, to, points_m, heading: _ } => {
            check_span(*from, *to)?;
            points_m.iter().try_for_each(|point| check::place(point))?;
            let fine = (2..=MAX_LIST).contains(&points_m.len());
            if !fine {
                let (what, allowed) = ("a path", "at least two points long");
                return Err(CommandError::OutOfRange { what, allowed });
            }
        }
        ConstraintKind::Lock { from, to, pieces } => {
            check_span(*from, *to)?;
            check::room(pieces.len(), MAX_LIST, "pieces of a lock")?;
            for piece in pieces {
                check::name(&piece.clip, "a locked clip")?;
                check_span(piece.from, piece.to)?;
            }
        }
    }
    check::frame(kind.last_frame())?;
    let exact = character.length.as_ref().filter(|length| length.mode == LengthMode::Exact);
    match exact.and_then(|length| length.frames) {
        Some(length) if kind.last_frame() >= length => {
            Err(CommandError::BeyondLength { frame: kind.last_frame(), length })
        }
        _ => Ok(()),
    }
}

fn check_span(from: u32, to: u32) -> Result<(), CommandError> {
    check::frame(from)?;
    check::frame(to)?;
    if to < from { Err(CommandError::EndsBeforeItBegins { from, to }) } else { Ok(()) }
}
