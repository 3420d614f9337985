//! The real editor, driven without a window, drawn on software Vulkan.
#![allow(clippy::print_stderr, reason = "a test that is skipped says so")]

mod author;
mod by_hand;
mod coverage;
mod device_loss;
mod files;
mod look;
mod path_dialog;
mod screens;
mod tags;
mod takes;
mod timeline;
mod timeline_cost;
mod tools;
mod why;
mod window;
