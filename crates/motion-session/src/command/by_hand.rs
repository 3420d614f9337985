//! Commands about what is changed by hand on a take.

use motion_core::by_hand::Knot;

use super::CommandError;
use super::settings::keep;
use crate::document::{ByHand, Document, HandEdit, HandFault, StoredTake};

impl From<HandFault> for CommandError {
    fn from(HandFault { what, allowed }: HandFault) -> Self {
        Self::OutOfRange { what, allowed }
    }
}

pub(super) fn add(
    document: &mut Document,
    take: StoredTake,
    edit: HandEdit,
) -> Result<(), CommandError> {
    change_layer(document, take, |layer| Ok(layer.add(edit)?))
}

pub(super) fn change(
    document: &mut Document,
    take: StoredTake,
    id: &str,
    edit: HandEdit,
) -> Result<(), CommandError> {
    change_layer(document, take, |layer| match layer.change(id, edit)? {
        true => Ok(()),
        false => Err(CommandError::NoHandEdit(id.to_owned())),
    })
}

pub(super) fn remove(
    document: &mut Document,
    take: StoredTake,
    id: &str,
) -> Result<(), CommandError> {
    change_layer(document, take, |layer| match layer.remove(id) {
        true => Ok(()),
        false => Err(CommandError::NoHandEdit(id.to_owned())),
    })
}

pub(super) fn set_retime(
    document: &mut Document,
    take: StoredTake,
    knots: Option<Vec<Knot>>,
) -> Result<(), CommandError> {
    change_layer(document, take, |layer| Ok(layer.set_retime(&knots.unwrap_or_default())?))
}

pub(super) fn clear(document: &mut Document, take: StoredTake) -> Result<(), CommandError> {
    change_layer(document, take, |layer| {
        *layer = ByHand::default();
        Ok(())
    })
}

/// Changes the layer of a take, which is kept with the project from now on.
///
/// A layer that has become empty is kept only where the take might have another one's otherwise.
fn change_layer(
    document: &mut Document,
    take: StoredTake,
    change: impl FnOnce(&mut ByHand) -> Result<(), CommandError>,
) -> Result<(), CommandError> {
    let (character, id) = (take.character.clone(), take.id());
    let others = document.takes().iter().any(|other| {
        let has_layer = other.by_hand.as_ref().is_some_and(|layer| !layer.is_empty());
        has_layer && other.character == character && other.id() != id
    });
    keep(document, take, |take| {
        let mut layer = take.by_hand.take().unwrap_or_default();
        change(&mut layer)?;
        take.by_hand = (others || !layer.is_empty()).then_some(layer);
        Ok(())
    })
}
