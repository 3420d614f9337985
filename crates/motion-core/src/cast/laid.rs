//! A motion of one character by itself.

use crate::path::Path;
use crate::planar::PlanarTransform;
use crate::score::{judge, lay_end_to_end};
use crate::search::{Problem, SearchLibrary};

/// A motion laid into the world as its character's own places say: without those of interactions
/// and without regard to others.
#[derive(Clone, Debug)]
pub(super) struct Laid {
    pub(super) path: Path,
    /// The round that found it.
    pub(super) found_in: u64,
    /// What it scores by itself.
    pub(super) score: f32,
    /// Torsos of all frames. Where no place is asked for, the first is at the identity.
    pub(super) torsos: Vec<PlanarTransform>,
    /// Whether a place of its own says where in the world it is.
    pub(super) is_placed: bool,
}

impl Laid {
    /// `alone` is what is asked of the character without the others. `None` where the motion is
    /// too short for it.
    pub(super) fn new(
        library: &SearchLibrary,
        alone: &Problem,
        path: Path,
        found_in: u64,
    ) -> Option<Self> {
        let (graph, clips) = (library.graph(), library.clips());
        let judged = judge(graph, clips, &alone.wishes, &path)?;
        let mut torsos = lay_end_to_end(clips, &path.pieces(graph));
        torsos.iter_mut().for_each(|torso| *torso = judged.world_from_start * *torso);
        let is_placed = alone.wishes.anchor().is_some();
        let score = judged.terms.total();
        Some(Self { path, found_in, score, torsos, is_placed })
    }
}
