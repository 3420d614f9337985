//! Commands about the tags of clips.

use motion_core::tags::{HandTag, words};
use motion_io::limits::MAX_LIST;
use motion_io::project_file::TagEntry;

use super::settings::head;
use super::{CommandError, check};
use crate::document::Document;

/// Gives a clip a tag; a tag that it has already stays as it is.
pub(super) fn tag(document: &mut Document, clip: String, tag: HandTag) -> Result<(), CommandError> {
    check::name(&clip, "a clip")?;
    let tag = HandTag { tag: tag.tag.trim().to_owned(), ..tag };
    if words(&tag.tag).next().is_none() {
        return Err(CommandError::NoName("a tag"));
    }
    if let Some((from, to)) = tag.frames {
        check::frame(to.0)?;
        if to < from {
            return Err(CommandError::EndsBeforeItBegins { from: from.0, to: to.0 });
        }
    }
    let head = head(document);
    check::room(head.tags.len(), MAX_LIST, "tags given by hand")?;
    if !head.tags.iter().any(|entry| entry.clip == clip && entry.tag == tag) {
        head.tags.push(TagEntry { clip, tag, extra: Default::default() });
    }
    Ok(())
}

/// Takes a tag from a clip that was given it by hand.
pub(super) fn untag(
    document: &mut Document,
    clip: &str,
    tag: &HandTag,
) -> Result<(), CommandError> {
    let tags = &mut head(document).tags;
    let n_before = tags.len();
    tags.retain(|entry| !(entry.clip == clip && entry.tag == *tag));
    if tags.len() == n_before {
        return Err(CommandError::NoTag { clip: clip.to_owned(), tag: tag.tag.clone() });
    }
    Ok(())
}
