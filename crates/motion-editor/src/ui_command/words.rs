//! What commands are called, and what is said when the pointer rests on them.

use motion_session::sample::SAMPLES;

use super::{Nudge, Side, UiCommand};
use crate::settings::GhostMode;

impl UiCommand {
    /// What menus say.
    pub fn label(self) -> String {
        match self {
            Self::ShowTake(n) => format!("Show take {n}"),
            Self::Sample(nth) => {
                let sample = SAMPLES.get(usize::from(nth)).map_or("", |sample| sample.title);
                format!("Sample “{sample}”")
            }
            Self::PinTake(n) => format!("Pin or unpin take {n}"),
            other => other.words().0.to_owned(),
        }
    }

    /// What is said when the pointer rests on it.
    pub fn tooltip(self) -> &'static str {
        self.words().1
    }

    fn words(self) -> (&'static str, &'static str) {
        match self {
            Self::New => ("New", "Begins a project: somebody who walks four metres"),
            Self::Open => ("Open…", "Opens a project"),
            Self::Recent(_) => ("Open again", "Opens a project that was open lately"),
            Self::Sample(_) => ("Sample", "Opens a project that the program has with it"),
            Self::SaveAs => ("Save as…", "Writes the project to another file, which it is in then"),
            Self::Import => {
                ("Import clips…", "Takes motion capture files into a library of your own")
            }
            Self::ImportFolder => {
                ("Import a folder…", "Takes all motion capture files of a folder into a library")
            }
            Self::Export => ("Export…", "Writes the shown motion to a file for other programs"),
            Self::ExportAgain => {
                ("Export again", "Writes the shown motion where one was written the last time")
            }
            Self::Save => ("Save", "Writes the project to its own file"),
            Self::Quit => ("Quit", "Closes the window"),

            Self::Undo => ("Undo", "Takes back the last change of the project"),
            Self::Redo => ("Redo", "Does again what was taken back"),
            Self::Delete => ("Delete", "Removes what is selected"),
            Self::Duplicate => {
                ("Duplicate at the playhead", "Asks the same once more, from the playhead on")
            }
            Self::SelectAll => {
                ("Select all constraints", "Selects all that is asked of the active character")
            }
            Self::SelectNone => ("Select nothing", "Selects nothing any more"),
            Self::RetimeBack => {
                ("Selection one frame earlier", "Brings what is selected to an earlier frame")
            }
            Self::RetimeAhead => {
                ("Selection one frame later", "Brings what is selected to a later frame")
            }
            Self::ScaleTimes => (
                "Scale times",
                "Draws the times of what is selected out or together about the playhead; digits say by what",
            ),
            Self::SelectTool => {
                ("Select tool", "Select and drag what is there; drag elsewhere to orbit")
            }
            Self::CheckpointTool => (
                "Checkpoint tool",
                "Press on the floor where the body must be, drag to where it looks",
            ),

            Self::JointTargetTool => (
                "Joint target tool",
                "Drag from a joint to where it must be; hold Z to lift it, the head is always lifted",
            ),
            Self::PoseTool => (
                "Pose tool",
                "Click on the floor for a pose of a clip; R or the wheel turns it, [ and ] choose its \
                 frame",
            ),
            Self::PathTool => {
                ("Path tool", "Draw on the floor where the body must go, from the playhead on")
            }
            Self::ObstacleTool => (
                "Obstacle tool",
                "Drag a rectangle on the floor for a box or a ceiling, or a circle for a cylinder",
            ),
            Self::ByHandTool => (
                "By hand tool",
                "Drag a hand or a foot of the shown take to move it around this frame, another joint \
                 to turn it; hold Z to lift",
            ),
            Self::AddCheckpoint => (
                "Add checkpoint here",
                "Puts a checkpoint in front of the character, at the playhead",
            ),
            Self::AddJointTarget => (
                "Add joint target here",
                "Asks for the head at the playhead where it is; the inspector has every joint",
            ),
            Self::AddPose => (
                "Add pose here",
                "Asks for the chosen clip's pose at the playhead, wherever the body is",
            ),
            Self::AddStyle => (
                "Add style",
                "Asks for clips with a tag over the part that is played, or a second from the \
                 playhead on",
            ),
            Self::MeetHere => (
                "Meet here",
                "Has this character and the next face each other in their poses at the playhead",
            ),
            Self::MoveSelection => (
                "Move",
                "What is selected follows the pointer; X, Y, Z hold an axis, digits say how far",
            ),
            Self::TurnSelection => {
                ("Turn", "What is selected turns with the pointer; digits say how far")
            }
            Self::BoxSelect => ("Select a box", "Drag a box around what is to be selected"),
            Self::Nudge(nudge) => nudge_words(nudge),
            Self::TurnLeft => ("Turn left by 5°", "Turns what is selected"),
            Self::TurnRight => ("Turn right by 5°", "Turns what is selected"),

            Self::PlayPause => ("Play or pause", "Plays the shown take, or pauses it"),
            Self::PlayBackwards => ("Play backwards", "Plays the shown take from its end"),
            Self::Stop => ("Stop", "Pauses at a whole frame"),
            Self::PlayAhead => ("Play", "Plays the shown take"),
            Self::LoopIn => ("Loop from here", "What is played begins at the playhead"),
            Self::LoopOut => ("Loop up to here", "What is played ends at the playhead"),
            Self::ClearLoop => ("Play all", "What is played is the whole motion again"),
            Self::Loop => ("Loop", "Begins again at the end"),
            Self::Slower => ("Slower", "How fast time goes, 0.1× to 4×"),
            Self::NormalSpeed => ("Normal speed", "How fast time goes, 0.1× to 4×"),
            Self::Faster => ("Faster", "How fast time goes, 0.1× to 4×"),
            Self::StepBack => ("One frame back", "Pauses and goes to the frame before"),
            Self::StepAhead => ("One frame ahead", "Pauses and goes to the next frame"),
            Self::SecondBack => ("One second back", "Goes back by one second of the motion"),
            Self::SecondAhead => ("One second ahead", "Goes on by one second of the motion"),
            Self::PreviousStop => {
                ("Previous constraint or cut", "Goes back to where something happens")
            }
            Self::NextStop => ("Next constraint or cut", "Goes on to where something happens"),
            Self::ToStart => (
                "First frame",
                "Goes to the beginning of what is played; Home does too with the pointer on the timeline",
            ),
            Self::ToEnd => ("Last frame", "Goes to the end of what is played"),

            Self::FrameSelection => {
                ("Frame selection", "Brings what is selected into view, or all of the motion")
            }
            Self::FrameAll => ("Frame all", "Brings the whole motion into view"),
            Self::ViewFront => ("View from the front", "Looks along −Z"),
            Self::ViewBack => ("View from behind", "Looks along +Z"),
            Self::ViewRight => ("View from the right", "Looks along +X, at the body's right"),
            Self::ViewPie => ("Views…", "The usual views around the pointer"),
            Self::Fly => (
                "Fly",
                "W, A, S, D, Q and E move the camera, the mouse turns it, the wheel says how fast",
            ),
            Self::ViewLeft => ("View from the left", "Looks along −X, at the body's left"),
            Self::ViewTop => ("View from above", "Looks down"),
            Self::ViewThreeQuarter => {
                ("Three-quarter view", "Looks from the front left and a little above")
            }
            Self::Perspective => ("Perspective", "With vanishing points, or without"),
            Self::Follow => ("Follow the character", "The camera goes along with the character"),
            Self::Trail => {
                ("Show the way over the floor", "Where the body goes: past orange, future blue")
            }
            Self::JointTrails => (
                "Show ways of hands, feet and head",
                "A dot for every frame: past orange, future blue",
            ),
            Self::Ghosts => (
                "Show ghosts",
                "Other moments, faint: around the frame, at constraints, over the motion, none",
            ),
            Self::GhostsAre(mode) => match mode {
                GhostMode::Off => ("No ghosts", "Shows this moment only"),
                GhostMode::Around => {
                    ("Ghosts around the frame", "Shows some moments before and after, faint")
                }
                GhostMode::AtConstraints => {
                    ("Ghosts at constraints", "Shows the moments at which something is asked for")
                }
                GhostMode::Fan => {
                    ("Ghosts over the whole motion", "Shows moments of all of the motion, faint")
                }
            },
            Self::ReducedMotion => ("Reduced motion", "The camera jumps instead of gliding"),
            Self::NextPanel => {
                ("Next panel", "Keys go to the next panel; Tab goes through what is in it")
            }
            Self::PreviousPanel => ("Previous panel", "Keys go to the panel before"),
            Self::LeftPanel => ("Library panel", "Shows the panel, or hides it"),
            Self::RightPanel => ("Takes panel", "Shows the panel, or hides it"),
            Self::Timeline => ("Timeline panel", "Shows the panel, or hides it"),
            Self::FitTimeline => ("Fit the timeline", "Shows all frames on the timeline"),
            Self::TimelineNearer => {
                ("Nearer on the timeline", "Shows fewer frames, those around the playhead")
            }
            Self::TimelineFarther => ("Farther on the timeline", "Shows more frames"),
            Self::Curves => (
                "Curves on the timeline",
                "Misses, speed, turning and distance from drawn paths, frame by frame",
            ),
            Self::TimeUnit => {
                ("Frames, seconds or timecode", "How moments are written on the timeline")
            }
            Self::NextCharacter => {
                ("Next character", "Shows another character on the timeline and in the gallery")
            }
            Self::Theme => ("Dark or light", "Changes the colours of the window"),
            Self::Navigation => (
                "Blender or Industry navigation",
                "Blender: middle button orbits. Industry: Alt with the left, middle, right button",
            ),
            Self::FullScreen => ("Full screen", "Fills the screen, or no longer does"),
            Self::Settings => ("Settings…", "Colours, mouse, sizes"),
            Self::Coverage => (
                "Coverage",
                "What the library can do and what it cannot, and what would be worth recording",
            ),
            Self::Log => ("Log", "Everything that was said"),

            Self::ShowTake(_) => ("Show take", "Shows another motion under the same constraints"),
            Self::FlipTakes => {
                ("Flip between the last two takes", "Compares two takes at the same frame")
            }
            Self::PinTake(_) => {
                ("Pin or unpin take", "A pinned take stays with the project, whatever is found")
            }
            Self::ShowBetter => (
                "Show the better take",
                "Shows the best take where it is better than the shown one",
            ),
            Self::Compare => (
                "Compare takes",
                "Shows other takes beside this one, each in its colour; Shift+click adds a card",
            ),
            Self::CompareSplit => {
                ("Compare takes side by side", "Shows each take in a view of its own, one camera")
            }
            Self::RenameTake => ("Rename the take…", "Types a name on the shown take's card"),
            Self::MoreLikeThis => {
                ("More like this take", "Looks for takes that share at least half of the shown one")
            }
            Self::LockStretch => (
                "Lock a stretch of this take",
                "Keeps the chosen range of the shown take, or the piece under the pointer",
            ),
            Self::PauseSearch => ("Pause or resume the search", "What was found stays"),
            Self::Shake => {
                ("Shake the search", "Searches from other beginnings; what was found stays")
            }
            Self::FollowBest => {
                ("Follow the best take", "Shows a better take as soon as there is one")
            }

            Self::Guide => ("Guide in five steps", "Shows the window by what is done in it"),
            Self::Palette => ("Find a command…", "Every command by its name"),
            Self::ShortcutSheet => ("Keyboard shortcuts", "Every key on one sheet"),
        }
    }
}

fn nudge_words(nudge: Nudge) -> (&'static str, &'static str) {
    const ABOUT: &str = "Moves what is selected over the floor, as the camera sees it";
    let label = match (nudge.to, nudge.is_fine) {
        (Side::Left, false) => "Nudge left by 10 cm",
        (Side::Right, false) => "Nudge right by 10 cm",
        (Side::Away, false) => "Nudge away by 10 cm",
        (Side::Near, false) => "Nudge near by 10 cm",
        (Side::Left, true) => "Nudge left by 1 cm",
        (Side::Right, true) => "Nudge right by 1 cm",
        (Side::Away, true) => "Nudge away by 1 cm",
        (Side::Near, true) => "Nudge near by 1 cm",
    };
    (label, ABOUT)
}
