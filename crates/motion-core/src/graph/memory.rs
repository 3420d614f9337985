//! What a build takes of memory, from the number of frames alone: told before it is taken.

use super::BuildOptions;
use crate::similarity::metric_columns;
use crate::skeleton::Skeleton;

/// Leaf edges of a frame where a frame keeps its best ones: sets of motion capture come to 20 to 23.
const TYPICAL_EDGES: u64 = 24;

/// The program itself, its threads, and what is the same for any number of frames.
const FIXED_BYTES: u64 = 64 << 20;

/// Bytes of a leaf edge in its tree, with its share of inner nodes and of a pair of clips.
const BYTES_PER_EDGE: u64 = 28;

/// About how many bytes building and writing a library take at their height, clips included. Where
/// all edges are kept none of them count: those have a budget of their own
/// ([`BuildOptions::edge_budget_bytes`]).
///
/// Three heights are in question, all of them with the poses of the frames: each frame's feature
/// vector twice and its list of edges while edges are looked for; then one vector and the trees, in
/// pieces and joined; at last the file beside what is in it, the trees once more on the way.
pub fn build_bytes(skeleton: &Skeleton, n_frames: usize, options: &BuildOptions) -> u64 {
    let pose = 16 * skeleton.n_joints() as u64 + 30;
    let features = 4 * 6 * metric_columns(skeleton).len() as u64;
    let keeps_all = n_frames <= options.all_edges_until_frames;
    let places = if keeps_all { 0 } else { options.edges_per_frame as u64 };
    let n_edges = TYPICAL_EDGES.min(places);
    // With the coordinates in the projection.
    let looking = 2 * features + 8 * places + 80;
    let growing = features + n_edges * (8 + 2 * BYTES_PER_EDGE);
    let writing = pose + n_edges * 3 * BYTES_PER_EDGE;
    FIXED_BYTES + n_frames as u64 * (pose + looking.max(growing).max(writing))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::testing::wander;

    #[test]
    fn it_grows_with_the_frames_and_with_what_they_keep() {
        let clips = wander::clips(1, 10, false, 3);
        let bytes = |n_frames, edges_per_frame| {
            let options = BuildOptions { edges_per_frame, ..BuildOptions::default() };
            build_bytes(clips.skeleton(), n_frames, &options)
        };
        assert!(bytes(60_000, 32) > bytes(60_000, 8));
        assert_eq!(bytes(50_000, 32), bytes(50_000, 8), "all are kept, from a budget of their own");
        let (half, whole) = (bytes(500_000, 32), bytes(1_000_000, 32));
        assert_eq!(whole - half, half - FIXED_BYTES);
    }
}
