//! Whole scenes.
