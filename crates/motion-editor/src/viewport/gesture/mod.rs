//! What the mouse and keys do to the project in the view: a tool a file.

pub mod box_select;
pub mod by_hand;
pub mod carry;
pub mod joint;
pub mod modal;
pub mod pose;
pub mod retime;
pub mod sight;
pub mod snap;
pub mod wheel;

use egui::{Align2, CursorIcon, Event, Key, PointerButton, Pos2, Rect, Response, Ui};
use glam::Mat4;
use motion_session::command::Command;
use motion_session::document::ConstraintRef;
use motion_session::selection::Selectable;
use motion_session::stage::pick::PickTarget;

use crate::settings::{Navigation, Tool};
use crate::state::EditorState;
use crate::state::moving::rounded;
use crate::theme;
use by_hand::HandPull;
use carry::Carry;
use joint::{AimedJoint, Pull};
use modal::{Kind, Modal, Next};
use pose::{PoseAim, PoseDrag};
use retime::Retime;
use sight::Sight;
use snap::{GRID_M, heading_deg, snapped};

/// A drag begins when the pointer has gone so far, points: a click moves nothing.
const DRAG_PT: f32 = 6.0;

/// What mouse and keys are doing to the project.
#[derive(Debug, Default)]
pub struct Gesture {
    doing: Doing,
    /// The joint under the pointer, while the tool is out.
    joint: Option<AimedJoint>,
    /// The pose in the hand, while the tool is out and the pointer over the view.
    pose: PoseAim,
    is_posing: bool,
    retime: Option<Retime>,
    /// Whether the next drag draws a box.
    box_is_due: bool,
    /// Keys for what is under way.
    keys: Vec<Key>,
}

#[derive(Clone, Debug, Default)]
#[expect(clippy::large_enum_variant, reason = "there is one of it")]
enum Doing {
    #[default]
    Nothing,
    /// The button went down on something, and nothing has moved.
    Pressed(Pos2, Grab),
    /// Marks go with the pointer.
    Carry(Carry),
    /// An arrow is turned towards the pointer.
    Turn(ConstraintRef),
    /// A new checkpoint stands where the button went down, for this frame.
    Add([f64; 2], u32),
    /// A joint target is pulled.
    Pull(Pull),
    /// Something of the shown take is changed by hand.
    ByHand(Box<HandPull>),
    /// A pose stands where the button went down.
    Pose(Pos2),
    /// A box is drawn.
    Box(Pos2),
    /// What is selected follows the pointer.
    Modal(Modal),
    /// It is over, but the button is still down.
    Spent,
}

/// What a press was on.
#[derive(Clone, Debug)]
enum Grab {
    Mark(ConstraintRef, bool),
    Tip(ConstraintRef),
    Target(ConstraintRef),
    Joint(AimedJoint),
    ByHand(AimedJoint),
}

/// What of the mouse is not the camera's.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Claim {
    /// The left button.
    pub button: bool,
    /// The wheel.
    pub wheel: bool,
    /// A click, which selects nothing then.
    pub click: bool,
}

impl Gesture {
    /// Begins a move or a turn of what is selected, which goes on without a button held.
    pub fn begin_modal(&mut self, kind: Kind, pointer: Pos2, state: &mut EditorState) {
        if matches!(self.doing, Doing::Nothing)
            && let Some(modal) = Modal::begin(kind, pointer, state)
        {
            self.doing = Doing::Modal(modal);
        }
    }

    /// Has the next drag draw a box.
    pub fn begin_box(&mut self) {
        self.box_is_due = true;
    }

    /// Takes the keys that mean what is under way, before they mean anything else.
    pub fn take_keys(&mut self, ctx: &egui::Context, state: &mut EditorState) {
        let is_modal = matches!(self.doing, Doing::Modal(_));
        let is_pulling = matches!(self.doing, Doing::Pull(_) | Doing::ByHand(_));
        let is_posing = self.is_posing && state.settings.tool == Tool::Pose;
        if !is_modal && !is_pulling && !is_posing && !self.box_is_due {
            return;
        }
        let mut taken = Vec::new();
        ctx.input_mut(|input| {
            input.events.retain(|event| {
                let Event::Key { key, pressed, modifiers, .. } = event else { return true };
                let is_mine = match key {
                    _ if is_modal => !modifiers.command,
                    Key::X | Key::Y | Key::Z if is_pulling => !modifiers.command,
                    Key::R | Key::OpenBracket | Key::CloseBracket if is_posing => {
                        !modifiers.command && !modifiers.alt
                    }
                    Key::Escape => self.box_is_due,
                    _ => false,
                };
                if is_mine && *pressed {
                    taken.push((*key, modifiers.shift));
                }
                !is_mine
            });
        });
        for (key, is_shifted) in taken {
            if is_modal {
                self.keys.push(key);
            } else if self.box_is_due && key == Key::Escape {
                self.box_is_due = false;
            } else if is_posing {
                self.pose.key(key, is_shifted, state);
            }
        }
    }

    /// Follows the mouse over the view. `taken` is where other things lie over it.
    pub fn ui(
        &mut self,
        ui: &Ui,
        response: &Response,
        sight: &Sight,
        taken: &[Rect],
        state: &mut EditorState,
    ) -> Claim {
        let pointer = modal::pointer_in(ui, sight);
        let is_over =
            response.contains_pointer() && taken.iter().all(|rect| !rect.contains(pointer));
        let mouse = Mouse::of(ui, pointer, is_over);
        let doing = std::mem::take(&mut self.doing);
        if let Doing::Modal(modal) = doing {
            self.doing = self.modal_ui(sight, &mouse, modal, state);
            return Claim { button: true, wheel: false, click: true };
        }
        self.aim_ui(ui, sight, &mouse, state);
        let mut claim = Claim { wheel: self.is_posing, button: false, click: false };
        let is_retiming = is_over && !self.is_posing;
        claim.wheel |= retime::retime_ui(ui, &mut self.retime, is_retiming, state);
        let doing = match doing {
            Doing::Nothing if mouse.is_pressed => self.press(sight, &mouse, state),
            doing => doing,
        };
        let was_tool = state.settings.tool != Tool::Select || self.box_is_due;
        claim.button = !matches!(doing, Doing::Nothing)
            || (was_tool && response.dragged_by(PointerButton::Primary));
        claim.click = !matches!(doing, Doing::Nothing | Doing::Pressed(..));
        self.doing = self.follow(doing, sight, &mouse, state);
        cursor_ui(ui, is_over, self.box_is_due, state);
        claim
    }

    /// Has the tools that show what they would do say it.
    fn aim_ui(&mut self, ui: &Ui, sight: &Sight, mouse: &Mouse, state: &mut EditorState) {
        let is_free = matches!(self.doing, Doing::Nothing);
        self.joint = match state.settings.tool {
            Tool::JointTarget if mouse.is_over && is_free && !is_target(state.hovered) => {
                joint::aim(state, sight, mouse.at)
            }
            Tool::ByHand if mouse.is_over && is_free => joint::aim(state, sight, mouse.at),
            _ => None,
        };
        self.is_posing = state.settings.tool == Tool::Pose && mouse.is_over;
        if self.is_posing {
            // While the button is down it stays, and looks towards the pointer, unless it is still
            // on its way from the library.
            let stays = mouse.is_down && !PoseDrag::is_under_way(ui);
            let floor_m = sight.floor(mouse.at).filter(|_| !stays);
            self.pose.ui(ui, floor_m, mouse.is_snapping, state);
            if PoseDrag::is_dropped(ui) {
                self.pose.put_down(state);
                state.settings.tool = Tool::Select;
            }
        }
    }

    /// What a press begins; nothing where it means the camera.
    fn press(&mut self, sight: &Sight, mouse: &Mouse, state: &mut EditorState) -> Doing {
        let is_industry = state.settings.navigation == Navigation::Industry;
        if mouse.has_alt && is_industry {
            return Doing::Nothing;
        }
        if std::mem::take(&mut self.box_is_due) {
            return Doing::Box(mouse.at);
        }
        if let (Tool::ByHand, Some(joint)) = (state.settings.tool, &self.joint) {
            return Doing::Pressed(mouse.at, Grab::ByHand(joint.clone()));
        }
        // Alt is the camera's in the one scheme; Ctrl does the same there.
        let is_copy = if is_industry { mouse.has_ctrl } else { mouse.has_alt };
        let tool = state.settings.tool;
        let constraint = state.hovered.and_then(|target| match state.selectable_of(target)? {
            Selectable::Constraint(at) => Some((target, at)),
            _ => None,
        });
        if let Some((target, at)) = constraint {
            match target {
                PickTarget::CheckpointTip { .. } if !is_copy => {
                    return Doing::Pressed(mouse.at, Grab::Tip(at));
                }
                PickTarget::JointTarget { .. } if !is_copy => {
                    return Doing::Pressed(mouse.at, Grab::Target(at));
                }
                PickTarget::Pose { .. } if tool == Tool::Pose => {}
                PickTarget::Actor { .. }
                | PickTarget::Ghost { .. }
                | PickTarget::Obstacle { .. } => {}
                _ => return Doing::Pressed(mouse.at, Grab::Mark(at, is_copy)),
            }
        }
        let floor_m = sight.floor(mouse.at);
        match (tool, floor_m) {
            (Tool::Checkpoint, Some(floor_m)) => {
                state.begin_gesture("Add checkpoint");
                Doing::Add(floor_m, state.frame_number() as u32)
            }
            (Tool::Pose, Some(_)) => Doing::Pose(mouse.at),
            (Tool::JointTarget, _) => match self.joint.clone() {
                Some(joint) => Doing::Pressed(mouse.at, Grab::Joint(joint)),
                None => Doing::Nothing,
            },
            _ => Doing::Nothing,
        }
    }

    /// Goes on with what is under way, or ends it.
    fn follow(
        &mut self,
        doing: Doing,
        sight: &Sight,
        mouse: &Mouse,
        state: &mut EditorState,
    ) -> Doing {
        let (doing, began) = match doing {
            Doing::Pressed(from, grab) if mouse.is_down && from.distance(mouse.at) > DRAG_PT => {
                (grab.begin(from, sight, state), true)
            }
            doing => (doing, false),
        };
        let is_edit = matches!(
            doing,
            Doing::Carry(_) | Doing::Turn(_) | Doing::Add(..) | Doing::Pull(_) | Doing::ByHand(_)
        );
        if is_edit && !state.is_in_gesture() {
            // Escape has ended it.
            return if mouse.is_down { Doing::Spent } else { Doing::Nothing };
        }
        if mouse.is_down {
            if is_edit && (mouse.has_moved || mouse.is_pressed || began) {
                let commands = doing.commands(sight, mouse, state);
                if !commands.is_empty() {
                    state.preview(&commands);
                }
            }
            if let Doing::Pose(from) = doing
                && from.distance(mouse.at) > DRAG_PT
                && let Some(floor_m) = sight.floor(mouse.at)
            {
                self.pose.look_at(floor_m, mouse.is_snapping);
            }
            return doing;
        }
        match doing {
            Doing::Box(from) => {
                let rect = Rect::from_two_pos(from, mouse.at);
                box_select::select_in(rect, sight, mouse.is_snapping, state);
            }
            Doing::Pose(_) => self.pose.put_down(state),
            _ if is_edit => {
                let is_new = doing.is_new();
                state.commit();
                if is_new {
                    state.select_newest();
                }
            }
            _ => {}
        }
        Doing::Nothing
    }

    fn modal_ui(
        &mut self,
        sight: &Sight,
        mouse: &Mouse,
        mut modal: Modal,
        state: &mut EditorState,
    ) -> Doing {
        if !state.is_in_gesture() {
            return Doing::Nothing;
        }
        let keys = std::mem::take(&mut self.keys);
        let mut next = Next::Goes;
        for key in &keys {
            if next == Next::Goes {
                next = modal.key(*key);
            }
        }
        if mouse.is_right_pressed {
            next = Next::Cancelled;
        } else if mouse.is_pressed && next == Next::Goes {
            next = Next::Done;
        }
        if next == Next::Cancelled {
            state.cancel();
        } else {
            if mouse.has_moved || !keys.is_empty() {
                state.preview(&modal.commands(sight, mouse.at, mouse.is_snapping));
            }
            if next == Next::Goes {
                return Doing::Modal(modal);
            }
            state.commit();
        }
        // The button that ended it comes up yet.
        if mouse.is_down { Doing::Spent } else { Doing::Nothing }
    }

    /// The body that the pose tool would put down.
    pub fn ghost(&self, state: &EditorState) -> Option<Vec<Mat4>> {
        self.is_posing.then(|| self.pose.ghost(state)).flatten()
    }

    /// What is seen over the picture while a tool is at work.
    pub fn overlay_ui(&self, ui: &Ui, sight: &Sight, state: &EditorState) {
        let pointer = modal::pointer_in(ui, sight);
        let is_snapping = ui.input(|input| input.modifiers.shift);
        if state.settings.tool == Tool::ByHand {
            by_hand::handles_ui(ui, sight, state);
        }
        if let Some(joint) = &self.joint {
            joint::aimed_ui(ui, joint);
        }
        let words = match &self.doing {
            Doing::Modal(modal) => Some(modal.words(sight, pointer, is_snapping)),
            Doing::Box(from) => {
                box_select::box_ui(ui, *from, pointer);
                None
            }
            _ if self.box_is_due => Some("Drag a box   Esc: as it was".to_owned()),
            _ if self.is_posing => self.pose.words(state).map(|words| {
                format!("{words}   Click: put it there   R, wheel: turn   [ ]: frame of the clip")
            }),
            _ => None,
        };
        if let Some(words) = words {
            let at = sight.rect.center_top() + egui::Vec2::Y * 28.0;
            plate_ui(ui, at, Align2::CENTER_CENTER, &words);
        }
    }
}

impl Grab {
    /// What a drag of it is.
    fn begin(self, from: Pos2, sight: &Sight, state: &mut EditorState) -> Doing {
        let begun = match self {
            Self::Mark(at, is_copy) => sight
                .floor(from)
                .and_then(|floor_m| Carry::begin(&at, floor_m, is_copy, state))
                .map(Doing::Carry),
            Self::Tip(at) => {
                if !state.is_selected(&at) {
                    let selection = state.session.selection_mut();
                    selection.select(Selectable::Constraint(at.clone()));
                }
                state.begin_gesture("Turn checkpoint");
                Some(Doing::Turn(at))
            }
            Self::Target(at) => Pull::known(&at, from, state).map(Doing::Pull),
            Self::Joint(joint) => Some(Doing::Pull(Pull::new(joint, from, state))),
            Self::ByHand(joint) => {
                HandPull::begin(&joint, from, state).map(|pull| Doing::ByHand(Box::new(pull)))
            }
        };
        begun.unwrap_or(Doing::Spent)
    }
}

impl Doing {
    /// What it does with the pointer where it is.
    fn commands(&self, sight: &Sight, mouse: &Mouse, state: &EditorState) -> Vec<Command> {
        let is_snapping = mouse.is_snapping;
        let floor_m = sight.floor(mouse.at);
        match self {
            Self::Carry(carry) => floor_m
                .map(|floor_m| carry.commands(floor_m, is_snapping, state))
                .unwrap_or_default(),
            Self::Turn(at) => {
                let heading = state
                    .place_of(at)
                    .zip(floor_m)
                    .and_then(|(from, to)| heading_deg(from, to, is_snapping));
                let turn = |deg| Command::Turn { at: at.clone(), heading_deg: Some(deg) };
                heading.map(turn).into_iter().collect()
            }
            Self::Add(from, frame) => {
                let position_m = from.map(|axis| rounded(snapped(axis, GRID_M, is_snapping)));
                let heading = floor_m.and_then(|to| heading_deg(position_m, to, is_snapping));
                state.checkpoint_commands(*frame, position_m, heading)
            }
            Self::ByHand(pull) => pull.commands(sight, mouse.at, mouse.is_lifting),
            Self::Pull(pull) => {
                pull.commands(sight, mouse.at, mouse.is_lifting, is_snapping, state)
            }
            _ => Vec::new(),
        }
    }

    /// Whether it makes something that is to be selected.
    fn is_new(&self) -> bool {
        match self {
            Self::Add(..) => true,
            Self::Carry(carry) => carry.is_copy(),
            Self::Pull(pull) => pull.is_new(),
            _ => false,
        }
    }
}

/// The mouse and the keys held with it, in this frame.
#[derive(Clone, Copy, Debug)]
struct Mouse {
    at: Pos2,
    is_over: bool,
    is_pressed: bool,
    is_right_pressed: bool,
    is_down: bool,
    has_moved: bool,
    is_snapping: bool,
    has_alt: bool,
    has_ctrl: bool,
    is_lifting: bool,
}

impl Mouse {
    fn of(ui: &Ui, at: Pos2, is_over: bool) -> Self {
        ui.input(|input| Self {
            at,
            is_over,
            is_pressed: is_over && input.pointer.button_pressed(PointerButton::Primary),
            is_right_pressed: input.pointer.button_pressed(PointerButton::Secondary),
            is_down: input.pointer.primary_down(),
            has_moved: input.pointer.delta() != egui::Vec2::ZERO,
            is_snapping: input.modifiers.shift,
            has_alt: input.modifiers.alt,
            has_ctrl: input.modifiers.ctrl,
            is_lifting: input.key_down(Key::Z) || input.key_down(Key::Y),
        })
    }
}

fn is_target(target: Option<PickTarget>) -> bool {
    matches!(target, Some(PickTarget::JointTarget { .. }))
}

/// Words on a plate over the picture.
pub fn plate_ui(ui: &Ui, at: Pos2, align: Align2, words: &str) {
    let palette = theme::of(ui);
    let galley =
        ui.fonts_mut(|fonts| fonts.layout_no_wrap(words.to_owned(), theme::body(), palette.text));
    let rect = align.anchor_size(at, galley.size());
    let plate = rect.expand2(egui::Vec2::new(8.0, 4.0));
    ui.painter().rect_filled(plate, f32::from(theme::RADIUS), palette.panel.gamma_multiply(0.9));
    ui.painter().galley(rect.min, galley, palette.text);
}

fn cursor_ui(ui: &Ui, is_over: bool, box_is_due: bool, state: &EditorState) {
    if !is_over {
        return;
    }
    let icon = match (state.settings.tool, state.hovered) {
        _ if box_is_due => CursorIcon::Crosshair,
        (Tool::Select | Tool::Checkpoint, Some(PickTarget::CheckpointTip { .. })) => {
            CursorIcon::Grab
        }
        (
            Tool::Select | Tool::Checkpoint,
            Some(PickTarget::Checkpoint { .. } | PickTarget::Pose { .. }),
        )
        | (_, Some(PickTarget::JointTarget { .. })) => CursorIcon::Move,
        (Tool::ByHand, _) => CursorIcon::Grab,
        (Tool::Checkpoint | Tool::JointTarget | Tool::Pose, _) => CursorIcon::Crosshair,
        _ => return,
    };
    ui.ctx().set_cursor_icon(icon);
}
