//! Commands about characters who meet.

use std::collections::BTreeSet;
use std::sync::Arc;

use motion_io::limits::MAX_LIST;
use motion_io::project_file::{Extra, Interaction, LengthMode, Member, Placement};

use super::{CommandError, check};
use crate::document::Document;

pub(super) fn add(
    document: &mut Document,
    frame: u32,
    members: Vec<Member>,
    relative: Vec<Placement>,
) -> Result<(), CommandError> {
    let id = document.next_interaction_id();
    let interaction =
        Interaction { id, frame, weight: None, members, relative, extra: Extra::new() };
    check_interaction(document, &interaction)?;
    check::room(document.interactions().len(), MAX_LIST, "meetings")?;
    Arc::make_mut(&mut document.head).interactions.push(interaction);
    Ok(())
}

pub(super) fn change(
    document: &mut Document,
    id: &str,
    frame: u32,
    members: Vec<Member>,
    relative: Vec<Placement>,
) -> Result<(), CommandError> {
    let known = interaction(document, id)?.clone();
    let new = Interaction { frame, members, relative, ..known };
    check_interaction(document, &new)?;
    *interaction_mut(document, id)? = new;
    Ok(())
}

pub(super) fn set_weight(
    document: &mut Document,
    id: &str,
    weight: Option<f64>,
) -> Result<(), CommandError> {
    check::weight(weight)?;
    interaction_mut(document, id)?.weight = weight;
    Ok(())
}

pub(super) fn remove(document: &mut Document, id: &str) -> Result<(), CommandError> {
    interaction(document, id)?;
    Arc::make_mut(&mut document.head).interactions.retain(|known| known.id != id);
    Ok(())
}

fn interaction<'a>(document: &'a Document, id: &str) -> Result<&'a Interaction, CommandError> {
    document.interaction(id).ok_or_else(|| CommandError::NoInteraction(id.to_owned()))
}

fn interaction_mut<'a>(
    document: &'a mut Document,
    id: &str,
) -> Result<&'a mut Interaction, CommandError> {
    interaction(document, id)?;
    let all = &mut Arc::make_mut(&mut document.head).interactions;
    let known = all.iter_mut().find(|known| known.id == id);
    known.ok_or_else(|| CommandError::NoInteraction(id.to_owned()))
}

/// Checks an interaction against the characters and what a file can hold.
fn check_interaction(document: &Document, interaction: &Interaction) -> Result<(), CommandError> {
    let Interaction { frame, members, relative, .. } = interaction;
    check::frame(*frame)?;
    let names: BTreeSet<&str> = members.iter().map(|m| m.character.as_str()).collect();
    if names.len() < 2 || names.len() < members.len() || members.len() != relative.len() {
        return Err(CommandError::MeetsNobody);
    }
    for member in members {
        let character = document.characters().iter().find(|c| c.name == member.character);
        let character = character.ok_or(CommandError::NoCharacter)?;
        check::name(&member.clip, "a pose's clip")?;
        check::frame(member.clip_frame)?;
        let exact = character.length.as_ref().filter(|length| length.mode == LengthMode::Exact);
        if let Some(length) = exact.and_then(|length| length.frames).filter(|&n| *frame >= n) {
            return Err(CommandError::BeyondLength { frame: *frame, length });
        }
    }
    for placement in relative {
        check::place(&placement.position_m)?;
        check::heading(Some(placement.heading_deg))?;
    }
    Ok(())
}
