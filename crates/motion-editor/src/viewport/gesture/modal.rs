//! G and R: what is selected follows the pointer without a button held, until it is put down.

use egui::{Key, Pos2, Ui};
use glam::Vec3;
use motion_session::command::Command;

use super::sight::Sight;
use super::snap::{GRID_DEG, GRID_M, snapped};
use crate::state::EditorState;
use crate::state::moving::Moving;

/// What is done to the selection.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Kind {
    /// It is moved.
    Move,
    /// It is turned.
    Turn,
}

/// A move or a turn under way.
#[derive(Clone, Debug)]
pub struct Modal {
    kind: Kind,
    moving: Moving,
    middle_m: Vec3,
    from: Pos2,
    /// The axis that is held to: 0 is X, 1 is Y, 2 is Z.
    axis: Option<usize>,
    typed: String,
}

/// How it goes on.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Next {
    /// It goes on.
    Goes,
    /// It is done.
    Done,
    /// It has not been.
    Cancelled,
}

impl Modal {
    /// Takes up what is selected; nothing where nothing can be moved.
    pub fn begin(kind: Kind, pointer: Pos2, state: &mut EditorState) -> Option<Self> {
        let document = state.session.document();
        let moving = Moving::of_items(document, state.session.selection().items(document));
        let middle_m = Vec3::from_array(moving.middle_m()?.map(|x| x as f32));
        state.begin_gesture(match kind {
            Kind::Move => "Move",
            Kind::Turn => "Turn",
        });
        Some(Self { kind, moving, middle_m, from: pointer, axis: None, typed: String::new() })
    }

    /// Does a key.
    pub fn key(&mut self, key: Key) -> Next {
        match key {
            Key::Escape => return Next::Cancelled,
            Key::Enter => return Next::Done,
            Key::X => self.hold(0),
            Key::Y if self.moving.has_height() => self.hold(1),
            Key::Z => self.hold(2),
            Key::Minus => match self.typed.strip_prefix('-') {
                Some(rest) => self.typed = rest.to_owned(),
                None => self.typed.insert(0, '-'),
            },
            Key::Period | Key::Comma if !self.typed.contains('.') => self.typed.push('.'),
            Key::Backspace => drop(self.typed.pop()),
            other => {
                if let Some(digit) = digit(other) {
                    self.typed.push(digit);
                }
            }
        }
        Next::Goes
    }

    fn hold(&mut self, axis: usize) {
        self.axis = (self.axis != Some(axis)).then_some(axis);
    }

    /// What is typed, as a number.
    fn amount(&self) -> Option<f64> {
        self.typed.parse().ok()
    }

    /// What it does with the pointer at a place.
    pub fn commands(&self, sight: &Sight, pointer: Pos2, is_snapping: bool) -> Vec<Command> {
        match self.kind {
            Kind::Move => self.moving.moved(self.by_m(sight, pointer, is_snapping)),
            Kind::Turn => self.moving.turned(self.by_deg(sight, pointer, is_snapping)),
        }
    }

    fn by_m(&self, sight: &Sight, pointer: Pos2, is_snapping: bool) -> [f64; 3] {
        if let Some(amount) = self.amount() {
            let mut by = [0.0; 3];
            by[self.axis.unwrap_or(0)] = amount;
            return by;
        }
        // What only stands on the floor keeps to it; what is in the air goes in the picture's plane.
        let is_vertical = self.axis == Some(1);
        let on_floor = || {
            let (from, to) = (sight.floor(self.from)?, sight.floor(pointer)?);
            Some([to[0] - from[0], 0.0, to[1] - from[1]])
        };
        let in_picture = || {
            let to_m = sight.dragged(self.middle_m, (self.from, pointer), is_vertical);
            (to_m - self.middle_m).to_array().map(f64::from)
        };
        let by = match self.moving.has_height() && (self.axis.is_none() || is_vertical) {
            true => in_picture(),
            false => on_floor().unwrap_or_default(),
        };
        let held = |axis: usize| self.axis.is_none_or(|held| held == axis);
        [0, 1, 2].map(|axis| if held(axis) { snapped(by[axis], GRID_M, is_snapping) } else { 0.0 })
    }

    fn by_deg(&self, sight: &Sight, pointer: Pos2, is_snapping: bool) -> f64 {
        if let Some(amount) = self.amount() {
            return amount;
        }
        let Some(middle) = sight.place(self.middle_m) else { return 0.0 };
        // Headings grow against the clock as seen from above; the window's y goes down.
        let angle = |at: Pos2| f64::from(-(at - middle).angle());
        let turned = (angle(pointer) - angle(self.from)).to_degrees();
        snapped(turned, GRID_DEG, is_snapping)
    }

    /// What it does, in words.
    pub fn words(&self, sight: &Sight, pointer: Pos2, is_snapping: bool) -> String {
        let typed = if self.typed.is_empty() { "" } else { " (typed)" };
        let what = match self.kind {
            Kind::Move => {
                let [x, y, z] = self.by_m(sight, pointer, is_snapping);
                let height = if self.moving.has_height() {
                    format!(" · y {y:.2} m")
                } else {
                    String::new()
                };
                let held = match self.axis {
                    Some(axis) => format!(" along {}", ["X", "Y", "Z"][axis]),
                    None => String::new(),
                };
                format!("Move{held}: x {x:.2} m{height} · z {z:.2} m")
            }
            Kind::Turn => {
                let deg = self.by_deg(sight, pointer, is_snapping);
                format!("Turn: {deg:.0}°")
            }
        };
        format!("{what}{typed}   Click or Enter: done   Esc: as it was")
    }
}

/// Where the pointer is, or the middle of the view where it is nowhere.
pub fn pointer_in(ui: &Ui, sight: &Sight) -> Pos2 {
    ui.input(|input| input.pointer.latest_pos()).unwrap_or(sight.rect.center())
}

/// The digit that a key types.
fn digit(key: Key) -> Option<char> {
    let mut letters = key.name().chars();
    let first = letters.next().filter(char::is_ascii_digit)?;
    letters.next().is_none().then_some(first)
}
