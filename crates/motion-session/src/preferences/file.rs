//! The file of preferences.
//!
//! It is JSON, one member a preference. Several windows may write it: each writes what it changed
//! itself into what is there by then, whole or not at all. Members that are not known here, of a
//! newer version, stay as they are.

use std::io::ErrorKind;
use std::path::{Path, PathBuf};
use std::thread::{self, JoinHandle};

use motion_io::atomic_write::atomic_write;
use motion_io::diagnostic::FileError;
use motion_io::read_file::read_file;
use serde_json::{Map, Value};

use super::Preferences;

const NAME: &str = "settings.json";
/// What a file that cannot be understood is called from then on.
const BROKEN: &str = "settings.broken";
const MAX_BYTES: u64 = 1 << 20;
/// So long nothing must change before it is written: a slider that is dragged writes once.
const QUIET_SECS: f64 = 1.0;

/// Preferences, and the file they are remembered in.
#[derive(Debug)]
pub struct PreferencesFile {
    preferences: Preferences,
    /// As they were when they were last read or written; what differs is our change.
    saved: Preferences,
    path: PathBuf,
    /// Why the file must not be replaced, if so.
    kept_off: Option<FileError>,
    quiet_secs: f64,
    writing: Option<JoinHandle<Written>>,
    remarks: Vec<String>,
}

/// What was written, or why not; and what was odd.
type Written = (Result<Preferences, FileError>, Vec<String>);

impl PreferencesFile {
    /// Reads what is remembered in `folder`, which need not be there. What cannot be read is set
    /// aside and said as a remark; then there are the usual preferences.
    pub fn open(folder: &Path) -> Self {
        let path = folder.join(NAME);
        let mut remarks = Vec::new();
        let (members, kept_off) = match read_members(&path, &mut remarks) {
            Ok(members) => (members, None),
            Err(error) => {
                remarks.push(format!("the settings are the usual ones: {error}"));
                (Map::new(), Some(error))
            }
        };
        let preferences = decode(&members, &path, &mut remarks);
        let saved = preferences.clone();
        Self { preferences, saved, path, kept_off, quiet_secs: 0.0, writing: None, remarks }
    }

    /// What is remembered.
    pub fn get(&self) -> &Preferences {
        &self.preferences
    }

    /// Changes something. It is written a second after the last change, by [`poll`](Self::poll).
    pub fn change(&mut self, change: impl FnOnce(&mut Preferences)) {
        let before = self.preferences.clone();
        change(&mut self.preferences);
        self.preferences.clamp();
        if self.preferences != before {
            self.quiet_secs = 0.0;
        }
    }

    /// Sentences for the log, each once.
    pub fn take_remarks(&mut self) -> Vec<String> {
        std::mem::take(&mut self.remarks)
    }

    /// To be called once a frame with the seconds since the last. Writes what has changed on a
    /// thread of its own; never waits.
    pub fn poll(&mut self, dt_secs: f64) {
        if self.writing.as_ref().is_some_and(JoinHandle::is_finished)
            && let Err(error) = self.finish_writing()
        {
            self.remarks.push(format!("the settings are not remembered: {error}"));
            // Once is enough until something else changes.
            self.saved = self.preferences.clone();
        }
        self.quiet_secs += dt_secs.max(0.0);
        let is_due = self.preferences != self.saved && self.quiet_secs >= QUIET_SECS;
        if is_due && self.writing.is_none() && self.kept_off.is_none() {
            let (path, ours) = (self.path.clone(), self.preferences.clone());
            let before = self.saved.clone();
            let work = move || write(&path, &ours, &before);
            // Without a thread it is written when the window closes.
            self.writing = thread::Builder::new().name("settings".to_owned()).spawn(work).ok();
            self.quiet_secs = 0.0;
        }
    }

    /// Writes what has changed, now, and waits until it is on the disk. For when the window closes.
    pub fn save(&mut self) -> Result<(), FileError> {
        let _earlier = self.finish_writing();
        if self.preferences == self.saved {
            return Ok(());
        }
        if let Some(error) = &self.kept_off {
            return Err(error.clone());
        }
        let (written, remarks) = write(&self.path, &self.preferences, &self.saved);
        self.take_in(written, remarks)
    }

    fn finish_writing(&mut self) -> Result<(), FileError> {
        let Some(thread) = self.writing.take() else { return Ok(()) };
        match thread.join() {
            Ok((written, remarks)) => self.take_in(written, remarks),
            Err(_panic) => {
                Err(FileError::new(&self.path, "writing it has failed", "please report this"))
            }
        }
    }

    fn take_in(
        &mut self,
        written: Result<Preferences, FileError>,
        remarks: Vec<String>,
    ) -> Result<(), FileError> {
        self.remarks.extend(remarks);
        self.saved = written?;
        Ok(())
    }
}

/// Writes what differs between `ours` and `before` into what the file has by now. Gives `ours`.
fn write(path: &Path, ours: &Preferences, before: &Preferences) -> Written {
    let mut remarks = Vec::new();
    let written = write_members(path, ours, before, &mut remarks);
    (written.map(|()| ours.clone()), remarks)
}

fn write_members(
    path: &Path,
    ours: &Preferences,
    before: &Preferences,
    remarks: &mut Vec<String>,
) -> Result<(), FileError> {
    let mut members = read_members(path, remarks)?;
    // What is odd in it was said when it was read first.
    let theirs = decode(&members, path, &mut Vec::new());
    let mut merged = ours.clone();
    merged.recent = ours.recent.merged(&before.recent, &theirs.recent);
    let (merged, before) = (encode(&merged), encode(before));
    for (key, value) in merged {
        let is_changed = before.get(&key) != Some(&value);
        if is_changed || !members.contains_key(&key) {
            members.insert(key, value);
        }
    }
    if let Some(folder) = path.parent() {
        std::fs::create_dir_all(folder).map_err(|error| FileError::writing(folder, &error))?;
    }
    let text = format!("{:#}\n", Value::Object(members));
    atomic_write(path, text.as_bytes())
}

/// The members of the file; none where there is no file, or where it was no JSON: then it is set
/// aside. Fails where it cannot be read or set aside, and so must not be replaced.
fn read_members(path: &Path, remarks: &mut Vec<String>) -> Result<Map<String, Value>, FileError> {
    match std::fs::metadata(path) {
        Err(error) if error.kind() == ErrorKind::NotFound => return Ok(Map::new()),
        Ok(metadata) if metadata.len() > MAX_BYTES => return set_aside(path, remarks),
        _ => {}
    }
    let bytes = read_file(path, MAX_BYTES)?;
    match serde_json::from_slice(&bytes) {
        Ok(Value::Object(members)) => Ok(members),
        _ => set_aside(path, remarks),
    }
}

fn set_aside(path: &Path, remarks: &mut Vec<String>) -> Result<Map<String, Value>, FileError> {
    let numbered = (2..1000).map(|nth| format!("{BROKEN}-{nth}"));
    let names = std::iter::once(BROKEN.to_owned()).chain(numbered);
    let free = names.map(|name| path.with_file_name(name)).find(|path| !path.exists());
    let Some(aside) = free else {
        let what = "it is broken, and so are a thousand before it";
        return Err(FileError::new(path, what, "delete what is named settings.broken"));
    };
    match std::fs::rename(path, &aside) {
        Ok(()) => {
            let name = aside.file_name().unwrap_or_default().to_string_lossy();
            remarks.push(format!(
                "the settings could not be read and are the usual ones now; the file is kept as \
                 {name}"
            ));
            Ok(Map::new())
        }
        // Another window was first.
        Err(error) if error.kind() == ErrorKind::NotFound => Ok(Map::new()),
        Err(error) => Err(FileError::writing(&aside, &error)),
    }
}

fn encode(preferences: &Preferences) -> Map<String, Value> {
    match serde_json::to_value(preferences) {
        Ok(Value::Object(members)) => members,
        // Nothing in them refuses to be written; then nothing is.
        _ => Map::new(),
    }
}

/// Preferences of a file, member by member: what one says wrongly costs only that one.
fn decode(members: &Map<String, Value>, path: &Path, remarks: &mut Vec<String>) -> Preferences {
    let mut known = encode(&Preferences::default());
    let mut preferences = Preferences::default();
    for (key, value) in members {
        let Some(usual) = known.get(key).cloned() else { continue };
        known.insert(key.clone(), value.clone());
        match serde_json::from_value(Value::Object(known.clone())) {
            Ok(read) => preferences = read,
            Err(_misfit) => {
                known.insert(key.clone(), usual);
                remarks.push(format!(
                    "{}: \"{key}\" says nothing that is known here; the usual is taken",
                    path.display()
                ));
            }
        }
    }
    preferences.clamp();
    preferences
}
