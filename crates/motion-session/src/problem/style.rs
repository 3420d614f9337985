//! Style constraints.

use std::collections::BTreeSet;

use motion_core::clip::Clip;
use motion_core::constraint::StyleConstraint;
use motion_core::ids::ClipId;
use motion_core::units::FrameIdx;
use motion_io::project_file::{Constraint, ConstraintKind};

use super::asking::Asking;

/// Tags that a remark names at most.
const MAX_NAMED: usize = 12;

/// The wish of a style constraint. A tag that no clip in use has is said, with those that there are.
pub(super) fn wish(constraint: &Constraint, asking: &mut Asking<'_>) -> Option<StyleConstraint> {
    let ConstraintKind::Style { from, to, tag } = &constraint.kind else { return None };
    let clips = asking.library.clips.clips().iter().enumerate();
    let in_use: Vec<&Clip> = clips
        .filter(|(nth, _)| asking.is_allowed(ClipId::from_idx(*nth)))
        .map(|(_, clip)| clip)
        .collect();
    if !in_use.iter().any(|clip| has_tag(clip, tag)) {
        let tags = tags_of(&in_use);
        let named = match tags.len() {
            0 => "they have no tags".to_owned(),
            1..=MAX_NAMED => format!("they have {}", tags.join(", ")),
            n => format!("they have {} and {} more", tags[..MAX_NAMED].join(", "), n - MAX_NAMED),
        };
        asking.remarks.push(format!(
            "style constraint {:?} asks for {tag:?}, which no clip in use has; {named}",
            constraint.id
        ));
    }
    let weight = constraint.weight.unwrap_or(1.0) as f32;
    Some(StyleConstraint { from: *from, to: *to, tag: tag.clone(), weight })
}

/// Whether any frame of a clip has a tag.
pub(crate) fn has_tag(clip: &Clip, tag: &str) -> bool {
    (0..clip.n_frames()).any(|frame| clip.has_tag_at(tag, FrameIdx::from_idx(frame)))
}

/// The tags of clips, each once.
fn tags_of(clips: &[&Clip]) -> Vec<String> {
    let tags: BTreeSet<String> =
        clips.iter().flat_map(|clip| &clip.tags).map(|tag| tag.to_lowercase()).collect();
    tags.into_iter().collect()
}
