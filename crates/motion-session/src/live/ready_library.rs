//! A library with everything that searching and finishing on it needs, made once.

use std::sync::Arc;

use motion_core::assemble::Assembler;
use motion_core::floor::Soles;
use motion_core::graph::EdgeId;
use motion_core::path::{Path, Piece};
use motion_core::search::SearchLibrary;
use motion_core::skeleton::Skeleton;
use motion_core::units::FrameIdx;
use motion_scene::mesh::MeshId;

use crate::Library;
use crate::document::TakePiece;
use crate::stage::figure::Figure;

/// A library ready for searching. Cheap to clone.
#[derive(Clone, Debug)]
pub struct ReadyLibrary {
    /// The clips and their graph.
    pub library: Library,
    /// The same, laid out for the search.
    pub search: Arc<SearchLibrary>,
    /// What a body of the library's skeleton looks like: a mannequin.
    pub figure: Arc<Figure>,
    /// The library's skeleton.
    pub skeleton: Arc<Skeleton>,
    soles: Soles,
}

impl ReadyLibrary {
    /// Lays out a library and models a mannequin; some hundred milliseconds.
    pub fn new(library: Library) -> Self {
        let (clips, graph) = (Arc::clone(&library.clips), Arc::clone(&library.graph));
        let soles = Assembler::new(&clips).soles();
        let skeleton = Arc::new(clips.skeleton().clone());
        let some_motion = clips.clips().first().map(|clip| &clip.motion);
        let figure = Arc::new(Figure::mannequin(MeshId(0), &skeleton, some_motion, soles));
        let search = Arc::new(SearchLibrary::new(clips, graph));
        Self { library, search, figure, skeleton, soles }
    }

    /// What makes motions of its pieces.
    pub fn assembler(&self) -> Assembler<'_> {
        Assembler::with_soles(&self.library.clips, self.soles)
    }

    /// Whether both are the same one.
    pub fn is(&self, other: &Self) -> bool {
        Arc::ptr_eq(&self.search, &other.search)
    }

    /// What a path is made of, by the clips' ids.
    pub fn pieces(&self, path: &Path) -> Vec<TakePiece> {
        named_pieces(&self.library, path)
    }

    /// The path that is made of these pieces; `None` where the library has no such clip or cut any
    /// more.
    pub fn path(&self, pieces: &[TakePiece]) -> Option<Path> {
        let (clips, graph) = (&self.library.clips, &self.library.graph);
        let (first, last) = (pieces.first()?, pieces.last()?);
        let cut = |pair: &[TakePiece]| {
            let [left, entered] = pair else { return None };
            let (from, to) = (clips.by_id(&left.clip)?, clips.by_id(&entered.clip)?);
            let nodes = graph.pair(from, to)?;
            let fits = |id: &EdgeId| {
                let edge = graph.forest.edge(*id);
                edge.from_frame.0 == left.to + 1 && edge.to_frame.0 == entered.from
            };
            // Edges of several levels may say the same; the finest has its true cost.
            let all = || (nodes.first_node..nodes.end_node).map(EdgeId).filter(fits);
            all().find(|&id| graph.forest.is_leaf(id)).or_else(|| all().next())
        };
        let path = Path {
            first_clip: clips.by_id(&first.clip)?,
            start: FrameIdx(first.from),
            cuts: pieces.windows(2).map(cut).collect::<Option<_>>()?,
            end: FrameIdx(last.to),
        };
        path.is_valid(graph).then_some(path)
    }
}

/// What a path through a library is made of, by the clips' ids.
pub(crate) fn named_pieces(library: &Library, path: &Path) -> Vec<TakePiece> {
    let named = |piece: Piece| TakePiece {
        clip: library.clips.clip(piece.clip).id.clone(),
        from: piece.from.0,
        to: piece.to.0,
    };
    path.pieces(&library.graph).into_iter().map(named).collect()
}
