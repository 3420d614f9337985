//! How alike two frames are (AF02 appendix A; `docs/metric.md`).
//!
//! The cost of cutting from one frame to another is a squared Euclidean distance between two
//! feature vectors: `C(s, t) = ‖x(s) − x(t)‖²`. [`features`] makes the vectors, [`families`]
//! says which clips are copies of one take. [`distance_grid`] finds all pairs that are near;
//! of large sets [`kept_edges`] finds the best few edges of each frame, with the help of
//! `frame_blocks`, `projection` and `close_pairs`. `product` multiplies matrices.

mod best_edges;
#[cfg(test)]
mod brute;
mod close_pairs;
pub mod columns;
pub mod directed;
pub mod distance_grid;
pub mod families;
pub mod features;
mod frame_blocks;
pub(crate) mod kept_edges;
mod product;
pub(crate) mod projection;
mod rough_cost;
pub(crate) mod sampled_nearest;
pub mod shard;
mod surface;

pub use columns::{Column, ColumnSource, metric_columns};
pub use directed::DirectedEdges;
pub use families::Families;
pub use features::{FeatureSet, Metric};
pub use shard::Shard;
