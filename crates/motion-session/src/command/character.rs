//! Commands about characters and the lengths of their motions.

use std::sync::Arc;

use motion_io::limits::MAX_CHARACTERS;
use motion_io::project_file::{
    Character, Constraint, ConstraintKind, Extra, Length, LengthMode, fault_as_file_name,
};

use super::constraint::character_mut;
use super::{CommandError, check};
use crate::document::{CharacterIdx, Document};

/// How long a new character's motion is at first, frames.
const NEW_FRAMES: u32 = 120;
/// How far a new character goes, metres: an easy walk.
const NEW_WAY_M: f64 = 4.0;

pub(super) fn add(document: &mut Document, name: String) -> Result<(), CommandError> {
    check_name(document, &name, None)?;
    check::room(document.characters.len(), MAX_CHARACTERS, "characters")?;
    // Beside the others, so that nobody stands in anybody.
    let x_m = document.characters.len() as f64;
    let checkpoint = |id: &str, frame, z_m| Constraint {
        id: id.to_owned(),
        kind: ConstraintKind::Body {
            frame,
            position_m: [x_m, z_m],
            heading_deg: Some(0.0),
            height_m: None,
        },
        weight: None,
        tolerance: None,
        extra: Extra::new(),
    };
    let constraints =
        vec![checkpoint("start", 0, 0.0), checkpoint("end", NEW_FRAMES - 1, NEW_WAY_M)];
    let length = Length {
        frames: Some(NEW_FRAMES),
        mode: LengthMode::Preferred,
        weight: None,
        extra: Extra::new(),
    };
    Arc::make_mut(&mut document.characters).push(Arc::new(Character {
        name,
        length: Some(length),
        body: None,
        library: None,
        constraints,
        extra: Extra::new(),
    }));
    Ok(())
}

pub(super) fn rename(
    document: &mut Document,
    character: CharacterIdx,
    name: String,
) -> Result<(), CommandError> {
    check_name(document, &name, Some(character))?;
    let old = std::mem::replace(&mut character_mut(document, character)?.name, name.clone());
    if old == name {
        return Ok(());
    }
    if document.interactions().iter().flat_map(|i| &i.members).any(|m| m.character == old) {
        for interaction in &mut Arc::make_mut(&mut document.head).interactions {
            for member in interaction.members.iter_mut().filter(|m| m.character == old) {
                member.character.clone_from(&name);
            }
        }
    }
    if document.takes.iter().any(|take| take.character == old) {
        for take in Arc::make_mut(&mut document.takes).takes_mut() {
            if take.character == old {
                take.character.clone_from(&name);
            }
        }
    }
    Ok(())
}

pub(super) fn remove(document: &mut Document, character: CharacterIdx) -> Result<(), CommandError> {
    let name = document.character(character).ok_or(CommandError::NoCharacter)?.name.clone();
    if document.characters.len() == 1 {
        return Err(CommandError::LastCharacter);
    }
    if document.interactions().iter().flat_map(|i| &i.members).any(|m| m.character == name) {
        return Err(CommandError::InInteraction(name));
    }
    Arc::make_mut(&mut document.characters).remove(character.0);
    if document.takes.iter().any(|take| take.character == name) {
        Arc::make_mut(&mut document.takes).retain(|take| take.character != name);
    }
    Ok(())
}

pub(super) fn set_body(
    document: &mut Document,
    character: CharacterIdx,
    body: Option<String>,
) -> Result<(), CommandError> {
    body.as_deref().map_or(Ok(()), |body| check::name(body, "a body's file"))?;
    character_mut(document, character)?.body = body;
    Ok(())
}

pub(super) fn set_length(
    document: &mut Document,
    character: CharacterIdx,
    frames: Option<u32>,
    mode: LengthMode,
) -> Result<(), CommandError> {
    match frames {
        Some(frames) => check::length(frames)?,
        None if mode == LengthMode::Free => {}
        None => {
            let (what, allowed) = ("a length", "from 1 to a million frames");
            return Err(CommandError::OutOfRange { what, allowed });
        }
    }
    let character = character_mut(document, character)?;
    if let (LengthMode::Exact, Some(length)) = (mode, frames)
        && let Some(last) = character.constraints.iter().map(|c| c.kind.last_frame()).max()
        && last >= length
    {
        return Err(CommandError::BeyondLength { frame: last, length });
    }
    let length = character.length.get_or_insert_with(|| Length {
        frames: None,
        mode,
        weight: None,
        extra: Extra::new(),
    });
    (length.frames, length.mode) = (frames, mode);
    Ok(())
}

pub(super) fn set_length_weight(
    document: &mut Document,
    character: CharacterIdx,
    weight: Option<f64>,
) -> Result<(), CommandError> {
    check::weight(weight)?;
    let length = &mut character_mut(document, character)?.length;
    match length {
        Some(length) => length.weight = weight,
        None => {
            let (frames, mode, extra) = (None, LengthMode::Free, Extra::new());
            *length = Some(Length { frames, mode, weight, extra });
        }
    }
    Ok(())
}

fn check_name(
    document: &Document,
    name: &str,
    own: Option<CharacterIdx>,
) -> Result<(), CommandError> {
    check::name(name, "a character")?;
    if let Some(fault) = fault_as_file_name(name) {
        return Err(CommandError::BadCharacterName(fault));
    }
    // Not every file system tells A from a.
    let same = |other: &str| other.to_lowercase() == name.to_lowercase();
    let mut others =
        document.characters.iter().enumerate().filter(|(nth, _)| own.is_none_or(|o| o.0 != *nth));
    match others.find(|(_, other)| same(&other.name)) {
        Some((_, other)) => Err(CommandError::NameTaken(other.name.clone())),
        None => Ok(()),
    }
}
