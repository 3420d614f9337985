//! A file dialog inside the window, for where the system has none: a path to be typed, and a list of
//! what is in its folder.

use std::collections::BTreeSet;
use std::path::{Component, MAIN_SEPARATOR, Path, PathBuf};
use std::sync::mpsc::{Receiver, TryRecvError, sync_channel};
use std::thread;

use egui::text::{CCursor, CCursorRange};
use egui::{Align, Area, Frame, Id, Key, Layout, Modifiers, Order, RichText, Role, ScrollArea};
use egui::{Align2, TextEdit, Ui, Vec2, WidgetInfo};
use motion_session::FileError;
use motion_session::folder_list::{FolderEntry, FolderList};

use super::ask::{Ask, Wanted};
use super::file_row::file_row_ui;
use crate::theme;

const WIDTH_PT: f32 = 560.0;
const LIST_PT: f32 = 336.0;
/// From the top of the window.
const TOP_PT: f32 = 72.0;
/// What the row is called that leads to the folder above.
const UP: &str = "..";
/// What the field is called.
const FIELD_LABEL: &str = "Path";

/// A question about files, open in the window.
///
/// Enter takes what the field says, Escape cancels. The arrow keys go through the list, where Enter
/// goes into a folder or takes a file. A file that is there is replaced only on a second Enter.
#[derive(Debug)]
pub struct PathDialog {
    ask: Ask,
    folder: PathBuf,
    typed: String,
    rows: Rows,
    /// The line that the arrow keys are at.
    chosen: Option<usize>,
    /// Files that were clicked, where many are wanted.
    marked: BTreeSet<PathBuf>,
    /// The file that Enter replaces now.
    may_replace: Option<PathBuf>,
    /// What is wrong with what was typed.
    note: Option<String>,
    /// The field gets the keys, and its cursor goes to the end.
    wants_focus: bool,
}

/// The list under the field.
#[derive(Debug)]
enum Rows {
    Coming(Receiver<Result<FolderList, FileError>>),
    There { entries: Vec<FolderEntry>, n_left_out: usize },
    Failed(String),
}

/// What a frame has led to.
enum Deed {
    Enter(PathBuf),
    Take(Vec<PathBuf>),
    Cancel,
}

impl PathDialog {
    /// Asks, beginning in `folder`.
    pub fn new(ask: Ask, folder: &Path) -> Self {
        let mut dialog = Self {
            ask,
            folder: PathBuf::new(),
            typed: String::new(),
            rows: Rows::Failed(String::new()),
            chosen: None,
            marked: BTreeSet::new(),
            may_replace: None,
            note: None,
            wants_focus: true,
        };
        let suggested = dialog.ask.suggested().to_owned();
        // A folder that was there yesterday may be gone.
        let there = folder.ancestors().find(|folder| folder.is_dir());
        dialog.enter(there.unwrap_or(Path::new("/")), &suggested);
        dialog
    }

    /// What is asked.
    pub fn ask(&self) -> &Ask {
        &self.ask
    }

    /// Draws it. Gives the answer: paths, or none where it was cancelled.
    pub fn ui(&mut self, ui: &Ui) -> Option<Vec<PathBuf>> {
        self.take_in_rows(ui.ctx());
        let palette = theme::of(ui);
        let mut deed = None;
        Area::new(Id::unique("path dialog"))
            .order(Order::Foreground)
            .anchor(Align2::CENTER_TOP, Vec2::new(0.0, TOP_PT))
            .show(ui.ctx(), |ui| {
                Frame::popup(ui.style()).inner_margin(16.0).fill(palette.raised).show(ui, |ui| {
                    ui.set_width(WIDTH_PT);
                    deed = self.contents_ui(ui);
                });
            });
        match deed? {
            Deed::Cancel => Some(Vec::new()),
            Deed::Enter(folder) => {
                let is_new_file = self.ask.wanted() == Wanted::NewFile;
                let name = if is_new_file { self.typed_name() } else { String::new() };
                self.enter(&folder, &name);
                None
            }
            Deed::Take(paths) => self.accept(paths),
        }
    }

    fn contents_ui(&mut self, ui: &mut Ui) -> Option<Deed> {
        let mut deed = self.keys(ui);
        ui.label(RichText::new(self.ask.title()).font(theme::title()));
        ui.add_space(theme::GRID);
        if self.wants_focus {
            focus_at_end(ui.ctx(), self.typed.chars().count());
        }
        let field = TextEdit::singleline(&mut self.typed)
            .id(field_id())
            .align(Align2::LEFT_CENTER)
            .desired_width(f32::INFINITY);
        let response = ui.add_sized([ui.available_width(), 28.0], field);
        response.widget_info(|| WidgetInfo::labeled(Role::TextInput, true, FIELD_LABEL));
        // A window that is measured first gives its fields no keys.
        if response.has_focus() && !ui.is_sizing_pass() {
            self.wants_focus = false;
        }
        if response.changed() {
            (self.chosen, self.may_replace, self.note) = (None, None, None);
            // A folder is opened as soon as it is typed out.
            let typed = PathBuf::from(&self.typed);
            if self.typed.ends_with(std::path::is_separator)
                && typed.is_absolute()
                && typed != self.folder
                && typed.is_dir()
            {
                self.list(&typed);
            }
        }
        ui.add_space(theme::GRID);
        deed = self.rows_ui(ui).or(deed);
        ui.add_space(theme::GRID);
        self.note_ui(ui);
        ui.with_layout(Layout::right_to_left(Align::Center), |ui| {
            let verb = if self.may_replace.is_some() { "Replace" } else { self.ask.verb() };
            let palette = theme::of(ui);
            let take = egui::Button::new(verb).fill(palette.accent_surface);
            if ui.add(take).clicked() {
                deed = self.take_typed();
            }
            if ui.button("Cancel").clicked() {
                deed = Some(Deed::Cancel);
            }
        });
        deed
    }

    /// Arrow keys, Enter and Escape, before the field and whatever lies below get them.
    fn keys(&mut self, ui: &Ui) -> Option<Deed> {
        let [up, down, page_up, page_down] = ui.input_mut(|input| {
            [Key::ArrowUp, Key::ArrowDown, Key::PageUp, Key::PageDown]
                .map(|key| input.count_and_consume_key(Modifiers::NONE, key))
        });
        let by = (down + 10 * page_down) as isize - (up + 10 * page_up) as isize;
        let n_rows = self.n_rows();
        if by != 0 && n_rows > 0 {
            let from = self.chosen.map_or(if by > 0 { -1 } else { 0 }, |at| at as isize);
            self.choose((from + by).clamp(0, n_rows as isize - 1) as usize);
        }
        if ui.input_mut(|input| input.consume_key(Modifiers::NONE, Key::Escape)) {
            return Some(Deed::Cancel);
        }
        // A button that has the focus is pressed by Enter.
        let focused = ui.memory(|memory| memory.focused());
        let is_on_button = focused.is_some_and(|id| id != field_id());
        if is_on_button || !ui.input_mut(|input| input.consume_key(Modifiers::NONE, Key::Enter)) {
            return None;
        }
        match self.chosen {
            Some(row) => self.take_row(row),
            None => self.take_typed(),
        }
    }

    fn rows_ui(&mut self, ui: &mut Ui) -> Option<Deed> {
        let mut deed = None;
        let (mut clicked, mut opened) = (None, None);
        let palette = theme::of(ui);
        Frame::new().fill(palette.base).corner_radius(theme::RADIUS).inner_margin(4.0).show(
            ui,
            |ui| {
                ui.set_min_height(LIST_PT);
                ui.spacing_mut().item_spacing.y = 0.0;
                let scroll = ScrollArea::vertical().max_height(LIST_PT).auto_shrink(false);
                scroll.show(ui, |ui| {
                    for row in 0..self.n_rows() {
                        let (name, is_folder, is_lit) = self.row(row);
                        let reveal = self.chosen == Some(row) && self.note_reveal(ui);
                        let response = file_row_ui(ui, &name, is_folder, is_lit, reveal);
                        if response.double_clicked() {
                            opened = Some(row);
                        } else if response.clicked() {
                            clicked = Some(row);
                        }
                    }
                    let words = match &self.rows {
                        Rows::Coming(_) => Some("Reading the folder\u{2026}".to_owned()),
                        Rows::Failed(why) => Some(why.clone()),
                        Rows::There { n_left_out: 0, entries } if entries.is_empty() => {
                            Some(format!("No {} here", self.ask.kind_of_files().to_lowercase()))
                        }
                        Rows::There { n_left_out: 0, .. } => None,
                        Rows::There { n_left_out, entries } => Some(format!(
                            "The first {} are listed; {n_left_out} more are not. Type the name.",
                            entries.len()
                        )),
                    };
                    if let Some(words) = words {
                        ui.label(RichText::new(words).color(palette.faint));
                    }
                });
            },
        );
        if let Some(row) = clicked {
            self.choose(row);
            self.toggle_mark(row);
        }
        if let Some(row) = opened {
            deed = self.take_row(row);
        }
        deed
    }

    fn note_ui(&self, ui: &mut Ui) {
        let palette = theme::of(ui);
        let n_marked = self.marked.len();
        let (words, color) = match &self.note {
            Some(note) => (note.clone(), ui.visuals().warn_fg_color),
            None if n_marked == 1 => ("1 file chosen".to_owned(), palette.faint),
            None if n_marked > 1 => (format!("{n_marked} files chosen"), palette.faint),
            None => (" ".to_owned(), palette.faint),
        };
        ui.label(RichText::new(words).color(color));
    }

    /// Whether an arrow key has just moved the choice, which must then be in sight.
    fn note_reveal(&self, ui: &Ui) -> bool {
        // A click is in sight already.
        !ui.input(|input| input.pointer.any_down() || input.pointer.any_released())
    }

    fn has_up(&self) -> bool {
        self.folder.parent().is_some()
    }

    fn n_rows(&self) -> usize {
        let n_entries = match &self.rows {
            Rows::There { entries, .. } => entries.len(),
            Rows::Coming(_) | Rows::Failed(_) => 0,
        };
        n_entries + usize::from(self.has_up())
    }

    fn entry(&self, row: usize) -> Option<&FolderEntry> {
        let Rows::There { entries, .. } = &self.rows else { return None };
        entries.get(row.checked_sub(usize::from(self.has_up()))?)
    }

    /// A row's name, whether it is a folder, and whether it is lit.
    fn row(&self, row: usize) -> (String, bool, bool) {
        let is_chosen = self.chosen == Some(row);
        match self.entry(row) {
            Some(e) => (e.name.clone(), e.is_folder, is_chosen || self.marked.contains(&e.path)),
            None => (UP.to_owned(), true, is_chosen),
        }
    }

    /// Puts the choice on a row, and the row into the field.
    fn choose(&mut self, row: usize) {
        self.chosen = Some(row);
        self.wants_focus = true;
        (self.may_replace, self.note) = (None, None);
        let takes_folders = self.ask.wanted() == Wanted::Folder;
        if let Some(entry) = self.entry(row).filter(|entry| takes_folders || !entry.is_folder) {
            self.typed = entry.path.to_string_lossy().into_owned();
        }
    }

    fn toggle_mark(&mut self, row: usize) {
        if self.ask.wanted() != Wanted::Files {
            return;
        }
        if let Some(entry) = self.entry(row).filter(|entry| !entry.is_folder) {
            let path = entry.path.clone();
            if !self.marked.remove(&path) {
                self.marked.insert(path);
            }
        }
    }

    fn take_row(&mut self, row: usize) -> Option<Deed> {
        let Some(entry) = self.entry(row).cloned() else {
            return self.folder.parent().map(|above| Deed::Enter(above.to_owned()));
        };
        if entry.is_folder {
            return Some(Deed::Enter(entry.path));
        }
        self.marked.insert(entry.path.clone());
        Some(Deed::Take(match self.ask.wanted() {
            Wanted::Files => self.marked.iter().cloned().collect(),
            _ => vec![entry.path],
        }))
    }

    fn take_typed(&mut self) -> Option<Deed> {
        if !self.marked.is_empty() && self.ask.wanted() == Wanted::Files {
            return Some(Deed::Take(self.marked.iter().cloned().collect()));
        }
        // A name that is no text is only what it looks like in the field.
        let chosen = self.chosen.and_then(|row| self.entry(row));
        let chosen = chosen.filter(|e| e.path.to_string_lossy() == self.typed.as_str());
        let path = chosen.map_or_else(|| self.typed_path(), |entry| entry.path.clone());
        if path.is_dir() && self.ask.wanted() != Wanted::Folder {
            return Some(Deed::Enter(path));
        }
        Some(Deed::Take(vec![path]))
    }

    /// What is typed, from the folder that is listed, without detours.
    fn typed_path(&self) -> PathBuf {
        let mut whole = PathBuf::new();
        for part in self.folder.join(self.typed.trim()).components() {
            match part {
                Component::ParentDir => drop(whole.pop()),
                Component::CurDir => {}
                other => whole.push(other),
            }
        }
        whole
    }

    /// The file's name in what is typed.
    fn typed_name(&self) -> String {
        let name = self.typed.rsplit(std::path::is_separator).next().unwrap_or_default();
        if name.is_empty() { self.ask.suggested().to_owned() } else { name.to_owned() }
    }

    /// Gives what was taken, if it is what is wanted; says why not otherwise.
    fn accept(&mut self, mut paths: Vec<PathBuf>) -> Option<Vec<PathBuf>> {
        let wanted = self.ask.wanted();
        for path in &mut paths {
            let name = path.file_name().unwrap_or_default().to_string_lossy().into_owned();
            let refusal = match wanted {
                Wanted::Folder if path.is_dir() => None,
                Wanted::Folder => Some("there is no such folder; choose one from the list".into()),
                Wanted::File | Wanted::Files if path.is_file() => None,
                Wanted::File | Wanted::Files => {
                    Some(format!("there is no file \"{name}\" here; check the name"))
                }
                Wanted::NewFile => self.refusal_of_new(path),
            };
            if refusal.is_some() {
                self.note = refusal;
                return None;
            }
        }
        Some(paths)
    }

    /// Why a new file cannot be written at `path`, which gets its ending.
    fn refusal_of_new(&mut self, path: &mut PathBuf) -> Option<String> {
        let endings = self.ask.endings();
        let ending = path.extension().map(|e| e.to_string_lossy().to_lowercase());
        let fits = ending.is_some_and(|ending| endings.contains(&ending.as_str()));
        if let (false, Some(ending)) = (fits, endings.first()) {
            // Not `set_extension`: "walk 1.5" has none.
            let mut whole = path.clone().into_os_string();
            whole.push(format!(".{ending}"));
            *path = PathBuf::from(whole);
        }
        if !path.parent().is_some_and(Path::is_dir) {
            return Some("there is no such folder; choose one from the list".to_owned());
        }
        if path.exists() && self.may_replace.as_deref() != Some(path) {
            let name = path.file_name().unwrap_or_default().to_string_lossy().into_owned();
            self.may_replace = Some(path.clone());
            return Some(format!("\"{name}\" is there already; Enter again replaces it"));
        }
        None
    }

    /// Goes to another folder, with a file's name typed.
    fn enter(&mut self, folder: &Path, name: &str) {
        let mut typed = folder.to_string_lossy().into_owned();
        if !typed.ends_with(MAIN_SEPARATOR) {
            typed.push(MAIN_SEPARATOR);
        }
        self.typed = typed + name;
        self.wants_focus = true;
        self.list(folder);
    }

    fn list(&mut self, folder: &Path) {
        self.folder = folder.components().collect();
        (self.chosen, self.may_replace, self.note) = (None, None, None);
        self.marked.clear();
        let (sender, coming) = sync_channel(1);
        let (folder, endings) = (self.folder.clone(), self.ask.endings());
        // A disk may be slow, and the window never waits.
        let work = move || drop(sender.send(FolderList::read(&folder, endings)));
        let started = thread::Builder::new().name("folder".to_owned()).spawn(work);
        self.rows = match started {
            Ok(_) => Rows::Coming(coming),
            Err(error) => Rows::Failed(format!("the system has no thread to give ({error})")),
        };
    }

    fn take_in_rows(&mut self, ctx: &egui::Context) {
        let Rows::Coming(coming) = &self.rows else { return };
        match coming.try_recv() {
            Ok(Ok(FolderList { entries, n_left_out })) => {
                self.rows = Rows::There { entries, n_left_out };
            }
            Ok(Err(error)) => self.rows = Rows::Failed(error.to_string()),
            Err(TryRecvError::Empty) => ctx.request_repaint(),
            Err(TryRecvError::Disconnected) => {
                self.rows =
                    Rows::Failed("reading the folder has failed; please report this".into());
            }
        }
    }
}

fn field_id() -> Id {
    Id::unique("path dialog field")
}

/// Gives the field the keys, with the cursor behind what it says.
fn focus_at_end(ctx: &egui::Context, n_chars: usize) {
    let mut state = TextEdit::load_state(ctx, field_id()).unwrap_or_default();
    state.cursor.set_char_range(Some(CCursorRange::one(CCursor::new(n_chars))));
    state.store(ctx, field_id());
    ctx.memory_mut(|memory| memory.request_focus(field_id()));
}
