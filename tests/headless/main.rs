//! Rules that hold for the whole workspace, and tests that need several crates but no window.

mod assembly_on_clips;
mod dependency_rules;
mod house_rules;
mod manifest;
