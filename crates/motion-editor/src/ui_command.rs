//! Everything that can be asked of the window, once: menus, keys, buttons and the palette all
//! speak of these.

use egui::{Key, KeyboardShortcut, Modifiers};

use motion_session::live::SearchState;

use crate::settings::Tool;
use crate::state::EditorState;

/// A command.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum UiCommand {
    /// Takes back the last change.
    Undo,
    /// Does it again.
    Redo,
    /// Removes what is selected.
    Delete,
    /// Selects and drags.
    SelectTool,
    /// Puts checkpoints on the floor.
    CheckpointTool,
    /// Plays or pauses.
    PlayPause,
    /// One frame back.
    StepBack,
    /// One frame ahead.
    StepAhead,
    /// A second back.
    SecondBack,
    /// A second ahead.
    SecondAhead,
    /// To the checkpoint or cut before.
    PreviousStop,
    /// To the next checkpoint or cut.
    NextStop,
    /// To the first frame.
    ToStart,
    /// To the last frame.
    ToEnd,
    /// Loops or not.
    Loop,
    /// Slower.
    Slower,
    /// Faster.
    Faster,
    /// Speed 1.
    NormalSpeed,
    /// Shows take number n, from 1 to 9.
    ShowTake(u8),
    /// Back to the take that was shown before.
    FlipTakes,
    /// Everything in view.
    FrameAll,
    /// From the front.
    ViewFront,
    /// From the body's left.
    ViewLeft,
    /// From above.
    ViewTop,
    /// From the front left and a little above.
    ViewThreeQuarter,
    /// Vanishing points or none.
    Perspective,
    /// The camera keeps to the character.
    Follow,
    /// The way over the floor.
    Trail,
    /// Other moments of the motion.
    Ghosts,
    /// The whole motion on the timeline.
    FitTimeline,
    /// Shows or hides the library.
    LeftPanel,
    /// Shows or hides takes and inspector.
    RightPanel,
    /// Shows or hides the timeline.
    Timeline,
    /// Dark or light.
    Theme,
    /// Whose mouse buttons move the camera.
    Navigation,
    /// Saves to the project's own file.
    Save,
    /// Pauses the search or lets it go on.
    PauseSearch,
    /// Searches from other seeds, too.
    Shake,
    /// Always shows the best take.
    FollowBest,
    /// All commands.
    Palette,
    /// All keys.
    ShortcutSheet,
    /// Closes the window.
    Quit,
}

const fn key(key: Key) -> Option<KeyboardShortcut> {
    Some(KeyboardShortcut::new(Modifiers::NONE, key))
}

const fn with(modifiers: Modifiers, key: Key) -> Option<KeyboardShortcut> {
    Some(KeyboardShortcut::new(modifiers, key))
}

impl UiCommand {
    /// Every command, in the order of menus.
    pub fn all() -> Vec<Self> {
        let mut all = vec![Self::Save, Self::Quit, Self::Undo, Self::Redo, Self::Delete];
        all.extend([Self::PauseSearch, Self::Shake, Self::FollowBest]);
        all.extend([Self::SelectTool, Self::CheckpointTool]);
        all.extend([
            Self::PlayPause,
            Self::StepBack,
            Self::StepAhead,
            Self::SecondBack,
            Self::SecondAhead,
        ]);
        all.extend([Self::PreviousStop, Self::NextStop, Self::ToStart, Self::ToEnd, Self::Loop]);
        all.extend([Self::Slower, Self::Faster, Self::NormalSpeed]);
        all.extend((1..=9).map(Self::ShowTake));
        all.push(Self::FlipTakes);
        all.extend([
            Self::FrameAll,
            Self::ViewFront,
            Self::ViewLeft,
            Self::ViewTop,
            Self::ViewThreeQuarter,
        ]);
        all.extend([Self::Perspective, Self::Follow, Self::Trail, Self::Ghosts, Self::FitTimeline]);
        all.extend([
            Self::LeftPanel,
            Self::RightPanel,
            Self::Timeline,
            Self::Theme,
            Self::Navigation,
        ]);
        all.extend([Self::Palette, Self::ShortcutSheet]);
        all
    }

    /// What menus say.
    pub fn label(self) -> String {
        match self {
            Self::Undo => "Undo",
            Self::Redo => "Redo",
            Self::Delete => "Delete checkpoint",
            Self::SelectTool => "Select tool",
            Self::CheckpointTool => "Checkpoint tool",
            Self::PlayPause => "Play or pause",
            Self::StepBack => "One frame back",
            Self::StepAhead => "One frame ahead",
            Self::SecondBack => "One second back",
            Self::SecondAhead => "One second ahead",
            Self::PreviousStop => "Previous checkpoint or cut",
            Self::NextStop => "Next checkpoint or cut",
            Self::ToStart => "First frame",
            Self::ToEnd => "Last frame",
            Self::Loop => "Loop",
            Self::Slower => "Slower",
            Self::Faster => "Faster",
            Self::NormalSpeed => "Normal speed",
            Self::ShowTake(n) => return format!("Show take {n}"),
            Self::FlipTakes => "Flip between the last two takes",
            Self::FrameAll => "Frame all",
            Self::ViewFront => "View from the front",
            Self::ViewLeft => "View from the left",
            Self::ViewTop => "View from above",
            Self::ViewThreeQuarter => "Three-quarter view",
            Self::Perspective => "Perspective",
            Self::Follow => "Follow the character",
            Self::Trail => "Show the way over the floor",
            Self::Ghosts => "Show ghosts",
            Self::FitTimeline => "Fit the timeline",
            Self::LeftPanel => "Library panel",
            Self::RightPanel => "Takes panel",
            Self::Timeline => "Timeline panel",
            Self::Theme => "Dark or light",
            Self::Navigation => "Blender or Industry navigation",
            Self::Save => "Save",
            Self::PauseSearch => "Pause or resume the search",
            Self::Shake => "Shake the search",
            Self::FollowBest => "Follow the best take",
            Self::Palette => "Find a command…",
            Self::ShortcutSheet => "Keyboard shortcuts",
            Self::Quit => "Quit",
        }
        .to_owned()
    }

    /// What is said when the pointer rests on it.
    pub fn tooltip(self) -> &'static str {
        match self {
            Self::Undo => "Takes back the last change of the project",
            Self::Redo => "Does again what was taken back",
            Self::Delete => "Removes the selected checkpoint",
            Self::SelectTool => "Select and drag what is there; drag elsewhere to orbit",
            Self::CheckpointTool => {
                "Press on the floor where the body must be, drag to where it looks"
            }
            Self::PlayPause => "Plays the shown take, or pauses it",
            Self::StepBack | Self::StepAhead => "Pauses and goes to the neighbouring frame",
            Self::SecondBack | Self::SecondAhead => "Goes by one second of the motion",
            Self::PreviousStop | Self::NextStop => "Goes to where something happens",
            Self::ToStart | Self::ToEnd => "Goes to an end of the motion",
            Self::Loop => "Begins again at the end",
            Self::Slower | Self::Faster | Self::NormalSpeed => "How fast time goes, 0.1× to 4×",
            Self::ShowTake(_) => "Shows another motion under the same constraints",
            Self::FlipTakes => "Compares two takes at the same frame",
            Self::FrameAll => "Brings the whole motion into view",
            Self::ViewFront | Self::ViewLeft | Self::ViewTop | Self::ViewThreeQuarter => {
                "Looks from there"
            }
            Self::Perspective => "With vanishing points, or without",
            Self::Follow => "The camera goes along with the character",
            Self::Trail => "Where the body goes: past orange, future blue",
            Self::Ghosts => "Shows other moments of the motion, faint",
            Self::FitTimeline => "Shows all frames on the timeline",
            Self::LeftPanel | Self::RightPanel | Self::Timeline => "Shows the panel, or hides it",
            Self::Theme => "Changes the colours of the window",
            Self::Navigation => {
                "Blender: middle button orbits. Industry: Alt with the left, middle, right button"
            }
            Self::Save => "Writes the project to its own file",
            Self::PauseSearch => "What was found stays",
            Self::Shake => "Searches from other beginnings; what was found stays",
            Self::FollowBest => "Shows a better take as soon as there is one",
            Self::Palette => "Every command by its name",
            Self::ShortcutSheet => "Every key on one sheet",
            Self::Quit => "Closes the window",
        }
    }

    /// Its key, if it has one.
    pub fn shortcut(self) -> Option<KeyboardShortcut> {
        const ROW: [Key; 9] = [
            Key::Num1,
            Key::Num2,
            Key::Num3,
            Key::Num4,
            Key::Num5,
            Key::Num6,
            Key::Num7,
            Key::Num8,
            Key::Num9,
        ];
        match self {
            Self::Undo => with(Modifiers::CTRL, Key::Z),
            Self::Redo => with(Modifiers::CTRL.plus(Modifiers::SHIFT), Key::Z),
            Self::Delete => key(Key::Delete),
            Self::SelectTool => key(Key::Q),
            Self::CheckpointTool => key(Key::C),
            Self::PlayPause => key(Key::Space),
            Self::StepBack => key(Key::ArrowLeft),
            Self::StepAhead => key(Key::ArrowRight),
            Self::SecondBack => with(Modifiers::SHIFT, Key::ArrowLeft),
            Self::SecondAhead => with(Modifiers::SHIFT, Key::ArrowRight),
            Self::PreviousStop => key(Key::ArrowUp),
            Self::NextStop => key(Key::ArrowDown),
            Self::ToStart => with(Modifiers::CTRL, Key::ArrowLeft),
            Self::ToEnd => with(Modifiers::CTRL, Key::ArrowRight),
            Self::Loop => with(Modifiers::SHIFT, Key::L),
            Self::Slower => key(Key::Minus),
            Self::Faster => key(Key::Equals),
            Self::NormalSpeed => key(Key::Backslash),
            Self::ShowTake(n) => ROW.get(usize::from(n).wrapping_sub(1)).copied().and_then(key),
            Self::FlipTakes => key(Key::Tab),
            Self::FrameAll => key(Key::F),
            // Windows cannot tell the number pad from the row of digits, and that shows takes.
            Self::ViewFront => with(Modifiers::ALT, Key::Num1),
            Self::ViewLeft => with(Modifiers::ALT, Key::Num3),
            Self::ViewTop => with(Modifiers::ALT, Key::Num7),
            Self::ViewThreeQuarter => with(Modifiers::ALT, Key::Num9),
            Self::Perspective => with(Modifiers::ALT, Key::Num5),
            Self::Follow => with(Modifiers::ALT, Key::Num0),
            Self::FitTimeline => with(Modifiers::SHIFT, Key::F),
            Self::Palette => with(Modifiers::CTRL, Key::P),
            Self::ShortcutSheet => key(Key::F1),
            Self::Quit => with(Modifiers::CTRL, Key::Q),
            Self::Save => with(Modifiers::CTRL, Key::S),
            Self::PauseSearch => with(Modifiers::CTRL, Key::Enter),
            Self::Shake => with(Modifiers::CTRL.plus(Modifiers::SHIFT), Key::Enter),
            Self::FollowBest => None,
            Self::Trail
            | Self::Ghosts
            | Self::LeftPanel
            | Self::RightPanel
            | Self::Timeline
            | Self::Theme
            | Self::Navigation => None,
        }
    }

    /// Other keys for the same.
    pub fn other_shortcuts(self) -> &'static [KeyboardShortcut] {
        const PALETTE: &[KeyboardShortcut] = &[
            KeyboardShortcut::new(Modifiers::NONE, Key::F3),
            KeyboardShortcut::new(Modifiers::CTRL, Key::K),
        ];
        const FRAME: &[KeyboardShortcut] = &[
            KeyboardShortcut::new(Modifiers::NONE, Key::Home),
            KeyboardShortcut::new(Modifiers::NONE, Key::Period),
        ];
        const REDO: &[KeyboardShortcut] = &[KeyboardShortcut::new(Modifiers::CTRL, Key::Y)];
        const DELETE: &[KeyboardShortcut] = &[KeyboardShortcut::new(Modifiers::NONE, Key::X)];
        const SELECT: &[KeyboardShortcut] = &[KeyboardShortcut::new(Modifiers::NONE, Key::Escape)];
        match self {
            Self::Redo => REDO,
            Self::Delete => DELETE,
            Self::SelectTool => SELECT,
            Self::Palette => PALETTE,
            Self::FrameAll => FRAME,
            _ => &[],
        }
    }

    /// Whether it can be done now.
    pub fn is_enabled(self, state: &EditorState) -> bool {
        match self {
            Self::ShowTake(n) => usize::from(n) <= state.takes.len(),
            Self::FlipTakes => state.shown_before.is_some(),
            Self::Save => state.authoring.as_ref().is_some_and(|a| a.session.path().is_some()),
            Self::Undo => state.authoring.as_ref().is_some_and(|a| a.can_undo_redo().0),
            Self::Redo => state.authoring.as_ref().is_some_and(|a| a.can_undo_redo().1),
            Self::Delete => state.selected_mark().is_some(),
            Self::PlayPause
            | Self::StepBack
            | Self::StepAhead
            | Self::SecondBack
            | Self::SecondAhead
            | Self::PreviousStop
            | Self::NextStop
            | Self::ToStart
            | Self::ToEnd
            | Self::FrameAll
            | Self::FitTimeline => state.shown_take().is_some(),
            _ => true,
        }
    }

    /// Whether it is something that is on or off, and which.
    pub fn is_on(self, state: &EditorState) -> Option<bool> {
        Some(match self {
            Self::Loop => state.player.is_looping(),
            Self::SelectTool => state.settings.tool == Tool::Select,
            Self::CheckpointTool => state.settings.tool == Tool::Checkpoint,
            Self::Follow => state.settings.follow,
            Self::FollowBest => state.settings.follow_best,
            Self::PauseSearch => state.search_state() == SearchState::Paused,
            Self::Trail => state.settings.trail,
            Self::Ghosts => state.settings.ghosts,
            Self::LeftPanel => state.settings.left_open,
            Self::RightPanel => state.settings.right_open,
            Self::Timeline => state.settings.timeline_open,
            Self::ShowTake(n) => state.shown.map(|take| take + 1) == Some(usize::from(n)),
            _ => return None,
        })
    }
}

/// The commands whose keys are pressed now. Nothing while somebody types.
pub fn pressed(ctx: &egui::Context) -> Vec<UiCommand> {
    if ctx.text_edit_focused() {
        return Vec::new();
    }
    let mut keys: Vec<(KeyboardShortcut, UiCommand)> = Vec::new();
    for command in UiCommand::all() {
        let all = command.shortcut().into_iter().chain(command.other_shortcuts().iter().copied());
        keys.extend(all.map(|shortcut| (shortcut, command)));
    }
    // Shift+→ would also do for →: what asks for more is looked at first.
    keys.sort_by_key(|(shortcut, _)| {
        let m = shortcut.modifiers;
        std::cmp::Reverse(u8::from(m.shift) + u8::from(m.alt) + u8::from(m.ctrl))
    });
    ctx.input_mut(|input| {
        keys.iter()
            .filter(|(shortcut, _)| input.consume_shortcut(shortcut))
            .map(|(_, command)| *command)
            .collect()
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn no_key_does_two_things() {
        let mut seen: Vec<(KeyboardShortcut, UiCommand)> = Vec::new();
        for command in UiCommand::all() {
            let own = command.shortcut().into_iter();
            for shortcut in own.chain(command.other_shortcuts().iter().copied()) {
                let twice = seen.iter().find(|(other, _)| *other == shortcut);
                assert!(twice.is_none(), "{shortcut:?}: {command:?} and {twice:?}");
                seen.push((shortcut, command));
            }
        }
    }

    #[test]
    fn every_command_says_what_it_is() {
        for command in UiCommand::all() {
            assert!(!command.label().is_empty() && !command.tooltip().is_empty());
            let first = command.label().chars().next();
            assert!(first.is_some_and(char::is_uppercase), "sentence case: {command:?}");
        }
    }
}
