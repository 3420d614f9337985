//! The fields of a path.

use egui::{CollapsingHeader, Role, Ui, WidgetInfo};
use motion_session::PathHeading;
use motion_session::command::Command;
use motion_session::document::ConstraintRef;

use super::field::{Number, choice_row_ui, number_row_ui, parts_row_ui, value_ui};
use crate::state::EditorState;
use crate::theme;
use crate::viewport::gesture::stroke::{frames_for, length_m};

/// What is asked by a path.
pub(super) struct PathFields<'a> {
    /// Its first and its last frame.
    pub span: (u32, u32),
    /// Its points, `[x, z]` metres.
    pub points_m: &'a [[f64; 2]],
    /// Where one looks on it.
    pub heading: PathHeading,
}

/// How long it is, how fast one goes along it, where one looks, and its points.
pub(super) fn path_ui(
    ui: &mut Ui,
    at: &ConstraintRef,
    path: &PathFields<'_>,
    state: &mut EditorState,
) {
    let metres = length_m(path.points_m);
    super::field::line_ui(ui, "Length", &format!("{metres:.2} m"));
    let (from, to) = path.span;
    let fps = state.fps();
    let secs = f64::from(to.saturating_sub(from).max(1)) / fps;
    let speed =
        Number { name: "Speed", unit: " m/s", speed: 0.02, decimals: 2, range: (0.01, 20.0) };
    number_row_ui(ui, speed, metres / secs, state, |speed| {
        let to = from + frames_for(metres, speed, fps);
        vec![Command::RetimeSpan { at: at.clone(), from, to }]
    });
    let words = |heading: PathHeading| match heading {
        PathHeading::Free => "Anywhere",
        PathHeading::Along => "Along the path",
    };
    let choices = PathHeading::ALL.map(|(_, heading)| words(heading).to_owned());
    if let Some(chosen) = choice_row_ui(ui, "Looks", words(path.heading), &choices)
        && let Some((_, heading)) =
            PathHeading::ALL.into_iter().find(|(_, heading)| words(*heading) == chosen)
    {
        state.apply(&Command::SetPathHeading { at: at.clone(), heading });
    }
    points_ui(ui, at, path.points_m, state);
}

fn points_ui(ui: &mut Ui, at: &ConstraintRef, points_m: &[[f64; 2]], state: &mut EditorState) {
    let words = format!("{} points", points_m.len());
    let header = CollapsingHeader::new(&words).id_salt("points").show(ui, |ui| {
        for (nth, point) in points_m.iter().enumerate() {
            let names = ["x", "z"].map(|axis| format!("Point {} {axis}", nth + 1));
            let parts = [("x ", Number::metres(&names[0])), ("z ", Number::metres(&names[1]))];
            let name = format!("Point {}", nth + 1);
            parts_row_ui(ui, &name, parts, *point, state, |point| {
                let mut points_m = points_m.to_vec();
                points_m[nth] = point;
                vec![Command::Reshape { at: at.clone(), points_m }]
            });
        }
        let faint = theme::of(ui).faint;
        value_ui(ui, "Points are dragged in the view", faint);
    });
    header.header_response.widget_info(|| WidgetInfo::labeled(Role::Button, true, &words));
}
