//! What is selected, brought to other frames.

use motion_session::command::Command;
use motion_session::document::{CharacterIdx, ConstraintRef, ObstacleIdx};
use motion_session::selection::Selectable;

use super::EditorState;
use crate::mark::Mark;
use crate::obstacle_form;
use crate::timeline::retime::{Grab, Part};

impl EditorState {
    /// Frames that the timeline has room for: of the shown motion, and of all that is asked beyond.
    pub fn n_frames_asked(&self) -> usize {
        let last = self.marks.iter().map(|mark| mark.span().1 as usize + 1).max();
        let character = self.session.document().character(self.session.active());
        let length = character.and_then(|character| character.length.as_ref()?.frames);
        let asked = last.unwrap_or_default().max(length.unwrap_or_default() as usize);
        self.n_frames().max(asked)
    }

    /// The selected constraints of the active character, by frame.
    pub fn selected_marks(&self) -> impl Iterator<Item = &Mark> {
        self.marks.iter().filter(|mark| self.is_selected(&mark.at))
    }

    /// What is selected, in the order of selecting.
    pub fn selected_items(&self) -> Vec<Selectable> {
        self.session.selection().items(self.session.document()).cloned().collect()
    }

    /// What puts a checkpoint where the shown motion is at a frame.
    pub fn checkpoint_on_the_way(&self, frame: usize) -> Vec<Command> {
        let Some(card) = self.shown_card() else { return Vec::new() };
        let at = card.actor.root_at_m(frame as f64);
        let cm = |metres: f32| (f64::from(metres) * 100.0).round() / 100.0;
        self.checkpoint_commands(frame as u32, [cm(at.x), cm(at.z)], None)
    }

    /// Selects everything that is asked of the active character.
    pub fn select_all(&mut self) {
        let all: Vec<Selectable> =
            self.marks.iter().map(|mark| Selectable::Constraint(mark.at.clone())).collect();
        self.session.selection_mut().select_all(all);
    }

    /// Brings what is selected so many frames on, or back, as one step.
    pub fn retime_selected(&mut self, by: i64) {
        let Some(first) = self.selected_marks().next().map(|mark| mark.at.clone()) else { return };
        let is_selected = |mark: &Mark| self.is_selected(&mark.at);
        let Some(grab) = Grab::new(&self.marks, is_selected, &first, Part::Whole) else { return };
        let commands = self.retime_commands(&grab, by, false);
        if !commands.is_empty() {
            self.apply_all("Retime", &commands);
        }
    }

    /// What brings held marks so many frames on; the motion gets as long as it must be.
    pub fn retime_commands(&self, grab: &Grab, by: i64, is_rippling: bool) -> Vec<Command> {
        let mut commands = grab.commands(by, is_rippling);
        if by > 0 {
            let last = grab.last_frame(by, is_rippling);
            commands.extend(last.and_then(|frame| self.length_for(frame)));
        }
        commands
    }

    /// The same once more: what begins first at the playhead, the rest as far behind as it was.
    /// The copies are selected.
    pub fn duplicate_selected(&mut self) {
        let Some(first) = self.selected_marks().map(Mark::frame).min() else {
            self.duplicate_obstacles();
            return;
        };
        let now = self.frame_number();
        let copy = |mark: &Mark| Command::Duplicate {
            at: mark.at.clone(),
            frame: (now + mark.frame() - first) as u32,
        };
        let mut commands: Vec<Command> = self.selected_marks().map(copy).collect();
        let last = self.selected_marks().map(|mark| mark.span().1).max().unwrap_or_default();
        let shifted = (now + last as usize).saturating_sub(first);
        commands.extend(self.length_for(shifted as u32));
        let known: Vec<ConstraintRef> = self.marks.iter().map(|mark| mark.at.clone()).collect();
        if self.apply_all("Duplicate", &commands) {
            let is_new = |mark: &&Mark| !known.contains(&mark.at);
            let new =
                self.marks.iter().filter(is_new).map(|m| Selectable::Constraint(m.at.clone()));
            let new: Vec<Selectable> = new.collect();
            self.session.selection_mut().select_all(new);
        }
    }

    /// The selected obstacles once more, beside themselves. The copies are selected.
    fn duplicate_obstacles(&mut self) {
        const BESIDE_M: f64 = 0.25;
        let document = self.session.document();
        let n_before = document.obstacles().len();
        let copy = |item: &Selectable| match item {
            Selectable::Obstacle(obstacle) => {
                let shape = &document.obstacle(*obstacle)?.shape;
                let [x, y, z] = obstacle_form::center_m(shape);
                let [width, _] = obstacle_form::floor_m(shape);
                let shape = obstacle_form::at(shape, [x + width + BESIDE_M, y, z]);
                Some(Command::AddObstacle { shape })
            }
            _ => None,
        };
        let items = self.selected_items();
        let commands: Vec<Command> = items.iter().filter_map(copy).collect();
        if !commands.is_empty() && self.apply_all("Duplicate", &commands) {
            let new = n_before..n_before + commands.len();
            let new = new.map(|nth| Selectable::Obstacle(ObstacleIdx(nth)));
            self.session.selection_mut().select_all(new);
        }
    }

    /// Shows a character's takes and constraints from now on.
    pub fn activate(&mut self, character: CharacterIdx) {
        self.session.set_active(character);
        self.refresh();
    }
}
