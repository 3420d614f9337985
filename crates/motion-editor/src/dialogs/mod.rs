//! Asking for files: with the system's dialog, or inside the window where the system has none.
//!
//! ```no_run
//! # fn frame(ui: &egui::Ui, dialogs: &mut motion_editor::dialogs::FileDialogs) {
//! use motion_editor::dialogs::{Ask, Answer};
//! dialogs.ask(Ask::OpenProject, std::path::Path::new("."), ui.ctx());
//! // Once in every frame:
//! dialogs.ui(ui);
//! if let Some(Answer { ask, paths }) = dialogs.poll() {
//!     // No paths: it was cancelled.
//! }
//! # }
//! ```

mod ask;
mod file_row;
mod native;
mod path_dialog;
mod portal;

use std::collections::VecDeque;
use std::path::{Path, PathBuf};

pub use ask::{Ask, Wanted};
use native::{NativeAnswer, NativeDialog};
pub use path_dialog::PathDialog;

/// Who answers.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Answers {
    /// The system's dialog; our own where the system has none.
    System,
    /// Our own dialog, inside the window.
    Own,
    /// These, one after the other; for tests. None left means cancelled.
    Prepared(VecDeque<Vec<PathBuf>>),
}

/// What came of asking.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Answer {
    /// What was asked.
    pub ask: Ask,
    /// What was chosen; nothing where it was cancelled.
    pub paths: Vec<PathBuf>,
}

/// Asks for files, one question at a time, and never waits for the answer.
#[derive(Debug)]
pub struct FileDialogs {
    answers: Answers,
    open: Option<Open>,
}

#[derive(Debug)]
enum Open {
    System { ask: Ask, folder: PathBuf, dialog: NativeDialog },
    Own(Box<PathDialog>),
    Done(Answer),
}

impl FileDialogs {
    /// Dialogs that are answered so.
    pub fn new(answers: Answers) -> Self {
        Self { answers, open: None }
    }

    /// Whether a question is open. While our own dialog is, keys are its.
    pub fn is_open(&self) -> bool {
        self.open.is_some()
    }

    /// Whether our own dialog is open, in this window.
    pub fn is_own_open(&self) -> bool {
        matches!(self.open, Some(Open::Own(_)))
    }

    /// Asks, beginning in `folder`. Gives whether it could: not while another question is open.
    pub fn ask(&mut self, ask: Ask, folder: &Path, ctx: &egui::Context) -> bool {
        if self.open.is_some() {
            return false;
        }
        let folder = if folder.as_os_str().is_empty() { Path::new(".") } else { folder };
        let folder = std::path::absolute(folder).unwrap_or_else(|_| folder.to_owned());
        self.open = Some(match &mut self.answers {
            Answers::System => {
                let ctx = ctx.clone();
                let dialog = NativeDialog::open(&ask, &folder, move || ctx.request_repaint());
                Open::System { ask, folder, dialog }
            }
            Answers::Own => Open::Own(Box::new(PathDialog::new(ask, &folder))),
            Answers::Prepared(prepared) => {
                Open::Done(Answer { ask, paths: prepared.pop_front().unwrap_or_default() })
            }
        });
        true
    }

    /// Draws our own dialog, if it is open, over everything else.
    pub fn ui(&mut self, ui: &egui::Ui) {
        if let Some(Open::Own(dialog)) = &mut self.open
            && let Some(paths) = dialog.ui(ui)
        {
            let ask = dialog.ask().clone();
            self.open = Some(Open::Done(Answer { ask, paths }));
        }
    }

    /// The answer, once there is one.
    pub fn poll(&mut self) -> Option<Answer> {
        let answer = match self.open.as_ref()? {
            Open::System { ask, folder, dialog } => match dialog.poll()? {
                NativeAnswer::Chosen(paths) => Answer { ask: ask.clone(), paths },
                NativeAnswer::Cancelled => Answer { ask: ask.clone(), paths: Vec::new() },
                NativeAnswer::Unavailable => {
                    // It will not be there the next time either.
                    self.answers = Answers::Own;
                    self.open = Some(Open::Own(Box::new(PathDialog::new(ask.clone(), folder))));
                    return None;
                }
            },
            Open::Own(_) => return None,
            Open::Done(answer) => answer.clone(),
        };
        self.open = None;
        Some(answer)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn prepared_answers_come_in_turn() {
        let ctx = egui::Context::default();
        let prepared = VecDeque::from([vec![PathBuf::from("a.gaitway")]]);
        let mut dialogs = FileDialogs::new(Answers::Prepared(prepared));
        assert_eq!(dialogs.poll(), None);
        assert!(dialogs.ask(Ask::OpenProject, Path::new(""), &ctx));
        assert!(!dialogs.ask(Ask::ImportClips, Path::new(""), &ctx), "one at a time");
        let paths = vec![PathBuf::from("a.gaitway")];
        assert_eq!(dialogs.poll(), Some(Answer { ask: Ask::OpenProject, paths }));
        assert!(!dialogs.is_open());
        assert!(dialogs.ask(Ask::ImportClips, Path::new(""), &ctx));
        let cancelled = Answer { ask: Ask::ImportClips, paths: Vec::new() };
        assert_eq!(dialogs.poll(), Some(cancelled));
    }
}
