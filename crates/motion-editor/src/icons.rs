//! The icons, letters of Lucide's font (`assets/fonts/lucide.ttf`).

/// Plays.
pub const PLAY: &str = "\u{e13c}";
/// Pauses.
pub const PAUSE: &str = "\u{e12e}";
/// To the first frame.
pub const TO_START: &str = "\u{e15f}";
/// To the last frame.
pub const TO_END: &str = "\u{e160}";
/// One frame back.
pub const STEP_BACK: &str = "\u{e3e9}";
/// One frame ahead.
pub const STEP_AHEAD: &str = "\u{e3ea}";
/// What is held fast.
pub const LOCK: &str = "\u{e10b}";
/// Opened, with more below.
pub const OPEN: &str = "\u{e06d}";
/// Closed, with more to be had.
pub const CLOSED: &str = "\u{e06f}";
/// Plays over and over.
pub const LOOP: &str = "\u{e146}";
/// Looks for something.
pub const SEARCH: &str = "\u{e151}";
/// The camera keeps to the character.
pub const FOLLOW: &str = "\u{e1db}";
/// Everything in view.
pub const FRAME: &str = "\u{e257}";
/// The way over the floor.
pub const TRAIL: &str = "\u{e53e}";
/// The select tool.
pub const SELECT: &str = "\u{e1c3}";
/// The checkpoint tool.
pub const CHECKPOINT: &str = "\u{e123}";
/// The joint target tool.
pub const JOINT_TARGET: &str = "\u{e2d2}";
/// The pose tool.
pub const POSE: &str = "\u{e465}";
/// The path tool.
pub const PATH: &str = "\u{e38b}";
/// The obstacle tool.
pub const OBSTACLE: &str = "\u{e061}";
/// Characters who meet.
pub const MEETING: &str = "\u{e5c0}";
/// Changed by hand; the tool that does it.
pub const HAND: &str = "\u{e1d7}";
/// Adds something.
pub const ADD: &str = "\u{e13d}";
/// Removes something.
pub const REMOVE: &str = "\u{e18d}";
/// Pinned.
pub const PIN: &str = "\u{e259}";
/// No longer pinned.
pub const UNPIN: &str = "\u{e2b6}";
/// For earlier constraints.
pub const STALE: &str = "\u{e145}";
/// From other beginnings.
pub const SHAKE: &str = "\u{e2c5}";
/// Several in one view.
pub const OVERLAY: &str = "\u{e52a}";
/// Several side by side.
pub const SPLIT: &str = "\u{e098}";
/// Better.
pub const BETTER: &str = "\u{e190}";
/// Something is wrong.
pub const ALERT: &str = "\u{e077}";
/// A folder of files.
pub const FOLDER: &str = "\u{e0d7}";
/// A file.
pub const FILE: &str = "\u{e0c0}";
/// Closes.
pub const CLOSE: &str = "\u{e1b2}";
/// Done.
pub const DONE: &str = "\u{e06c}";
/// At work.
pub const WORKING: &str = "\u{e109}";

#[cfg(test)]
mod tests {
    /// A letter that the font lacks would be an empty box on the button.
    #[test]
    fn all_are_in_the_private_use_area() {
        for icon in [super::PLAY, super::PAUSE, super::LOOP, super::WORKING] {
            let letter = icon.chars().next().map(u32::from).unwrap_or_default();
            assert!((0xE000..0xF900).contains(&letter), "{letter:x}");
        }
    }
}
