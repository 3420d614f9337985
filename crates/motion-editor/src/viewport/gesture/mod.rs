//! What the mouse and keys do to the project in the view: a tool a file.

pub mod box_select;
pub mod by_hand;
pub mod carry;
mod cursor;
mod doing;
pub mod handle;
pub mod handle_pull;
pub mod joint;
pub mod meeting;
pub mod modal;
mod mouse;
pub mod obstacle;
mod plate;
pub mod pose;
pub mod retime;
pub mod sight;
pub mod snap;
pub mod stroke;
pub mod wheel;

use egui::{Align2, Event, Key, PointerButton, Pos2, Rect, Response, Ui};
use glam::Mat4;
use motion_session::selection::Selectable;
use motion_session::stage::pick::PickTarget;

use crate::settings::{Navigation, Tool};
use crate::state::EditorState;
use cursor::cursor_ui;
use doing::{Doing, Grab, Made};
use handle::Handle;
use handle_pull::HandlePull;
use joint::AimedJoint;
use modal::{Kind, Modal, Next};
use mouse::Mouse;
use obstacle::NewObstacle;
pub use plate::plate_ui;
use pose::{PoseAim, PoseDrag};
use retime::Retime;
use sight::Sight;
use stroke::Stroke;

/// A drag begins when the pointer has gone so far, points: a click moves nothing.
const DRAG_PT: f32 = 6.0;
/// Where time goes with the pointer, a frame takes so many points.
const PT_PER_FRAME: f32 = 4.0;

/// What mouse and keys are doing to the project.
#[derive(Debug, Default)]
pub struct Gesture {
    doing: Doing,
    /// The handle under the pointer.
    handle: Option<Handle>,
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
        let is_pulling = matches!(self.doing, Doing::Pull(_) | Doing::ByHand(_) | Doing::Handle(_));
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
        let notches = if matches!(doing, Doing::Stroke(_)) { wheel::notches(ui).1 } else { 0.0 };
        if notches != 0.0 {
            claim.wheel = true;
            Stroke::wheel(notches, state);
        }
        let doing = match doing {
            Doing::Nothing if mouse.is_pressed => self.press(sight, &mouse, state),
            doing => doing,
        };
        let was_tool = state.settings.tool != Tool::Select || self.box_is_due;
        claim.button = !matches!(doing, Doing::Nothing)
            || (was_tool && response.dragged_by(PointerButton::Primary));
        claim.click = !matches!(doing, Doing::Nothing | Doing::Pressed(..));
        self.doing = self.follow(doing, sight, &mouse, state);
        let has_handle = self.handle.is_some() || matches!(self.doing, Doing::Handle(_));
        cursor_ui(ui, is_over, self.box_is_due, has_handle, state);
        claim
    }

    /// Has the tools that show what they would do say it.
    fn aim_ui(&mut self, ui: &Ui, sight: &Sight, mouse: &Mouse, state: &mut EditorState) {
        let is_free = matches!(self.doing, Doing::Nothing);
        let can_be_held = matches!(state.settings.tool, Tool::Select | Tool::Path | Tool::Obstacle)
            || (state.settings.tool == Tool::JointTarget && is_target_selected(state));
        self.handle = match mouse.is_over && is_free && can_be_held && !self.box_is_due {
            true => handle::nearest(&handle::handles(state, sight), mouse.at).cloned(),
            false => None,
        };
        self.joint = match state.settings.tool {
            Tool::JointTarget
                if mouse.is_over
                    && is_free
                    && self.handle.is_none()
                    && !is_target(state.hovered) =>
            {
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
        if mouse.is_shuttling {
            return Doing::Shuttle(state.frame(), mouse.at);
        }
        if let Some(handle) = &self.handle {
            if !mouse.has_ctrl {
                return Doing::Pressed(mouse.at, Grab::Handle(handle.clone()));
            }
            let without = HandlePull::without(&handle.of, state);
            if let Some(command) = without {
                state.apply(&command);
            }
            return Doing::Spent;
        }
        if let (Tool::ByHand, Some(joint)) = (state.settings.tool, &self.joint) {
            return Doing::Pressed(mouse.at, Grab::ByHand(joint.clone()));
        }
        // Alt is the camera's in the one scheme; Ctrl does the same there.
        let is_copy = if is_industry { mouse.has_ctrl } else { mouse.has_alt };
        let tool = state.settings.tool;
        let pointed = state.hovered.and_then(|target| Some((target, state.selectable_of(target)?)));
        // Who draws a path begins it where the body stands, whatever else is there.
        if let Some((target, item)) = pointed.filter(|_| tool != Tool::Path)
            && let Some(grab) = grab_of(target, item, is_copy, state)
        {
            return Doing::Pressed(mouse.at, grab);
        }
        let floor_m = sight.floor(mouse.at);
        match (tool, floor_m) {
            (Tool::Checkpoint, Some(floor_m)) => {
                state.begin_gesture("Add checkpoint");
                Doing::Add(floor_m, state.frame_number() as u32)
            }
            (Tool::Path, Some(floor_m)) => Doing::Stroke(Stroke::begin(floor_m, state)),
            (Tool::Obstacle, Some(floor_m)) => Doing::Obstacle(NewObstacle::begin(floor_m, state)),
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
        let (mut doing, began) = match doing {
            Doing::Pressed(from, grab) if mouse.is_down && from.distance(mouse.at) > DRAG_PT => {
                (grab.begin(from, sight, state), true)
            }
            doing => (doing, false),
        };
        let is_edit = doing.is_edit();
        if is_edit && !state.is_in_gesture() {
            // Escape has ended it.
            return if mouse.is_down { Doing::Spent } else { Doing::Nothing };
        }
        if mouse.is_down {
            if let (Doing::Stroke(stroke), Some(floor_m)) = (&mut doing, sight.floor(mouse.at)) {
                stroke.go_to(floor_m);
            }
            if is_edit && (mouse.has_moved || mouse.is_pressed || mouse.is_wheeling || began) {
                let commands = doing.commands(sight, mouse, state);
                if !commands.is_empty() {
                    state.preview(&commands);
                }
            }
            if let Doing::Shuttle(frame, from) = doing {
                let by = f64::from((mouse.at.x - from.x) / PT_PER_FRAME);
                let to = (frame + by).round().clamp(0.0, state.last_frame() as f64);
                state.stop_at(to as usize);
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
                let (makes, n_before) = (doing.makes(), state.session.history().n_steps().0);
                state.commit();
                let has_changed = state.session.history().n_steps().0 > n_before;
                match makes {
                    Made::Constraint if has_changed => state.select_newest(),
                    Made::Obstacle if has_changed => state.select_newest_obstacle(),
                    _ => {}
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
        let held = match &self.doing {
            Doing::Handle(pull) => Some(pull.of()),
            _ => self.handle.as_ref().map(|handle| &handle.of),
        };
        handle::handles_ui(ui, &handle::handles(state, sight), held);
        let words = match &self.doing {
            Doing::Modal(modal) => Some(modal.words(sight, pointer, is_snapping)),
            Doing::Box(from) => {
                box_select::box_ui(ui, *from, pointer);
                None
            }
            Doing::Handle(pull) => pull.words(state),
            Doing::Meeting(pull) => pull.words(state),
            Doing::Stroke(stroke) => Some(stroke.words(state)),
            Doing::Obstacle(new) => Some(new.words(sight.floor(pointer), is_snapping)),
            _ if self.box_is_due => Some("Drag a box   Esc: as it was".to_owned()),
            _ if self.is_posing => self.pose.words(state).map(|words| {
                format!("{words}   Click: put it there   R, wheel: turn   [ ]: frame of the clip")
            }),
            Doing::Nothing if self.handle.is_some() => {
                self.handle.as_ref().map(|handle| handle::words(&handle.of).to_owned())
            }
            Doing::Nothing if state.settings.tool == Tool::Obstacle => {
                Some(obstacle::tool_words(state))
            }
            _ => None,
        };
        if let Some(words) = words {
            let at = sight.rect.center_top() + egui::Vec2::Y * 28.0;
            plate_ui(ui, at, Align2::CENTER_CENTER, &words);
        }
    }
}

fn is_target(target: Option<PickTarget>) -> bool {
    matches!(target, Some(PickTarget::JointTarget { .. }))
}

/// Whether a joint target is selected, whose velocity can be pulled.
fn is_target_selected(state: &EditorState) -> bool {
    let kind = |at| Some(state.session.document().constraint(at)?.kind.name());
    matches!(state.selected(), Some(Selectable::Constraint(at)) if kind(at) == Some("joint"))
}

/// What a press on something takes hold of; nothing where the camera has it.
fn grab_of(
    target: PickTarget,
    item: Selectable,
    is_copy: bool,
    state: &EditorState,
) -> Option<Grab> {
    let tool = state.settings.tool;
    match (target, item) {
        (PickTarget::CheckpointTip { .. }, Selectable::Constraint(at)) if !is_copy => {
            Some(Grab::Tip(at))
        }
        (PickTarget::JointTarget { .. }, Selectable::Constraint(at)) if !is_copy => {
            Some(Grab::Target(at))
        }
        (PickTarget::Pose { .. }, _) if tool == Tool::Pose => None,
        (PickTarget::Actor { .. } | PickTarget::Ghost { .. }, _) => None,
        // A wall fills the view: it goes along only where somebody has chosen it before.
        (PickTarget::Obstacle { .. }, item) => {
            let is_meant = tool == Tool::Obstacle || state.session.selection().contains(&item);
            is_meant.then_some(Grab::Item(item, is_copy))
        }
        (PickTarget::Meeting { member, .. }, Selectable::Interaction(id)) => {
            Some(Grab::Meeting(id, member))
        }
        (_, item @ Selectable::Constraint(_)) => Some(Grab::Item(item, is_copy)),
        _ => None,
    }
}
