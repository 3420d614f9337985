//! Motions taken out of the window: what, which frames, where to; and what came back of the file.

use std::path::Path;

use egui::{Align, Button, Id, Key, Layout, Modal, RichText, Ui};
use motion_session::playback::PlayRange;
use motion_session::session::{ExportRange, ExportReport};

use crate::dialogs::{Answer, Ask};
use crate::files::FileFlow;
use crate::state::EditorState;
use crate::theme;
use crate::widgets::dialog_frame;

const WIDTH_PT: f32 = 420.0;
/// Two joints nearer than this are at the same place to any program.
const SAME_M: f32 = 0.001;

/// The choices, while the dialog is open; they stay for the next time.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct ExportDialog {
    is_open: bool,
    /// Only the range that is played.
    only_range: bool,
    /// Where it was written the last time.
    last: Option<std::path::PathBuf>,
}

impl ExportDialog {
    /// Opens it.
    pub fn open(&mut self) {
        self.is_open = true;
    }

    /// Whether it is open.
    pub fn is_open(&self) -> bool {
        self.is_open
    }

    /// Writes where it was written the last time, or opens the dialog.
    pub fn repeat(&mut self, state: &mut EditorState) {
        match self.last.clone() {
            Some(path) => self.write(&path, state),
            None => self.is_open = true,
        }
    }

    /// Draws it, if it is open.
    pub fn ui(&mut self, ui: &Ui, state: &mut EditorState, files: &mut FileFlow) {
        if !self.is_open || files.is_asking() {
            return;
        }
        let mut chosen = None;
        let modal = Modal::new(Id::unique("export")).frame(dialog_frame(ui)).show(ui.ctx(), |ui| {
            ui.set_width(WIDTH_PT);
            ui.label(RichText::new("Export motion").font(theme::title()));
            ui.add_space(theme::GRID);
            self.contents_ui(ui, state, &mut chosen);
        });
        let escaped = modal.should_close() || ui.input(|input| input.key_pressed(Key::Escape));
        match chosen {
            Some(Choice::Shown) => {
                let name = format!("{}.bvh", file_stem(state));
                files.ask(Ask::ExportMotion { suggested: name }, state, ui.ctx());
                self.is_open = false;
            }
            Some(Choice::All) => {
                files.ask(Ask::ExportFolder, state, ui.ctx());
                self.is_open = false;
            }
            Some(Choice::None) => self.is_open = false,
            None if escaped => self.is_open = false,
            None => {}
        }
    }

    fn contents_ui(&mut self, ui: &mut Ui, state: &EditorState, chosen: &mut Option<Choice>) {
        let palette = theme::of(ui);
        let Some(card) = state.shown_card() else {
            let text = "There is no motion yet; it can be exported as soon as one moves";
            ui.label(RichText::new(text).color(palette.faint));
            *chosen = ui.button("Close").clicked().then_some(Choice::None);
            return;
        };
        let frames = card.n_frames();
        let about = format!(
            "{}, {frames} frames at {:.0} fps, as BVH in centimetres, Y up: what Blender, \
             MotionBuilder and Houdini read",
            card.title(),
            state.fps()
        );
        ui.label(RichText::new(about).color(palette.faint));
        ui.add_space(2.0 * theme::GRID);
        let range = state.session.playback().chosen_range();
        let text = match range {
            Some(PlayRange { from, to }) => format!("Only the loop range, f {from} to f {to}"),
            None => "Only the loop range ([ and ] set it)".to_owned(),
        };
        ui.add_enabled(range.is_some(), egui::Checkbox::new(&mut self.only_range, text));
        ui.add_space(4.0 * theme::GRID);
        ui.with_layout(Layout::right_to_left(Align::Center), |ui| {
            let size = [110.0, 28.0].into();
            let main = RichText::new("Export…").color(palette.base);
            if ui.add(Button::new(main).fill(palette.accent).min_size(size)).clicked() {
                *chosen = Some(Choice::Shown);
            }
            let all = Button::new("All kept takes…").fill(palette.hovered).min_size(size);
            let about =
                "The shown and the pinned takes of every character, a file each, to a folder";
            if ui.add(all).on_hover_text(about).clicked() {
                *chosen = Some(Choice::All);
            }
            if ui.add(Button::new("Cancel").min_size(size)).clicked() {
                *chosen = Some(Choice::None);
            }
        });
        if ui.input(|input| input.key_pressed(Key::Enter)) && chosen.is_none() {
            *chosen = Some(Choice::Shown);
        }
    }

    /// Takes in an answer for files that was meant for this dialog.
    pub fn answered(&mut self, answer: &Answer, state: &mut EditorState) {
        let Some(path) = answer.paths.first() else { return };
        match answer.ask {
            Ask::ExportMotion { .. } => self.write(path, state),
            Ask::ExportFolder => {
                let reports = state.session.export_all(path);
                let said = reports.map(|reports| {
                    let n = reports.len();
                    let files = if n == 1 { "1 file".to_owned() } else { format!("{n} files") };
                    format!("Exported {files} to {}; {}", path.display(), come_back(&reports))
                });
                tell(said, state);
            }
            _ => {}
        }
    }

    fn write(&mut self, path: &Path, state: &mut EditorState) {
        let Some(shown) = state.shown() else { return };
        let chosen = state.session.playback().chosen_range().filter(|_| self.only_range);
        let range = chosen.map_or(ExportRange::Whole, |PlayRange { from, to }| {
            let last = state.last_frame() as u32;
            ExportRange::Frames { from: from.min(last), to: to.min(last) }
        });
        let character = state.session.active();
        let report = state.session.export_take(character, shown, path, range);
        let said = report.map(|report| {
            let n = report.n_frames;
            let back = come_back(std::slice::from_ref(&report));
            format!("Exported {n} frames to {}; {back}", path.display())
        });
        if said.is_ok() {
            self.last = Some(path.to_owned());
        }
        tell(said, state);
    }
}

enum Choice {
    Shown,
    All,
    None,
}

fn tell(said: Result<String, motion_session::FileError>, state: &mut EditorState) {
    match said {
        Ok(text) => {
            state.n_exports += 1;
            state.notices.tell(text);
        }
        Err(error) => state.notices.refuse(error.to_string()),
    }
}

/// What reading the files back has shown.
fn come_back(reports: &[ExportReport]) -> String {
    let worst = reports.iter().max_by(|a, b| a.worst_m.total_cmp(&b.worst_m));
    match worst {
        None => "nothing was written".to_owned(),
        Some(worst) if worst.worst_m < SAME_M => "read back, every joint is within 1 mm".to_owned(),
        Some(worst) => {
            let mm = 1000.0 * worst.worst_m;
            format!("read back, {} is {mm:.0} mm off at f {}", worst.worst_joint, worst.worst_frame)
        }
    }
}

/// What the file is called at first: project and character.
fn file_stem(state: &EditorState) -> String {
    let document = state.session.document();
    let character = document.character(state.session.active()).map(|c| c.name.as_str());
    let name = format!("{} {}", document.name(), character.unwrap_or_default());
    name.trim().chars().map(|c| if "/\\:*?\"<>|".contains(c) { '-' } else { c }).collect()
}
