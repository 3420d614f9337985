//! What was asked for while the timeline was drawn, done.

use egui::Ui;
use motion_session::command::Command;
use motion_session::selection::Selectable;

use super::TimelinePanel;
use super::action::Action;
use super::drag::Drag;
use super::hand_drag::HandGrab;
use super::retime::Grab;
use crate::mark::Mark;
use crate::state::EditorState;

impl TimelinePanel {
    /// Says what is pointed at, so that the view lights it up too.
    pub(super) fn hover(&mut self, actions: &[Action], state: &mut EditorState) {
        let at = actions.iter().find_map(|action| match action {
            Action::Hover(at) => Some(at.clone()),
            _ => None,
        });
        if at.is_none() && !self.is_pointing {
            return;
        }
        self.is_pointing = at.is_some();
        state.hovered = at.as_ref().and_then(|at| state.pick_target_of(at));
        state.session.selection_mut().hover(at.map(Selectable::Constraint));
    }

    /// The moment at which the button went down.
    fn press_at(&self, ui: &Ui) -> f64 {
        let at = ui.input(|input| input.pointer.press_origin());
        at.and_then(|at| self.frame_at(at.x)).unwrap_or_default()
    }

    pub(super) fn do_all(&mut self, ui: &Ui, actions: Vec<Action>, state: &mut EditorState) {
        for action in actions {
            match action {
                Action::Hover(_) => {}
                Action::Select(at, is_adding) => {
                    let frame = state.marks.iter().find(|m| m.at == at).map(|m| m.frame());
                    let selection = state.session.selection_mut();
                    let item = Selectable::Constraint(at);
                    if is_adding {
                        selection.toggle(item);
                    } else {
                        selection.select(item);
                        frame.into_iter().for_each(|frame| state.stop_at(frame));
                    }
                }
                Action::Grab(at, part) => {
                    if !state.is_selected(&at) {
                        let item = Selectable::Constraint(at.clone());
                        state.session.selection_mut().select(item);
                    }
                    let is_selected = |mark: &Mark| state.is_selected(&mark.at);
                    let grab = Grab::new(&state.marks, is_selected, &at, part);
                    let press = self.press_at(ui);
                    self.drag = grab.map(|grab| Drag::retime(grab, press, state));
                }
                Action::DrawStyle => {
                    let from = self.press_at(ui);
                    state.begin_gesture("Add style");
                    self.drag = Some(Drag::Style(from.max(0.0)));
                }
                Action::SelectMeeting(id) => {
                    let frame = state.session.document().interaction(&id).map(|i| i.frame);
                    state.session.selection_mut().select(Selectable::Interaction(id));
                    frame.into_iter().for_each(|frame| state.stop_at(frame as usize));
                }
                Action::GrabMeeting(id) => {
                    let known = state.session.document().interaction(&id).cloned();
                    if let Some(known) = known {
                        let off = self.press_at(ui) - f64::from(known.frame);
                        state.session.selection_mut().select(Selectable::Interaction(id));
                        state.begin_gesture("Retime");
                        self.drag = Some(Drag::Meeting(Box::new(known), off, false));
                    }
                }
                Action::SelectHand(id) => state.select_edit(id),
                Action::GrabHand(id, part) => {
                    let grab = HandGrab::new(&id, part, self.press_at(ui), state);
                    self.drag = grab.map(|grab| Drag::ByHand(Box::new(grab)));
                }
                Action::RemoveHand(id) => state.remove_hand_edit(&id),
                Action::GrabLength => self.drag = Some(Drag::length(state)),
                Action::GrabLoop(part) => {
                    let from = self.press_at(ui);
                    self.drag = state
                        .chosen_range()
                        .map(|range| Drag::Loop(part, range, from - f64::from(range.from)));
                    state.is_dragging_beside = true;
                }
                Action::Scrub => {
                    self.drag = Some(Drag::Scrub(state.frame()));
                    state.is_dragging_beside = true;
                }
                Action::GoTo(frame) => state.stop_at(frame),
                Action::Do(commands) => {
                    let label = commands.first().map_or("Change", Command::label);
                    state.apply_all(label, &commands);
                }
                Action::Ask(command) => state.ask(command),
                Action::With(at, command) => {
                    if !state.is_selected(&at) {
                        state.session.selection_mut().select(Selectable::Constraint(at));
                    }
                    state.ask(command);
                }
                Action::Play(range) => state.set_range(range),
                Action::Activate(character) => state.activate(character),
            }
        }
    }
}
