//! How alike two frames are (AF02 appendix A; `docs/metric.md`).
//!
//! The cost of cutting from one frame to another is a squared Euclidean distance between two
//! feature vectors: `C(s, t) = ‖x(s) − x(t)‖²`. [`features`] makes the vectors,
//! [`distance_grid`] finds all pairs that are near, `product` multiplies matrices.

#[cfg(test)]
mod brute;
pub mod columns;
pub mod distance_grid;
pub mod features;
mod product;

pub use columns::{Column, ColumnSource, metric_columns};
pub use features::{FeatureSet, Metric};
