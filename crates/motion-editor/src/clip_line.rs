//! A clip of the library, as lists show it.

use motion_session::live::ReadyLibrary;

/// A clip of the library.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct ClipLine {
    /// Its id.
    pub id: String,
    /// How long it is.
    pub n_frames: usize,
    /// What it is labelled with.
    pub tags: Vec<String>,
}

/// The clips of a library.
pub fn clip_lines(library: &ReadyLibrary) -> Vec<ClipLine> {
    let line = |clip: &motion_core::clip::Clip| ClipLine {
        id: clip.id.clone(),
        n_frames: clip.n_frames(),
        tags: clip.tags.clone(),
    };
    library.library.clips.clips().iter().map(line).collect()
}
