//! Reusable pieces of panels.

pub mod digits;
pub mod icon_button;
