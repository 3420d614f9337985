//! Projects opened and saved from the window, and nothing lost on the way.
//!
//! Whatever would take the place of unsaved work goes through [`FileFlow::request`], which asks
//! first. Widgets are in [`prompts`].

mod next;
pub mod prompts;

use std::path::{Path, PathBuf};

use motion_session::document::CharacterIdx;
use motion_session::sample::{SAMPLES, new_project};
use motion_session::session::{ImportChoices, Recovery};

use crate::dialogs::{Answer, Answers, Ask, FileDialogs};
use crate::state::EditorState;
use crate::ui_command::UiCommand as C;
pub use next::Next;

/// Where opening and saving stand.
pub struct FileFlow {
    /// Asks for files.
    pub dialogs: FileDialogs,
    /// What waits for an answer about unsaved work.
    guarded: Option<Next>,
    /// What is done once the project is saved to the file that is being asked for.
    after_saving: Option<Next>,
    /// What earlier windows have left unsaved.
    recoveries: Vec<Recovery>,
    /// Whether the window may close.
    may_close: bool,
}

impl FileFlow {
    /// A flow whose questions are answered by `answers`; offers what earlier windows have left.
    pub fn new(answers: Answers, state: &EditorState) -> Self {
        Self {
            dialogs: FileDialogs::new(answers),
            guarded: None,
            after_saving: None,
            recoveries: state.session.recoveries(),
            may_close: false,
        }
    }

    /// Whether something asks that must be answered before anything else.
    pub fn is_asking(&self) -> bool {
        self.guarded.is_some() || !self.recoveries.is_empty() || self.dialogs.is_open()
    }

    /// Whether the window may close now.
    pub fn may_close(&self) -> bool {
        self.may_close
    }

    /// Does a command about files; gives whether it was one.
    pub fn run(&mut self, command: C, state: &mut EditorState, ctx: &egui::Context) -> bool {
        match command {
            C::New => self.request(Next::New, state, ctx),
            C::Open => self.request(Next::AskOpen, state, ctx),
            C::Sample(nth) => self.request(Next::Sample(usize::from(nth)), state, ctx),
            C::Recent(nth) => {
                let path = state.recent.get(usize::from(nth)).cloned();
                path.into_iter().for_each(|path| self.request(Next::Open(path), state, ctx));
            }
            C::Save => self.save(None, state, ctx),
            C::SaveAs => self.ask_where(None, state, ctx),
            C::Import => self.ask(Ask::ImportClips, state, ctx),
            C::ImportFolder => self.ask(Ask::ImportFolder, state, ctx),
            C::Quit => self.request(Next::Close, state, ctx),
            _ => return false,
        }
        true
    }

    /// Does something that takes the place of the present project, as soon as that is safe.
    pub fn request(&mut self, next: Next, state: &mut EditorState, ctx: &egui::Context) {
        state.cancel();
        if state.session.is_changed() {
            self.guarded = Some(next);
        } else {
            self.go(next, state, ctx);
        }
    }

    /// Takes in files that were dropped on the window: a project is opened, a library used, all
    /// others are imported.
    pub fn drop_in(&mut self, paths: Vec<PathBuf>, state: &mut EditorState, ctx: &egui::Context) {
        let ends = |path: &Path, ending: &str| {
            path.extension().is_some_and(|own| own.eq_ignore_ascii_case(ending))
        };
        if let Some(project) = paths.iter().find(|path| ends(path, "gaitway")) {
            self.request(Next::Open(project.clone()), state, ctx);
        } else if let Some(library) = paths.iter().find(|path| ends(path, "gwlib")) {
            match state.session.use_library(library) {
                Ok(()) => state.refresh(),
                Err(error) => state.notices.refuse(error.to_string()),
            }
        } else if !paths.is_empty() {
            import(paths, state);
        }
    }

    /// Takes in answers. To be called once a frame.
    pub fn poll(&mut self, state: &mut EditorState, ctx: &egui::Context) -> Option<Answer> {
        let Answer { ask, paths } = self.dialogs.poll()?;
        if let Some(folder) = paths.first().and_then(|path| path.parent()) {
            state.settings.last_folder = Some(folder.to_owned());
        }
        match (&ask, paths.first()) {
            (Ask::OpenProject, Some(path)) => self.go(Next::Open(path.clone()), state, ctx),
            (Ask::OpenProject, None) => {}
            (Ask::SaveProject { .. }, path) => {
                let next = self.after_saving.take();
                let path = path?;
                match state.session.save_as(path) {
                    Ok(()) => self.saved(path, next, state, ctx),
                    Err(error) => state.notices.refuse(error.to_string()),
                }
            }
            (Ask::ImportClips | Ask::ImportFolder, Some(_)) => import(paths, state),
            _ => return Some(Answer { ask, paths }),
        }
        None
    }

    /// Asks for files for somebody else, who gets the answer of [`Self::poll`].
    pub fn ask(&mut self, ask: Ask, state: &EditorState, ctx: &egui::Context) {
        let folder = state.session.path().and_then(Path::parent).map(Path::to_owned);
        let folder = folder.or_else(|| state.settings.last_folder.clone()).or_else(home);
        self.dialogs.ask(ask, &folder.unwrap_or_default(), ctx);
    }

    fn save(&mut self, next: Option<Next>, state: &mut EditorState, ctx: &egui::Context) {
        let Some(path) = state.session.path().map(Path::to_owned) else {
            return self.ask_where(next, state, ctx);
        };
        state.cancel();
        match state.session.save() {
            Ok(()) => self.saved(&path, next, state, ctx),
            Err(error) => state.notices.refuse(error.to_string()),
        }
    }

    fn ask_where(&mut self, next: Option<Next>, state: &mut EditorState, ctx: &egui::Context) {
        state.cancel();
        self.after_saving = next;
        let own = state.session.path().and_then(Path::file_name);
        let name = own.map_or_else(
            || format!("{}.gaitway", file_stem(state.session.document().name())),
            |name| name.to_string_lossy().into_owned(),
        );
        self.ask(Ask::SaveProject { suggested: name }, state, ctx);
    }

    fn saved(
        &mut self,
        path: &Path,
        next: Option<Next>,
        state: &mut EditorState,
        ctx: &egui::Context,
    ) {
        state.note_recent(path);
        state.notices.tell(format!("Saved {}", path.display()));
        next.into_iter().for_each(|next| self.go(next, state, ctx));
    }

    /// Does it, whatever becomes of the present project.
    fn go(&mut self, next: Next, state: &mut EditorState, ctx: &egui::Context) {
        let begin = |state: &mut EditorState, project| match project {
            Ok(project) => {
                state.session.begin_new(&project);
                state.begin_again();
            }
            Err(error) => state.notices.refuse(format!("{error}")),
        };
        match next {
            Next::New => begin(state, new_project()),
            Next::Sample(nth) => {
                let sample = SAMPLES.get(nth).unwrap_or(&SAMPLES[0]);
                begin(state, sample.project());
            }
            Next::AskOpen => self.ask(Ask::OpenProject, state, ctx),
            Next::Open(path) => match state.session.open(&path) {
                Ok(()) => {
                    state.note_recent(&path);
                    state.begin_again();
                }
                Err(error) => state.notices.refuse(error.to_string()),
            },
            Next::Close => {
                self.may_close = true;
                ctx.send_viewport_cmd(egui::ViewportCommand::Close);
            }
        }
    }
}

/// Begins to import files and folders in the background.
fn import(paths: Vec<PathBuf>, state: &mut EditorState) {
    state.settings.left.open = true;
    if let Err(error) = state.session.begin_import(paths, ImportChoices::default()) {
        state.notices.refuse(error.to_string());
    }
}

/// A project's name as far as a file's name can hold it.
fn file_stem(name: &str) -> String {
    let fits = |c: char| if c.is_alphanumeric() || "-_ ".contains(c) { c } else { '-' };
    let stem: String = name.trim().chars().take(60).map(fits).collect();
    if stem.is_empty() { "untitled".to_owned() } else { stem }
}

fn home() -> Option<PathBuf> {
    std::env::var_os("HOME").or_else(|| std::env::var_os("USERPROFILE")).map(PathBuf::from)
}

impl EditorState {
    /// Another project has taken the place of the one before.
    pub(crate) fn begin_again(&mut self) {
        self.cards.clear();
        self.shown_before = None;
        self.hovered = None;
        self.notices.clear_refusal();
        self.session.set_active(CharacterIdx(0));
        self.is_new_scene = true;
        self.has_played = false;
        self.refresh();
    }
}
