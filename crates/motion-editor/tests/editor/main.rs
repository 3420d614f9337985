//! The real editor, driven without a window, drawn on software Vulkan.
#![allow(clippy::print_stderr, reason = "a test that is skipped says so")]

mod author;
mod by_hand;
mod coverage;
mod device_loss;
mod files;
mod look;
mod meetings;
mod obstacles;
mod path_dialog;
mod paths;
mod screens;
mod styles;
mod tags;
mod takes;
mod timeline;
mod timeline_cost;
mod times;
mod tools;
mod why;
mod window;
