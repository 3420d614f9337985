//! Five steps through the window, each done by the real gesture and by nothing else.

use egui::{
    Align, Align2, Area, Button, Frame, Id, Layout, Order, Rect, RichText, Stroke, Ui, Vec2,
};
use motion_session::ConstraintKind;

use crate::state::EditorState;
use crate::theme;

const WIDTH_PT: f32 = 400.0;

/// A step: what to do, and why.
struct Step {
    title: &'static str,
    about: &'static str,
}

const STEPS: [Step; 5] = [
    Step {
        title: "Drag the ring of an orange checkpoint",
        about: "The motion follows at once. The tip of the arrow turns it.",
    },
    Step {
        title: "Press 1, 2 or 3, or click a take",
        about: "Each is another way to do the same. The search goes on looking for more.",
    },
    Step {
        title: "Press T, and pull the head or a hand to where it must be",
        about: "The target belongs to the frame under the playhead.",
    },
    Step {
        title: "Press P, and click where the body must take that pose",
        about: "The pose is a frame of a clip; the wheel turns it.",
    },
    Step {
        title: "Press Ctrl+E to take the motion with you",
        about: "Every take can be exported, and what was cut from where stands beside it.",
    },
];

/// How far somebody has come.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Guide {
    /// The step that is to be done, if the guide is open.
    step: Option<usize>,
    /// What was when the step began.
    before: Option<Doings>,
}

/// What steps are told by.
#[derive(Clone, Debug, PartialEq)]
struct Doings {
    /// Labels of the history's steps.
    n_moves: usize,
    shown_before: Option<motion_session::document::TakeId>,
    n_joint_targets: usize,
    n_poses: usize,
    n_exports: usize,
}

impl Doings {
    fn of(state: &EditorState) -> Self {
        let count = |is: fn(&ConstraintKind) -> bool| {
            let all = state.session.document().characters().iter().flat_map(|c| &c.constraints);
            all.filter(|constraint| is(&constraint.kind)).count()
        };
        let moves = ["Move", "Turn"];
        let labels = state.session.history().past_labels();
        Self {
            n_moves: labels.filter(|label| moves.iter().any(|m| label.starts_with(m))).count(),
            shown_before: state.shown_before,
            n_joint_targets: count(|kind| matches!(kind, ConstraintKind::Joint { .. })),
            n_poses: count(|kind| matches!(kind, ConstraintKind::Pose { .. })),
            n_exports: state.n_exports,
        }
    }

    /// Whether the step was done between `self` and `now`.
    fn have_done(&self, step: usize, now: &Self) -> bool {
        match step {
            0 => now.n_moves > self.n_moves,
            1 => now.shown_before != self.shown_before,
            2 => now.n_joint_targets > self.n_joint_targets,
            3 => now.n_poses > self.n_poses,
            _ => now.n_exports > self.n_exports,
        }
    }
}

impl Guide {
    /// Begins from the first step, or closes.
    pub fn toggle(&mut self) {
        let step = if self.step.is_some() { None } else { Some(0) };
        *self = Self { step, before: None };
    }

    /// The step that is to be done, from 0.
    pub fn step(&self) -> Option<usize> {
        self.step
    }

    /// Looks whether the step is done, and draws what is to be done in the view's lower edge.
    pub fn ui(&mut self, ui: &Ui, view: Rect, state: &mut EditorState) {
        let Some(step) = self.step else { return };
        let now = Doings::of(state);
        let before = self.before.get_or_insert_with(|| now.clone());
        // A drag has not been until it ends.
        if before.have_done(step, &now) && !state.is_in_gesture() {
            self.go_on(state);
            ui.ctx().request_repaint();
            return;
        }
        let palette = theme::of(ui);
        let frame = Frame::popup(ui.style())
            .fill(palette.raised)
            .stroke(Stroke::new(1.0, palette.accent))
            .inner_margin(12.0)
            .corner_radius(8.0);
        Area::new(Id::unique("guide"))
            .order(Order::Middle)
            .pivot(Align2::CENTER_BOTTOM)
            .fixed_pos(view.center_bottom() - Vec2::new(0.0, 40.0))
            .show(ui.ctx(), |ui| {
                frame.show(ui, |ui| {
                    ui.set_width(WIDTH_PT);
                    self.card_ui(ui, step, state);
                });
            });
    }

    fn card_ui(&mut self, ui: &mut Ui, step: usize, state: &mut EditorState) {
        let palette = theme::of(ui);
        let number = format!("Step {} of {}", step + 1, STEPS.len());
        ui.label(RichText::new(number).font(theme::caption()).color(palette.accent));
        ui.label(RichText::new(STEPS[step].title).font(theme::heading()));
        ui.label(RichText::new(STEPS[step].about).color(palette.faint));
        ui.with_layout(Layout::right_to_left(Align::Center), |ui| {
            if ui.add(Button::new("Skip").fill(palette.hovered)).clicked() {
                self.go_on(state);
            }
            if ui.add(Button::new("Close guide")).clicked() {
                self.step = None;
            }
        });
    }

    fn go_on(&mut self, state: &mut EditorState) {
        self.before = None;
        self.step = self.step.map(|step| step + 1).filter(|step| *step < STEPS.len());
        if self.step.is_none() {
            state.notices.tell("That was everything; F1 shows all keys, Ctrl+P finds commands");
        }
    }
}
