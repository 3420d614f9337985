//! Motion graphs: from clips to an authored motion.
//!
//! The methods are those of Arikan & Forsyth 2002, *Interactive Motion Generation from
//! Examples* (AF02), with Heck & Gleicher 2007, *Parametric Motion Graphs* (PMG), to follow.
//!
//! Conventions: metres, radians, seconds; Y up, +Z forward, +X to the left of a body that looks
//! along +Z, right-handed; frames counted from 0. Transforms are named `world_from_torso`, so
//! that products read themselves right.
//!
//! This crate has no clock, no IO, no UI and no serde: results depend on arguments alone.

pub mod assemble;
pub mod bind_pose;
mod bodies;
pub mod by_hand;
pub mod cancel;
pub mod cast;
pub mod clip;
pub mod constraint;
pub mod contacts;
pub mod coverage;
pub mod floor;
pub mod graph;
pub mod ground;
pub mod ids;
pub mod ik;
pub mod measure;
pub mod motion;
pub mod path;
pub mod planar;
pub mod retarget;
pub mod rotation;
pub mod score;
pub mod search;
pub mod similarity;
pub mod skeleton;
pub mod support_level;
pub mod tags;
pub mod units;

#[cfg(test)]
mod testing;
