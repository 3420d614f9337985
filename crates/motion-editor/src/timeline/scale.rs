//! Times of what is selected, drawn out or together about the playhead: S, then the pointer or a
//! number.

use egui::{Align2, Context, Event, Key, PointerButton, Pos2, Rect, Stroke, Ui};
use motion_session::command::Command;
use motion_session::document::ConstraintRef;

use super::axis::Axis;
use super::retime::is_stretch;
use crate::mark::Mark;
use crate::settings::Tool;
use crate::state::EditorState;
use crate::theme;
use crate::viewport::gesture::plate_ui;

/// Times are not drawn together further than this.
const LEAST: f64 = 0.05;
/// Nearer to the playhead than this the pointer says too little, points; it counts from there.
const LEAST_ARM_PT: f32 = 40.0;

/// A scaling under way.
#[derive(Clone, Debug, PartialEq)]
pub struct Scale {
    held: Vec<Held>,
    about: f64,
    /// Where the pointer was when it began.
    from_x: Option<f32>,
    typed: String,
    keys: Vec<Key>,
}

#[derive(Clone, Debug, PartialEq)]
struct Held {
    at: ConstraintRef,
    span: (u32, u32),
    is_stretch: bool,
}

impl Scale {
    /// Takes hold of what is selected; nothing where that has no times. What begins the motion
    /// stays.
    pub fn begin(state: &mut EditorState) -> Option<Self> {
        let is_start = |mark: &&Mark| mark.frame() == 0 && mark.body().is_some();
        let held = state.selected_marks().filter(|mark| !is_start(mark)).map(|mark| Held {
            at: mark.at.clone(),
            span: mark.span(),
            is_stretch: is_stretch(&mark.constraint.kind),
        });
        let held: Vec<Held> = held.collect();
        if held.is_empty() {
            return None;
        }
        // The click that ends it must not be another tool's.
        state.settings.tool = Tool::Select;
        let about = state.frame_number() as f64;
        state.begin_gesture("Scale times");
        Some(Self { held, about, from_x: None, typed: String::new(), keys: Vec::new() })
    }

    /// Takes keys before they mean anything else.
    pub fn take_keys(&mut self, ctx: &Context) {
        ctx.input_mut(|input| {
            input.events.retain(|event| {
                let Event::Key { key, pressed, modifiers, .. } = event else { return true };
                if *pressed && !modifiers.command {
                    self.keys.push(*key);
                }
                modifiers.command
            });
        });
    }

    /// Goes on with it. Gives it back while it lasts.
    pub fn ui(
        mut self,
        ui: &Ui,
        axis: &Axis,
        lanes: Rect,
        state: &mut EditorState,
    ) -> Option<Self> {
        if !state.is_in_gesture() {
            return None;
        }
        let (pointer, is_done, is_cancelled) = ui.input(|input| {
            let pressed = |button| input.pointer.button_pressed(button);
            let pointer = input.pointer.latest_pos();
            (pointer, pressed(PointerButton::Primary), pressed(PointerButton::Secondary))
        });
        let keys = std::mem::take(&mut self.keys);
        if is_cancelled || keys.contains(&Key::Escape) {
            state.cancel();
            return None;
        }
        keys.iter().for_each(|key| self.key(*key));
        let x = pointer.map_or(lanes.center().x, |at| at.x);
        self.from_x.get_or_insert(x);
        let factor = self.factor(x, axis);
        state.preview(&self.commands(factor, state));
        if is_done || keys.contains(&Key::Enter) {
            state.commit();
            return None;
        }
        let palette = theme::of(ui);
        let about_x = axis.x_of(self.about);
        if lanes.x_range().contains(about_x) {
            ui.painter().vline(about_x, lanes.y_range(), Stroke::new(2.0, palette.accent));
        }
        let typed = if self.typed.is_empty() { "" } else { " (typed)" };
        let words = format!(
            "Times × {factor:.2} about f {:.0}{typed}   Click or Enter: done   Esc: as it was",
            self.about
        );
        let at = Pos2::new(lanes.center().x, lanes.bottom() - 20.0);
        plate_ui(ui, at, Align2::CENTER_CENTER, &words);
        ui.ctx().request_repaint();
        Some(self)
    }

    fn key(&mut self, key: Key) {
        match key {
            Key::Period | Key::Comma if !self.typed.contains('.') => self.typed.push('.'),
            Key::Backspace => drop(self.typed.pop()),
            other => {
                let mut letters = other.name().chars();
                if let (Some(digit @ '0'..='9'), None) = (letters.next(), letters.next()) {
                    self.typed.push(digit);
                }
            }
        }
    }

    /// What times are multiplied by, with the pointer at a place.
    fn factor(&self, x: f32, axis: &Axis) -> f64 {
        let typed = self.typed.parse().ok();
        let pointed = || {
            let from_x = self.from_x.unwrap_or(x);
            let arm = from_x - axis.x_of(self.about);
            let arm = if arm < 0.0 { arm.min(-LEAST_ARM_PT) } else { arm.max(LEAST_ARM_PT) };
            f64::from(1.0 + (x - from_x) / arm)
        };
        typed.unwrap_or_else(pointed).clamp(LEAST, 100.0)
    }

    /// What brings everything to its new time, in an order in which nothing gets in another's way.
    fn commands(&self, factor: f64, state: &EditorState) -> Vec<Command> {
        let scaled = |frame: u32| {
            let frame = self.about + (f64::from(frame) - self.about) * factor;
            frame.round().clamp(0.0, 999_999.0) as u32
        };
        let mut moves: Vec<(&Held, (u32, u32))> = self
            .held
            .iter()
            .map(|held| (held, (scaled(held.span.0), scaled(held.span.1))))
            .collect();
        // Those that go on, the last first; then those that go back, the first first.
        moves.sort_by_key(|(held, to)| {
            let (from, goes_on) = (i64::from(held.span.0), to.0 > held.span.0);
            (!goes_on, if goes_on { -from } else { from })
        });
        let last = moves.iter().map(|(_, to)| to.1).max().unwrap_or_default();
        let mut commands: Vec<Command> = state.length_for(last).into_iter().collect();
        commands.extend(moves.into_iter().filter(|(held, to)| held.span != *to).map(
            |(held, (from, to))| {
                let at = held.at.clone();
                if held.is_stretch {
                    Command::RetimeSpan { at, from, to }
                } else {
                    Command::Retime { at, frame: from }
                }
            },
        ));
        commands
    }
}
