//! What is to be seen, as plain data.

pub mod body_plan;
pub mod color;
pub mod mesh;
