//! Which keys mean which command.

use egui::{Key, KeyboardShortcut, Modifiers};

use super::{Nudge, Side, UiCommand};

const fn bare(key: Key) -> KeyboardShortcut {
    KeyboardShortcut::new(Modifiers::NONE, key)
}

const fn shift(key: Key) -> KeyboardShortcut {
    KeyboardShortcut::new(Modifiers::SHIFT, key)
}

const fn ctrl(key: Key) -> KeyboardShortcut {
    KeyboardShortcut::new(Modifiers::CTRL, key)
}

const fn ctrl_shift(key: Key) -> KeyboardShortcut {
    KeyboardShortcut::new(Modifiers::CTRL.plus(Modifiers::SHIFT), key)
}

const fn alt(key: Key) -> KeyboardShortcut {
    KeyboardShortcut::new(Modifiers::ALT, key)
}

const fn alt_shift(key: Key) -> KeyboardShortcut {
    KeyboardShortcut::new(Modifiers::ALT.plus(Modifiers::SHIFT), key)
}

const fn ctrl_alt(key: Key) -> KeyboardShortcut {
    KeyboardShortcut::new(Modifiers::CTRL.plus(Modifiers::ALT), key)
}

/// The arrows nudge with Alt, as without it they go through frames.
fn nudge(nudge: Nudge) -> KeyboardShortcut {
    let key = match nudge.to {
        Side::Left => Key::ArrowLeft,
        Side::Right => Key::ArrowRight,
        Side::Away => Key::ArrowUp,
        Side::Near => Key::ArrowDown,
    };
    if nudge.is_fine { alt_shift(key) } else { alt(key) }
}

/// The row of digits. Windows cannot tell the number pad from it, so views have Alt.
const DIGITS: [Key; 9] = [
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

impl UiCommand {
    /// Its keys, the usual one first.
    pub fn shortcuts(self) -> Vec<KeyboardShortcut> {
        match self {
            Self::New => vec![ctrl(Key::N)],
            Self::Open => vec![ctrl(Key::O)],
            Self::Recent(_) => Vec::new(),
            Self::Sample(_) => Vec::new(),
            Self::Import => vec![ctrl(Key::I)],
            Self::ImportFolder => vec![ctrl_shift(Key::I)],
            Self::Export => vec![ctrl(Key::E)],
            Self::ExportAgain => vec![ctrl(Key::R)],
            Self::Save => vec![ctrl(Key::S)],
            Self::SaveAs => vec![ctrl_shift(Key::S)],
            Self::Quit => vec![ctrl(Key::Q)],

            Self::Undo => vec![ctrl(Key::Z)],
            Self::Redo => vec![ctrl_shift(Key::Z), ctrl(Key::Y)],
            Self::Delete => vec![bare(Key::Delete), bare(Key::X)],
            Self::Duplicate => vec![shift(Key::D)],
            Self::SelectAll => vec![ctrl(Key::A)],
            Self::SelectNone => vec![alt(Key::A)],
            // Some desktops keep Ctrl+Alt+arrows for themselves.
            Self::RetimeBack => vec![ctrl_alt(Key::ArrowLeft), ctrl_shift(Key::ArrowLeft)],
            Self::RetimeAhead => vec![ctrl_alt(Key::ArrowRight), ctrl_shift(Key::ArrowRight)],
            Self::ScaleTimes => vec![bare(Key::S)],
            Self::SelectTool => vec![bare(Key::Q), bare(Key::Escape)],
            Self::CheckpointTool => vec![bare(Key::C)],
            Self::JointTargetTool => vec![bare(Key::T)],
            Self::PoseTool => vec![bare(Key::P)],
            Self::PathTool => vec![bare(Key::D)],
            Self::ObstacleTool => vec![bare(Key::O)],
            Self::ByHandTool => vec![bare(Key::I)],
            Self::AddCheckpoint => vec![shift(Key::A)],
            Self::AddJointTarget => vec![alt(Key::T)],
            Self::AddPose => vec![alt(Key::P)],
            Self::AddStyle | Self::MeetHere => Vec::new(),
            Self::MoveSelection => vec![bare(Key::G)],
            Self::TurnSelection => vec![bare(Key::R)],
            Self::BoxSelect => vec![bare(Key::B)],
            Self::Nudge(by) => vec![nudge(by)],
            Self::TurnLeft => vec![bare(Key::Comma)],
            Self::TurnRight => vec![shift(Key::Comma)],

            Self::PlayPause => vec![bare(Key::Space)],
            Self::PlayBackwards => vec![bare(Key::J)],
            Self::Stop => vec![bare(Key::K)],
            Self::PlayAhead => vec![bare(Key::L)],
            Self::LoopIn => vec![bare(Key::OpenBracket)],
            Self::LoopOut => vec![bare(Key::CloseBracket)],
            // With Shift a backslash is a bar on many keyboards.
            Self::ClearLoop => vec![shift(Key::Backslash), shift(Key::Pipe)],
            Self::Loop => vec![shift(Key::L)],
            Self::Slower => vec![bare(Key::Minus)],
            Self::NormalSpeed => vec![bare(Key::Backslash)],
            Self::Faster => vec![bare(Key::Equals)],
            Self::StepBack => vec![bare(Key::ArrowLeft)],
            Self::StepAhead => vec![bare(Key::ArrowRight)],
            Self::SecondBack => vec![shift(Key::ArrowLeft)],
            Self::SecondAhead => vec![shift(Key::ArrowRight)],
            Self::PreviousStop => vec![bare(Key::ArrowUp)],
            Self::NextStop => vec![bare(Key::ArrowDown)],
            Self::ToStart => vec![ctrl(Key::ArrowLeft)],
            Self::ToEnd => vec![ctrl(Key::ArrowRight), bare(Key::End)],

            Self::FrameSelection => vec![bare(Key::F), bare(Key::Period)],
            Self::FrameAll => vec![bare(Key::Home)],
            Self::ViewFront => vec![alt(Key::Num1)],
            Self::ViewBack => vec![ctrl_alt(Key::Num1)],
            Self::ViewLeft => vec![alt(Key::Num3)],
            Self::ViewRight => vec![ctrl_alt(Key::Num3)],
            Self::ViewPie => vec![bare(Key::Backtick)],
            Self::Fly => vec![shift(Key::Backtick)],
            Self::ViewTop => vec![alt(Key::Num7)],
            Self::ViewThreeQuarter => vec![alt(Key::Num9)],
            Self::Perspective => vec![alt(Key::Num5)],
            Self::Follow => vec![alt(Key::Num0)],
            Self::Trail => Vec::new(),
            Self::JointTrails => Vec::new(),
            Self::Ghosts => vec![bare(Key::H)],
            Self::GhostsAre(_) => Vec::new(),
            Self::ReducedMotion => Vec::new(),
            Self::NextPanel => vec![bare(Key::F6)],
            Self::PreviousPanel => vec![shift(Key::F6)],
            Self::LeftPanel => Vec::new(),
            Self::RightPanel => Vec::new(),
            Self::Timeline => Vec::new(),
            Self::FitTimeline => vec![shift(Key::F)],
            Self::TimelineNearer => vec![alt(Key::Equals)],
            Self::TimelineFarther => vec![alt(Key::Minus)],
            Self::Curves => vec![shift(Key::E)],
            Self::TimeUnit => vec![shift(Key::T)],
            Self::NextCharacter => vec![ctrl(Key::Tab)],
            Self::Theme => Vec::new(),
            Self::Navigation => Vec::new(),
            Self::FullScreen => vec![bare(Key::F11)],
            Self::Settings => vec![ctrl(Key::Comma)],
            Self::Coverage => Vec::new(),
            Self::Log => vec![ctrl_shift(Key::L)],

            Self::ShowTake(n) => {
                let digit = DIGITS.get(usize::from(n).wrapping_sub(1));
                digit.map(|digit| bare(*digit)).into_iter().collect()
            }
            Self::PinTake(n) => {
                let digit = DIGITS.get(usize::from(n).wrapping_sub(1));
                digit.map(|digit| shift(*digit)).into_iter().collect()
            }
            Self::FlipTakes => vec![bare(Key::Tab)],
            Self::ShowBetter => Vec::new(),
            Self::Compare => vec![bare(Key::U)],
            Self::CompareSplit => vec![shift(Key::U)],
            Self::RenameTake => vec![bare(Key::F2)],
            Self::MoreLikeThis => vec![bare(Key::V)],
            Self::LockStretch => vec![bare(Key::Y)],
            Self::PauseSearch => vec![ctrl(Key::Enter)],
            Self::Shake => vec![ctrl_shift(Key::Enter)],
            Self::FollowBest => Vec::new(),

            Self::Guide => Vec::new(),
            Self::Palette => vec![ctrl(Key::P), bare(Key::F3), ctrl(Key::K)],
            Self::ShortcutSheet => vec![bare(Key::F1)],
        }
    }

    /// The usual key.
    pub fn shortcut(self) -> Option<KeyboardShortcut> {
        self.shortcuts().first().copied()
    }
}

/// A key with its modifiers as people write them: `Ctrl+Shift+Z`, `Alt+←`, `[`.
pub fn key_text(shortcut: &KeyboardShortcut) -> String {
    let m = shortcut.modifiers;
    let held = [(m.ctrl || m.command, "Ctrl+"), (m.alt, "Alt+"), (m.shift, "Shift+")];
    let held: String = held.iter().filter(|(is_held, _)| *is_held).map(|(_, text)| *text).collect();
    let key = match shortcut.logical_key {
        Key::ArrowLeft => "←",
        Key::ArrowRight => "→",
        Key::ArrowUp => "↑",
        Key::ArrowDown => "↓",
        Key::OpenBracket => "[",
        Key::CloseBracket => "]",
        Key::Backtick => "`",
        Key::Comma => ",",
        Key::Period => ".",
        Key::Minus => "−",
        Key::Equals => "=",
        Key::Backslash => "\\",
        Key::Pipe => "|",
        Key::Escape => "Esc",
        other => other.name(),
    };
    held + key
}

/// The commands whose keys are pressed now. Nothing while somebody types.
pub fn pressed(ctx: &egui::Context) -> Vec<UiCommand> {
    if ctx.text_edit_focused() {
        return Vec::new();
    }
    // Who goes through the window by Tab means the button that is lit, not the motion.
    let is_on_widget = crate::focus::is_on_widget(ctx);
    let is_of_widget = |shortcut: &KeyboardShortcut| {
        let keys = [Key::Tab, Key::Space, Key::Enter];
        is_on_widget && shortcut.modifiers.is_none() && keys.contains(&shortcut.logical_key)
    };
    let of = |command: UiCommand| command.shortcuts().into_iter().map(move |key| (key, command));
    let mut keys: Vec<_> = UiCommand::all().into_iter().flat_map(of).collect();
    // Shift+→ would also do for →: what asks for more is looked at first.
    keys.sort_by_key(|(shortcut, _)| {
        let m = shortcut.modifiers;
        std::cmp::Reverse(u8::from(m.shift) + u8::from(m.alt) + u8::from(m.ctrl))
    });
    let commands: Vec<UiCommand> = ctx.input_mut(|input| {
        input.events.iter_mut().for_each(digit_again);
        keys.iter()
            .filter(|(shortcut, _)| !is_of_widget(shortcut) && input.consume_shortcut(shortcut))
            .map(|(_, command)| *command)
            .collect()
    });
    if commands.contains(&UiCommand::FlipTakes) {
        // The same key would light the first button.
        ctx.memory_mut(|memory| memory.move_focus(egui::FocusDirection::None));
    }
    commands
}

/// With Shift the row of digits has other letters, another set in every country: what counts is
/// which key it is.
fn digit_again(event: &mut egui::Event) {
    if let egui::Event::Key { key, physical_key: Some(physical), modifiers, .. } = event
        && modifiers.shift
        && DIGITS.contains(physical)
    {
        *key = *physical;
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn no_key_does_two_things() {
        let mut seen: Vec<(KeyboardShortcut, UiCommand)> = Vec::new();
        for command in UiCommand::all() {
            for shortcut in command.shortcuts() {
                let twice = seen.iter().find(|(other, _)| *other == shortcut);
                assert!(twice.is_none(), "{shortcut:?}: {command:?} and {twice:?}");
                seen.push((shortcut, command));
            }
        }
    }
}
