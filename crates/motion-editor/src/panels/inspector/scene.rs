//! What the scene is: its name, whose motion is shown, how long it is, what counts how much.

use egui::{CollapsingHeader, Role, Ui, WidgetInfo};
use motion_session::LengthMode;
use motion_session::command::Command;
use motion_session::document::CharacterIdx;

use super::field::{Number, choice_row_ui, number_row_ui, text_row_ui};
use super::{empty_ui, heading_ui};
use crate::icons;
use crate::state::EditorState;
use crate::take_card::TERMS;
use crate::theme;
use crate::ui_command::UiCommand;
use crate::widgets::icon_button::icon_button_ui;

/// The terms' names in files, in the order of [`TERMS`].
const TERM_KEYS: [&str; 4] = ["continuity", "length", "body", "environment"];

/// The fields of the scene.
pub(super) fn scene_ui(ui: &mut Ui, state: &mut EditorState) {
    heading_ui(ui, "Scene", "");
    let name = state.session.document().name().to_owned();
    if let Some(name) = text_row_ui(ui, "Project", &name) {
        state.apply(&Command::RenameProject { name });
    }
    characters_ui(ui, state);
    length_ui(ui, state);
    let header = CollapsingHeader::new("Search weights").default_open(false).show(ui, |ui| {
        empty_ui(ui, "1 = 30 cm = 10° = 10 frames");
        for (name, key) in TERMS.into_iter().zip(TERM_KEYS) {
            let weights = &state.session.document().search().weights;
            let known = weights.iter().find(|(known, _)| known == key);
            let value = known.map_or(1.0, |(_, value)| *value);
            number_row_ui(ui, Number::weight(name), value, state, |value| {
                let weight = (value != 1.0).then_some(value);
                vec![Command::SetTermWeight { term: key.to_owned(), weight }]
            });
        }
    });
    header
        .header_response
        .widget_info(|| WidgetInfo::labeled(Role::Button, true, "Search weights"));
}

/// The name of the active character, the others to be changed to, one more or less.
fn characters_ui(ui: &mut Ui, state: &mut EditorState) {
    let active = state.session.active();
    let characters = state.session.document().characters();
    let names: Vec<String> = characters.iter().map(|c| c.name.clone()).collect();
    let Some(name) = names.get(active.0).cloned() else { return };
    if names.len() > 1
        && let Some(other) = choice_row_ui(ui, "Shown character", &name, &names)
        && let Some(nth) = names.iter().position(|known| *known == other)
    {
        state.session.set_active(CharacterIdx(nth));
        state.refresh();
        return;
    }
    if let Some(name) = text_row_ui(ui, "Character", &name) {
        state.apply(&Command::RenameCharacter { character: active, name });
    }
    super::field::row_ui(ui, |ui| {
        ui.label(egui::RichText::new("Characters").color(theme::of(ui).faint));
        ui.with_layout(egui::Layout::right_to_left(egui::Align::Center), |ui| {
            let add = "Add a character";
            if icon_button_ui(ui, icons::ADD, add, "Somebody else, with a start and an end", false)
                .clicked()
            {
                let taken = |name: &String| names.contains(name);
                let named = (2..).map(|n| format!("Character {n}")).find(|name| !taken(name));
                if let Some(name) = named
                    && state.apply(&Command::AddCharacter { name })
                {
                    state.session.set_active(CharacterIdx(names.len()));
                    state.refresh();
                }
            }
            if names.len() > 1 {
                let remove = "Remove this character";
                let tooltip = "With everything that is asked of it";
                if icon_button_ui(ui, icons::REMOVE, remove, tooltip, false).clicked() {
                    state.apply(&Command::RemoveCharacter { character: active });
                }
            }
            if names.len() > 1 {
                let meet = UiCommand::MeetHere;
                let label = meet.label();
                if icon_button_ui(ui, icons::MEETING, &label, meet.tooltip(), false).clicked() {
                    state.ask(meet);
                }
            }
            ui.label(names.len().to_string());
        });
    });
}

fn length_ui(ui: &mut Ui, state: &mut EditorState) {
    let character = state.session.active();
    let length = state.session.document().character(character).and_then(|c| c.length.clone());
    let mode = length.as_ref().map_or(LengthMode::Free, |length| length.mode);
    let now = state.n_frames() as u32;
    let frames = length.and_then(|length| length.frames);
    if mode != LengthMode::Free || frames.is_some() {
        let value = f64::from(frames.unwrap_or(now));
        let number = Number { range: (1.0, 999_999.0), ..Number::frames("Length") };
        number_row_ui(ui, number, value, state, |value| {
            let frames = Some(value.round() as u32);
            vec![Command::SetLength { character, frames, mode }]
        });
    }
    let words = |mode: LengthMode| match mode {
        LengthMode::Free => "Free",
        LengthMode::Preferred => "Preferred",
        LengthMode::Exact => "Exact",
    };
    let choices: Vec<String> =
        LengthMode::ALL.into_iter().map(|(_, mode)| words(mode).to_owned()).collect();
    if let Some(chosen) = choice_row_ui(ui, "Length is", words(mode), &choices)
        && let Some((_, mode)) =
            LengthMode::ALL.into_iter().find(|(_, mode)| words(*mode) == chosen)
    {
        let frames = Some(frames.unwrap_or(now));
        state.apply(&Command::SetLength { character, frames, mode });
    }
}
