//! Style constraints.

use std::collections::BTreeSet;

use motion_core::clip::Clip;
use motion_core::constraint::StyleConstraint;
use motion_core::ids::ClipId;
use motion_core::tags::{HandTags, whole_tags};
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
    let weight = constraint.weight.unwrap_or(1.0) as f32;
    let (tag, by_hand) = (tag.clone(), asking.by_hand.clone());
    let wish = StyleConstraint { from: *from, to: *to, tag, weight, by_hand };
    if !in_use.iter().any(|clip| has_tag(clip, &wish)) {
        let tags = tags_of(&in_use, &wish.by_hand);
        let named = match tags.len() {
            0 => "they have no tags".to_owned(),
            1..=MAX_NAMED => format!("they have {}", tags.join(", ")),
            n => format!("they have {} and {} more", tags[..MAX_NAMED].join(", "), n - MAX_NAMED),
        };
        asking.remarks.push(format!(
            "style constraint {:?} asks for {:?}, which no clip in use has; {named}",
            constraint.id, wish.tag
        ));
    }
    Some(wish)
}

/// Whether any frame of a clip has the tag that is wished.
pub(crate) fn has_tag(clip: &Clip, wish: &StyleConstraint) -> bool {
    wish.frames_with_tag(clip).contains(&true)
}

/// The tags of clips, each once.
fn tags_of(clips: &[&Clip], by_hand: &HandTags) -> Vec<String> {
    let all = clips.iter().flat_map(|clip| whole_tags(clip, by_hand));
    let tags: BTreeSet<String> = all.map(|tag| tag.to_lowercase()).collect();
    tags.into_iter().collect()
}
