//! The fields of a meeting of characters.

use egui::{Button, RichText, Ui};
use motion_session::command::Command;
use motion_session::stage::meeting_wishes::title;
use motion_session::{Interaction, Member};

use super::field::{Number, choice_row_ui, number_row_ui};
use super::heading_ui;
use super::pick_row::pick_row_ui;
use crate::meeting::{beside_first, changed, with_beside};
use crate::state::EditorState;
use crate::theme;

/// Everything that can be said of a meeting.
pub(super) fn meeting_ui(ui: &mut Ui, meeting: &Interaction, state: &mut EditorState) {
    heading_ui(ui, &title(meeting), "");
    let frame = f64::from(meeting.frame);
    number_row_ui(ui, Number::frames("Frame"), frame, state, |value| {
        vec![changed(
            meeting,
            value.round() as u32,
            meeting.members.clone(),
            meeting.relative.clone(),
        )]
    });
    for nth in 0..meeting.members.len() {
        member_ui(ui, meeting, nth, state);
    }
    let weight = meeting.weight.unwrap_or(1.0);
    number_row_ui(ui, Number::weight("Weight"), weight, state, |value| {
        let weight = (value != 1.0).then_some(value);
        vec![Command::SetInteractionWeight { id: meeting.id.clone(), weight }]
    });
    ui.add_space(theme::GRID);
    if ui.add(Button::new("Delete").fill(theme::of(ui).raised)).clicked() {
        state.apply(&Command::RemoveInteraction { id: meeting.id.clone() });
    }
}

/// Who, in which pose, and how it stands to the first.
fn member_ui(ui: &mut Ui, meeting: &Interaction, nth: usize, state: &mut EditorState) {
    let member = &meeting.members[nth];
    ui.add_space(theme::GRID);
    ui.push_id(("member", nth), |ui| {
        let name = &member.character;
        ui.label(RichText::new(name).font(theme::heading()).color(theme::of(ui).text));
        let with = |new: Member| {
            let mut members = meeting.members.clone();
            members[nth] = new;
            changed(meeting, meeting.frame, members, meeting.relative.clone())
        };
        let names: Vec<String> =
            state.session.document().characters().iter().map(|c| c.name.clone()).collect();
        if names.len() > 2
            && let Some(character) = choice_row_ui(ui, &format!("Who: {name}"), name, &names)
        {
            state.apply(&with(Member { character, ..member.clone() }));
        }
        let clips: Vec<(String, String)> =
            state.clips.iter().map(|clip| (clip.id.clone(), clip.id.clone())).collect();
        if let Some(clip) = pick_row_ui(ui, &format!("Clip of {name}"), &member.clip, &clips) {
            state.apply(&with(Member { clip, clip_frame: 0, ..member.clone() }));
        }
        let known = state.clips.iter().find(|clip| clip.id == member.clip);
        let last = known.map_or(999_999, |clip| clip.n_frames.saturating_sub(1));
        let of_clip = format!("Clip frame of {name}");
        let number = Number { range: (0.0, last as f64), ..Number::frames(&of_clip) };
        number_row_ui(ui, number, f64::from(member.clip_frame), state, |frame| {
            vec![with(Member { clip_frame: frame.round() as u32, ..member.clone() })]
        });
        if nth == 0 {
            return;
        }
        let (beside, heading_deg) = beside_first(meeting, nth);
        let first = &meeting.members[0].character;
        for (axis, words) in
            [format!("Ahead of {first}"), format!("Left of {first}")].iter().enumerate()
        {
            number_row_ui(ui, Number::metres(words), beside[axis], state, |value| {
                let mut beside = beside;
                beside[axis] = value;
                with_beside(meeting, nth, beside, heading_deg).into_iter().collect()
            });
        }
        let words = format!("Turned from {first}");
        number_row_ui(ui, Number::degrees(&words), heading_deg, state, |value| {
            with_beside(meeting, nth, beside, value).into_iter().collect()
        });
    });
}
