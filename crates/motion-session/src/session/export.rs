//! Motions of takes as files that other programs read, and what such a file gives back.

use std::collections::BTreeSet;
use std::fs;
use std::path::{Path, PathBuf};
use std::sync::Arc;

use motion_core::motion::Motion;
use motion_io::bvh::{self, BvhWriteOptions};
use motion_io::diagnostic::FileError;
use motion_io::limits::MAX_MOTION_FILE_BYTES;
use motion_io::project_file::fault_as_file_name;
use motion_io::read_file::read_file;

use super::Session;
use crate::document::{CharacterIdx, TakeId};

/// Which frames of a motion are written.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum ExportRange {
    /// All of them.
    #[default]
    Whole,
    /// From a frame to a frame, both included.
    Frames {
        /// The first frame.
        from: u32,
        /// The last frame.
        to: u32,
    },
}

/// What was written, and how much of it comes back.
#[derive(Clone, Debug, PartialEq)]
pub struct ExportReport {
    /// The file.
    pub path: PathBuf,
    /// Its frames.
    pub n_frames: u32,
    /// Its size, bytes.
    pub n_bytes: u64,
    /// The largest distance of a joint, read back from the file, from where it is in the motion,
    /// metres.
    pub worst_m: f32,
    /// The joint that it is of.
    pub worst_joint: String,
    /// The frame of the file that it is in.
    pub worst_frame: u32,
}

impl Session {
    /// Writes the motion of a take, with what is changed on it by hand, to a BVH file, whole or not
    /// at all; then reads the file and compares. Fails where the motion is not made for what is
    /// asked now: the file would not be what is seen.
    pub fn export_take(
        &self,
        character: CharacterIdx,
        take: TakeId,
        path: &Path,
        range: ExportRange,
    ) -> Result<ExportReport, FileError> {
        let motion = self.motion_of(character, take, path)?;
        let motion = match range {
            ExportRange::Whole => motion,
            ExportRange::Frames { from, to } => Arc::new(part_of(&motion, from, to, path)?),
        };
        self.export(&motion, path)
    }

    /// Writes the motions of all characters to a folder, which is made if it is missing: the take
    /// that is shown as `NAME.bvh`, and every take that is kept with the project as
    /// `NAME-TAKE.bvh`, by its name or else its id. Kept takes that are not possible with the
    /// library any more are left out. Nothing is written while one of the motions is not made yet.
    pub fn export_all(&self, dir: &Path) -> Result<Vec<ExportReport>, FileError> {
        let mut names = BTreeSet::new();
        let mut file = |stem: String, id: TakeId| {
            // Not every file system tells A from a.
            let is_new = names.insert(stem.to_lowercase());
            dir.join(if is_new { format!("{stem}.bvh") } else { format!("{stem}-{id}.bvh") })
        };
        let mut motions = Vec::new();
        for (nth, character) in self.document().characters().iter().enumerate() {
            let (idx, name) = (CharacterIdx(nth), &character.name);
            let Some(shown) = self.shown_of(idx) else {
                let what = format!("there is no motion of {name:?} yet");
                return Err(FileError::new(dir, what, "try again when there is one"));
            };
            let path = file(name.clone(), shown.take.id);
            motions.push((self.motion_of(idx, shown.take.id, &path)?, path));
            for take in self.document().takes().iter().filter(|take| take.character == *name) {
                let id = take.id();
                if self.snapshot().character(idx).is_none_or(|known| known.take(id).is_none()) {
                    continue;
                }
                let called = take.name.clone().unwrap_or_else(|| id.to_string());
                let stem = format!("{name}-{called}");
                let stem = match fault_as_file_name(&stem) {
                    None => stem,
                    Some(_) => format!("{name}-{id}"),
                };
                let path = file(stem, id);
                motions.push((self.motion_of(idx, id, &path)?, path));
            }
        }
        fs::create_dir_all(dir).map_err(|error| FileError::writing(dir, &error))?;
        motions.iter().map(|(motion, path)| self.export(motion, path)).collect()
    }

    /// The motion that is to be written to `path`.
    fn motion_of(
        &self,
        character: CharacterIdx,
        take: TakeId,
        path: &Path,
    ) -> Result<Arc<Motion>, FileError> {
        let known = self.snapshot().character(character);
        let (known, take) =
            known.and_then(|known| Some((known, known.take(take)?))).ok_or_else(|| {
                FileError::new(path, "there is no such take any more", "choose another one")
            })?;
        let not_yet = || {
            let what = "the take's motion is not made for what is asked now";
            FileError::new(path, what, "try again in a moment")
        };
        let made = take.made.as_ref().filter(|_| !known.is_stale(take)).ok_or_else(not_yet)?;
        // What is made for the library before this one is about to be made anew.
        let fits =
            |ready: &crate::live::ReadyLibrary| ready.skeleton.n_joints() == made.motion.n_joints();
        self.library().filter(|ready| fits(ready)).ok_or_else(not_yet)?;
        Ok(Arc::clone(&made.motion))
    }

    fn export(&self, motion: &Motion, path: &Path) -> Result<ExportReport, FileError> {
        let Some(ready) = self.library() else {
            let what = "the library is not there any more";
            return Err(FileError::new(path, what, "try again when it is"));
        };
        let options = BvhWriteOptions::default();
        bvh::save(path, &ready.skeleton, motion, &options)?;
        let bytes = read_file(path, MAX_MOTION_FILE_BYTES)?;
        let back = bvh::round_trip(&bytes, path, &ready.skeleton, motion, &options)?;
        let frames = |n: usize| u32::try_from(n).unwrap_or(u32::MAX);
        Ok(ExportReport {
            path: path.to_owned(),
            n_frames: frames(motion.n_frames()),
            n_bytes: bytes.len() as u64,
            worst_m: back.worst_m,
            worst_joint: ready.skeleton.joint(back.joint).name.clone(),
            worst_frame: frames(back.frame),
        })
    }
}

fn part_of(motion: &Motion, from: u32, to: u32, path: &Path) -> Result<Motion, FileError> {
    let last = motion.n_frames() - 1;
    if from > to || to as usize > last {
        let what = format!("frames {from} to {to} are not among the motion's 0 to {last}");
        return Err(FileError::new(path, what, "choose others"));
    }
    Ok(motion.slice(from as usize, to as usize + 1))
}

#[cfg(test)]
mod tests {
    use motion_core::by_hand::Knot;

    use super::super::tests::{has_motion, session, until};
    use super::*;
    use crate::command::Command;

    #[test]
    fn what_is_exported_is_what_is_seen_and_comes_back() {
        let dir = tempfile::tempdir().unwrap();
        let mut session = session(None);
        until(&mut session, "with a motion", has_motion);
        session.search().pause();
        let (hero, take) = (CharacterIdx(0), session.shown().unwrap().take.clone());
        session.pick(hero, take.id);
        let knots = Some(vec![Knot { output: 40, source: 20.0 }]);
        let stored = take.stored("A");
        session.apply(&Command::RetimeByHand { take: stored.clone(), knots }).unwrap();
        session.apply(&Command::NameTake { take: stored, name: Some("late/one".into()) }).unwrap();
        let path = dir.path().join("a.bvh");
        until(&mut session, "retimed", |s| {
            let shown = s.shown().filter(|shown| shown.take.id == take.id);
            shown.is_some_and(|s| s.take.made.as_ref().is_some_and(|made| made.by_hand.is_some()))
        });
        let report = session.export_take(hero, take.id, &path, ExportRange::Whole).unwrap();
        assert_eq!(report.n_frames, take.n_frames + 20);
        assert_eq!(report.n_bytes, fs::metadata(&path).unwrap().len());
        assert!(report.worst_m < 1e-4, "{report:?}");
        let part = ExportRange::Frames { from: 10, to: 19 };
        let report = session.export_take(hero, take.id, &path, part).unwrap();
        assert_eq!((report.n_frames, &report.path), (10, &path));
        let beyond = ExportRange::Frames { from: 10, to: 9_999 };
        let error = session.export_take(hero, take.id, &path, beyond).unwrap_err();
        assert!(error.what.starts_with("frames 10 to 9999 are not among"), "{error}");
        assert!(session.export_take(hero, TakeId(0), &path, part).is_err());

        let all = session.export_all(&dir.path().join("new")).unwrap();
        let names: Vec<String> =
            all.iter().map(|r| r.path.file_name().unwrap().to_string_lossy().into()).collect();
        assert_eq!(names, ["A.bvh".to_owned(), format!("A-{}.bvh", take.id)]);
        assert!(all.iter().all(|r| r.n_frames == take.n_frames + 20 && r.worst_m < 1e-4));
    }
}
