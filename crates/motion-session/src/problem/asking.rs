//! Whose constraints are read, and for which library.

use std::path::Path;

use motion_core::ids::ClipId;
use motion_core::tags::HandTags;
use motion_io::diagnostic::FileError;
use motion_io::project_file::{Character, Constraint};

use super::Refusal;
use crate::Library;

/// A character whose constraints are made wishes of.
pub(super) struct Asking<'a> {
    name: &'a str,
    pub(super) library: &'a Library,
    allowed: &'a [bool],
    path: &'a Path,
    /// Tags given by hand.
    pub(super) by_hand: &'a HandTags,
    /// Sentences on what is odd.
    pub(super) remarks: Vec<String>,
}

impl<'a> Asking<'a> {
    /// For `character` on the clips of `library` that are `allowed`; errors name `path`.
    pub(super) fn new(
        character: &'a Character,
        library: &'a Library,
        allowed: &'a [bool],
        by_hand: &'a HandTags,
        path: &'a Path,
    ) -> Self {
        Self { name: &character.name, library, allowed, path, by_hand, remarks: Vec::new() }
    }

    /// Whether the palette has a clip.
    pub(super) fn is_allowed(&self, clip: ClipId) -> bool {
        self.allowed.get(clip.idx()).copied().unwrap_or_default()
    }

    /// A clip that a constraint must show, where the library and the palette have it and its frames
    /// `from` to `to`.
    pub(super) fn clip(
        &self,
        constraint: &Constraint,
        clip: &str,
        (from, to): (u32, u32),
    ) -> Result<ClipId, FileError> {
        let Some(id) = self.library.clips.by_id(clip) else {
            return Err(self.refuse(
                constraint,
                &format!("shows clip {clip:?}, which is not in the library"),
                "import the clip, or choose one of the library's",
            ));
        };
        let n_frames = self.library.clips.clip(id).n_frames();
        if to as usize >= n_frames || from > to {
            let last = n_frames.saturating_sub(1);
            return Err(self.refuse(
                constraint,
                &format!(
                    "shows frame {} of clip {clip:?}, which ends at frame {last}",
                    to.max(from)
                ),
                &format!("choose a frame from 0 to {last}"),
            ));
        }
        if !self.is_allowed(id) {
            return Err(self.refuse(
                constraint,
                &format!("shows clip {clip:?}, which the palette leaves out"),
                "include the clip, or choose another",
            ));
        }
        Ok(id)
    }

    /// A constraint that cannot be asked of this library.
    pub(super) fn refuse(
        &self,
        constraint: &Constraint,
        what: &str,
        what_to_do: &str,
    ) -> FileError {
        let what = format!("{} constraint {:?} {what}", constraint.kind.name(), constraint.id);
        Refusal::of(self.name, &what, what_to_do).in_file(self.path)
    }
}
