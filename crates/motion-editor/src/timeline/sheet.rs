//! What all rows are drawn with.

use egui::{Painter, Pos2, Rect, Response, Ui, Vec2};
use motion_session::ConstraintKind;
use motion_session::command::Command;
use motion_session::document::ConstraintRef;

use super::action::Action;
use super::axis::Axis;
use crate::mark::Mark;
use crate::state::EditorState;
use crate::theme::{self, Palette};

/// The timeline while it is drawn. Nothing changes meanwhile: what is asked for is collected.
pub struct Sheet<'a> {
    /// Where it is drawn.
    pub ui: &'a Ui,
    /// What is shown.
    pub state: &'a EditorState,
    /// Where frames are.
    pub axis: Axis,
    /// Colours.
    pub palette: Palette,
    /// What can be seen of the rows.
    pub window: Rect,
    /// What was asked for.
    pub actions: Vec<Action>,
    /// The frame of the shown take whose source is pointed at.
    pub hovered_source: Option<usize>,
    /// Where marks are: their places in [`EditorState::marks`], for the rubber band.
    pub placed: Vec<(usize, Rect)>,
}

impl<'a> Sheet<'a> {
    /// Nothing drawn yet.
    pub fn new(ui: &'a Ui, state: &'a EditorState, axis: Axis, window: Rect) -> Self {
        let palette = theme::of(ui);
        let (actions, placed, hovered_source) = (Vec::new(), Vec::new(), None);
        Self { ui, state, axis, palette, window, actions, hovered_source, placed }
    }

    /// A painter that stays within the rows.
    pub fn painter(&self) -> Painter {
        self.ui.painter().with_clip_rect(self.window)
    }

    /// Words as they are laid out; letters are laid out once and kept by egui.
    pub fn words(&self, text: impl Into<String>) -> std::sync::Arc<egui::Galley> {
        let text = text.into();
        let color = egui::Color32::PLACEHOLDER;
        self.ui.fonts_mut(|fonts| fonts.layout_no_wrap(text, theme::caption(), color))
    }

    /// Whether a mark is selected, and whether it is pointed at, here or in the view.
    pub fn lights(&self, mark: &Mark) -> (bool, bool) {
        let selection = self.state.session.selection();
        let hovered = match selection.hovered() {
            Some(motion_session::selection::Selectable::Constraint(at)) => *at == mark.at,
            _ => false,
        };
        let in_view = self.state.hovered.is_some_and(|target| is_target(target, mark));
        (self.state.is_selected(&mark.at), hovered || in_view)
    }

    /// What every mark does: a click selects and goes there, a drag takes hold, a right click opens
    /// a menu.
    pub fn mark_events(&mut self, response: &Response, mark: &Mark, part: super::retime::Part) {
        if response.hovered() {
            self.actions.push(Action::Hover(mark.at.clone()));
        }
        if response.clicked() {
            let is_adding = self.ui.input(|input| input.modifiers.shift);
            self.actions.push(Action::Select(mark.at.clone(), is_adding));
        }
        if response.drag_started_by(egui::PointerButton::Primary) {
            self.actions.push(Action::Grab(mark.at.clone(), part));
        }
        if response.secondary_clicked() || response.context_menu_opened() {
            let at = mark.at.clone();
            let (actions, state) = (&mut self.actions, self.state);
            response.context_menu(|ui| {
                mark_menu_ui(ui, &at, mark.frame(), actions);
                if let ConstraintKind::Style { tag, .. } = &mark.constraint.kind {
                    tag_menu_ui(ui, (&at, tag), state, actions);
                }
            });
        }
    }

    /// A rectangle around a place, as far as it can be seen; `None` where it cannot.
    pub fn touch(&self, center: Pos2, size: Vec2) -> Option<Rect> {
        self.seen(Rect::from_center_size(center, size))
    }

    /// What of a rectangle can be seen.
    pub fn seen(&self, rect: Rect) -> Option<Rect> {
        let seen = rect.intersect(self.window);
        (seen.width() > 0.0 && seen.height() > 0.0).then_some(seen)
    }
}

fn mark_menu_ui(ui: &mut Ui, at: &ConstraintRef, frame: usize, actions: &mut Vec<Action>) {
    use crate::ui_command::UiCommand as C;
    ui.set_min_width(180.0);
    if ui.button("Go to").clicked() {
        actions.push(Action::GoTo(frame));
    }
    for command in [C::Duplicate, C::Delete] {
        if ui.button(command.label()).clicked() {
            actions.push(Action::With(at.clone(), command));
        }
    }
}

/// Other tags for a style.
fn tag_menu_ui(
    ui: &mut Ui,
    (at, tag): (&ConstraintRef, &str),
    state: &EditorState,
    actions: &mut Vec<Action>,
) {
    ui.separator();
    for (known, n) in motion_session::clip_rows::tag_counts(&state.clips) {
        if ui.selectable_label(known == tag, format!("{known} ({n} clips)")).clicked() {
            let (at, tag) = (at.clone(), known);
            actions.push(Action::Do(vec![Command::SetTag { at, tag }]));
            ui.close();
        }
    }
}

/// Whether a thing in the view is this mark.
fn is_target(target: motion_session::stage::pick::PickTarget, mark: &Mark) -> bool {
    use motion_session::stage::pick::PickTarget as P;
    match target {
        P::Checkpoint { character, constraint }
        | P::CheckpointTip { character, constraint }
        | P::JointTarget { character, constraint }
        | P::Pose { character, constraint }
        | P::Path { character, constraint } => {
            (character, constraint) == (mark.at.character.0, mark.index)
        }
        P::Actor { .. } | P::Ghost { .. } | P::Obstacle { .. } | P::Meeting { .. } => false,
    }
}
