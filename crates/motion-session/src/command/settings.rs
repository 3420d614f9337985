//! Commands about the project as a whole: obstacles, how to search, which takes are kept.

use std::sync::Arc;

use motion_io::limits::MAX_LIST;
use motion_io::project_file::{Palette, Project, Shape};

use super::{CommandError, check, obstacle_of};
use crate::document::{CharacterIdx, Document, ObstacleIdx, StoredTake, TakeId};

pub(super) fn head(document: &mut Document) -> &mut Project {
    Arc::make_mut(&mut document.head)
}

pub(super) fn add_obstacle(document: &mut Document, shape: Shape) -> Result<(), CommandError> {
    check::shape(&shape)?;
    check::room(document.obstacles.len(), MAX_LIST, "obstacles")?;
    Arc::make_mut(&mut document.obstacles).push(obstacle_of(shape));
    Ok(())
}

pub(super) fn change_obstacle(
    document: &mut Document,
    obstacle: ObstacleIdx,
    shape: Shape,
) -> Result<(), CommandError> {
    check::shape(&shape)?;
    let known = Arc::make_mut(&mut document.obstacles).get_mut(obstacle.0);
    known.ok_or(CommandError::NoObstacle)?.shape = shape;
    Ok(())
}

pub(super) fn remove_obstacle(
    document: &mut Document,
    obstacle: ObstacleIdx,
) -> Result<(), CommandError> {
    if obstacle.0 >= document.obstacles.len() {
        return Err(CommandError::NoObstacle);
    }
    Arc::make_mut(&mut document.obstacles).remove(obstacle.0);
    Ok(())
}

pub(super) fn set_term_weight(
    document: &mut Document,
    term: String,
    weight: Option<f64>,
) -> Result<(), CommandError> {
    check::weight(weight)?;
    check::name(&term, "a term of the score")?;
    let weights = &mut head(document).search.weights;
    let known = weights.iter().position(|(name, _)| *name == term);
    match (known, weight) {
        (Some(at), Some(weight)) => weights[at].1 = weight,
        (Some(at), None) => drop(weights.remove(at)),
        (None, Some(weight)) => weights.push((term, weight)),
        (None, None) => {}
    }
    Ok(())
}

pub(super) fn set_palette(
    document: &mut Document,
    palette: Option<Palette>,
) -> Result<(), CommandError> {
    if let Some(palette) = &palette {
        let lists = [&palette.include, &palette.exclude, &palette.tags];
        let most = lists.into_iter().map(Vec::len).max().unwrap_or_default();
        check::room(most, MAX_LIST, "patterns of a palette")?;
    }
    head(document).palette = palette;
    Ok(())
}

pub(super) fn set_seed(document: &mut Document, seed: u64) -> Result<(), CommandError> {
    head(document).search.seed = seed;
    Ok(())
}

pub(super) fn set_mirror(
    document: &mut Document,
    mirror: Option<bool>,
) -> Result<(), CommandError> {
    head(document).search.mirror = mirror;
    Ok(())
}

pub(super) fn set_bridges(
    document: &mut Document,
    bridges: Option<bool>,
) -> Result<(), CommandError> {
    head(document).search.bridges = bridges;
    Ok(())
}

pub(super) fn set_library(document: &mut Document, library: String) -> Result<(), CommandError> {
    check::name(&library, "a library")?;
    let head = head(document);
    if head.library != library {
        // They are of the other library.
        head.hashes = None;
    }
    head.library = library;
    Ok(())
}

pub(super) fn rename(document: &mut Document, name: String) -> Result<(), CommandError> {
    head(document).name = name;
    Ok(())
}

pub(super) fn pin(document: &mut Document, take: StoredTake) -> Result<(), CommandError> {
    keep(document, take, |take| {
        take.pinned = true;
        Ok(())
    })
}

pub(super) fn name_take(
    document: &mut Document,
    take: StoredTake,
    name: Option<String>,
) -> Result<(), CommandError> {
    // Nothing is kept of a take for having no name.
    let is_kept = document.takes.get(&take.character, take.id()).is_some();
    if name.is_none() && !is_kept {
        return check_take(document, &take);
    }
    keep(document, take, |take| {
        take.name = name;
        Ok(())
    })
}

pub(super) fn unpin(
    document: &mut Document,
    character: CharacterIdx,
    id: TakeId,
) -> Result<(), CommandError> {
    let name = &document.character(character).ok_or(CommandError::NoCharacter)?.name;
    let take = document.takes.get(name, id).ok_or(CommandError::NoTake)?.clone();
    keep(document, take, |take| {
        take.pinned = false;
        Ok(())
    })
}

/// Somebody's motion, of pieces that can be.
fn check_take(document: &Document, take: &StoredTake) -> Result<(), CommandError> {
    let owner = document.characters.iter().any(|c| c.name == take.character);
    if !owner {
        return Err(CommandError::NoCharacter);
    }
    if take.pieces.is_empty() || take.pieces.iter().any(|piece| piece.from > piece.to) {
        let (what, allowed) = ("a take", "made of pieces that end after they begin");
        return Err(CommandError::OutOfRange { what, allowed });
    }
    Ok(())
}

/// Changes what is kept of a take, which is `take` where nothing is kept yet. The layer that `take`
/// has from another take goes along, unless it has its own.
pub(super) fn keep(
    document: &mut Document,
    take: StoredTake,
    change: impl FnOnce(&mut StoredTake) -> Result<(), CommandError>,
) -> Result<(), CommandError> {
    check_take(document, &take)?;
    let id = take.id();
    let mut take = match document.takes.get(&take.character, id).cloned() {
        Some(kept) => StoredTake { by_hand: kept.by_hand.or(take.by_hand), ..kept },
        None => StoredTake { name: None, pinned: false, ..take },
    };
    change(&mut take)?;
    let is_worth_keeping =
        take.pinned || take.name.is_some() || take.by_hand.is_some() || !take.extra.is_empty();
    let takes = Arc::make_mut(&mut document.takes);
    if is_worth_keeping {
        takes.put(take);
    } else {
        takes.remove(&take.character, id);
    }
    Ok(())
}
