//! What benchmarks and figures share: the clips, the five problems, and motions made of solutions.

pub mod clips;
pub mod finish;
pub mod problems;
pub mod stopwatch;
