//! The fields of an obstacle.

use egui::{Button, Ui};
use motion_session::Shape;
use motion_session::command::Command;
use motion_session::document::ObstacleIdx;

use super::field::{Number, choice_row_ui, number_row_ui, parts_row_ui};
use super::heading_ui;
use crate::obstacle_form::{self, ObstacleForm};
use crate::state::EditorState;
use crate::theme;
use crate::ui_command::UiCommand;

/// Everything that can be said of an obstacle.
pub(super) fn obstacle_ui(ui: &mut Ui, obstacle: ObstacleIdx, state: &mut EditorState) {
    let Some(known) = state.session.document().obstacle(obstacle) else { return };
    let shape = known.shape.clone();
    let form = ObstacleForm::of(&shape);
    heading_ui(ui, form.name(), &format!("Obstacle {}", obstacle.0 + 1));
    let change = |shape: Shape| Command::ChangeObstacle { obstacle, shape };
    let names = ObstacleForm::ALL.map(|form| form.name().to_owned());
    if let Some(chosen) = choice_row_ui(ui, "Form", form.name(), &names)
        && let Some(form) = ObstacleForm::ALL.into_iter().find(|form| form.name() == chosen)
    {
        state.apply(&change(form.made_of(&shape)));
    }
    let [x, y, z] = obstacle_form::center_m(&shape);
    let parts = [("x ", Number::metres("x")), ("z ", Number::metres("z"))];
    parts_row_ui(ui, "Place", parts, [x, z], state, |[x, z]| {
        vec![change(obstacle_form::at(&shape, [x, y, z]))]
    });
    let [width, depth] = obstacle_form::floor_m(&shape);
    let size = |name| Number { range: (0.01, 10_000.0), ..Number::metres(name) };
    if form == ObstacleForm::Cylinder {
        number_row_ui(ui, size("Radius"), 0.5 * width, state, |radius| {
            vec![change(obstacle_form::with_floor(&shape, [2.0 * radius; 2]))]
        });
    } else {
        let parts = [("", size("Width")), ("× ", size("Depth"))];
        parts_row_ui(ui, "Size", parts, [width, depth], state, |size| {
            vec![change(obstacle_form::with_floor(&shape, size))]
        });
    }
    let (bottom, top) = obstacle_form::levels_m(&shape);
    if form == ObstacleForm::Ceiling {
        number_row_ui(ui, size("Clear height"), top, state, |top| {
            vec![change(obstacle_form::with_levels(&shape, (top, top)))]
        });
    } else {
        number_row_ui(ui, size("Height"), top - bottom, state, |height| {
            vec![change(obstacle_form::with_levels(&shape, (bottom, bottom + height)))]
        });
        number_row_ui(ui, Number::metres("Above the floor"), bottom, state, |to| {
            vec![change(obstacle_form::with_levels(&shape, (to, to + top - bottom)))]
        });
    }
    if let Some(deg) = obstacle_form::heading_deg(&shape) {
        number_row_ui(ui, Number::degrees("Heading"), deg, state, |to| {
            vec![change(obstacle_form::turned(&shape, to - deg))]
        });
    }
    ui.add_space(theme::GRID);
    ui.horizontal(|ui| {
        let raised = theme::of(ui).raised;
        if ui.add(Button::new("Duplicate").fill(raised)).clicked() {
            state.ask(UiCommand::Duplicate);
        }
        if ui.add(Button::new("Delete").fill(raised)).clicked() {
            state.apply(&Command::RemoveObstacle { obstacle });
        }
    });
}
