//! What benchmarks and figures share: the clips, the problems, and motions made of solutions.

pub mod asked;
pub mod clips;
pub mod finish;
pub mod many_frames;
pub mod problems;
pub mod random_problems;
pub mod stopwatch;
