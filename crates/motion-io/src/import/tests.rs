//! Imports of small folders, and of the real one where it is.

use std::io::Write as _;
use std::path::Path;
use std::sync::Mutex;

use glam::Quat;

use super::*;
use crate::bvh::{BvhWriteOptions, write};
use crate::guess::test_body::body;
use motion_core::motion::Motion;

/// A body that walks along +X with swinging joints, 40 frames.
pub(super) fn walk(skeleton: &Skeleton, fps: Fps, phase: f32) -> Motion {
    let n_frames = 40;
    let rotations = (0..n_frames).flat_map(|f| {
        let angle = 0.3 * (0.2 * f as f32 + phase).sin();
        std::iter::repeat_n(Quat::from_rotation_x(angle), skeleton.n_joints())
    });
    let rotations = rotations.collect();
    let positions = (0..n_frames).map(|f| glam::Vec3::new(0.02 * f as f32, 0.93, 0.0)).collect();
    Motion::new(fps, skeleton.n_joints(), positions, rotations).unwrap()
}

pub(super) struct Folder(tempfile::TempDir);

impl Folder {
    pub(super) fn new() -> Self {
        Self(tempfile::tempdir().unwrap())
    }

    pub(super) fn path(&self) -> &Path {
        self.0.path()
    }

    pub(super) fn text(&self, name: &str, text: &str) -> &Self {
        let path = self.path().join(name);
        std::fs::create_dir_all(path.parent().unwrap()).unwrap();
        std::fs::File::create(path).unwrap().write_all(text.as_bytes()).unwrap();
        self
    }

    pub(super) fn clip(&self, name: &str, skeleton: &Skeleton, phase: f32) -> &Self {
        let motion = walk(skeleton, Fps::new(60.0).unwrap(), phase);
        self.text(name, &write(skeleton, &motion, &BvhWriteOptions::default()))
    }

    fn import(&self, options: &ImportOptions) -> Result<Imported, ImportError> {
        import_files(&[self.path().to_owned()], options, &|_| ControlFlow::Continue(()))
    }

    /// Report lines without the folder's name.
    fn report(&self, imported: &Imported) -> Vec<String> {
        let folder = format!("{}/", self.path().display());
        imported.report.lines().iter().map(|l| l.to_string().replace(&folder, "")).collect()
    }
}

#[test]
fn clips_are_named_tagged_resampled_and_brought_to_one_body() {
    let folder = Folder::new();
    folder
        .clip("walk_a.bvh", &body(1.0), 0.0)
        .clip("walk_b.bvh", &body(1.0), 1.0)
        .clip("big.bvh", &body(1.25), 2.0)
        .text("INDEX.tsv", "file\tdescription\nbig.bvh\tWalk, slowly\n")
        .text("notes.txt", "not a motion");
    let imported = folder.import(&ImportOptions::default()).unwrap();
    let ids: Vec<&str> = imported.clips.iter().map(|c| c.id.as_str()).collect();
    assert_eq!(ids, ["big", "walk_a", "walk_b"]);
    assert_eq!(imported.clips[0].tags, ["big", "walk", "slowly"]);
    assert_eq!(imported.clips[1].motion.n_frames(), 20);
    assert!(imported.skeleton.joints()[1].offset_m.distance(body(1.0).joints()[1].offset_m) < 1e-6);
    assert_eq!(
        folder.report(&imported),
        [
            "big.bvh and 2 more: lengths are in centimetres, by the body's size",
            "big.bvh and 2 more: resampled from 60 to 30 frames per second",
            "big.bvh: another body, brought to the library's skeleton with its root's path × 0.800",
        ]
    );
    assert!(imported.warnings.is_empty());
    let (set, calibration) = imported.into_clip_set().unwrap();
    assert_eq!((set.clips().len(), set.n_frames(), calibration.tracks.len()), (3, 60, 3));
}

#[test]
fn identical_content_is_imported_once() {
    let folder = Folder::new();
    folder.clip("a.bvh", &body(1.0), 0.0).clip("b.bvh", &body(1.0), 0.0);
    let imported = folder.import(&ImportOptions::default()).unwrap();
    assert_eq!(imported.clips.len(), 1);
    let report = folder.report(&imported);
    assert_eq!(report.last().unwrap(), "b.bvh: the same as a.bvh, imported once");
}

#[test]
fn two_files_of_one_stem_are_refused_with_both_paths() {
    let folder = Folder::new();
    folder.clip("x/a.bvh", &body(1.0), 0.0).clip("y/a.bvh", &body(1.0), 1.0);
    let options = ImportOptions { recursive: true, ..ImportOptions::default() };
    let error = folder.import(&options).unwrap_err().to_string();
    let name = folder.path().display();
    assert_eq!(
        error,
        format!(
            "{name}/y/a.bvh: its clip is called \"a\", as that of {name}/x/a.bvh; rename one of \
             the files"
        )
    );
}

#[test]
fn another_hierarchy_is_retargeted() {
    let folder = Folder::new();
    let mut joints = body(1.0).joints().to_vec();
    joints[9].name = "mixamorig:Head".to_owned();
    joints[8].name = "mixamorig:Neck".to_owned();
    let other = Skeleton::new(joints).unwrap();
    folder
        .clip("a.bvh", &body(1.0), 0.0)
        .clip("b.bvh", &body(1.0), 1.0)
        .clip("c.bvh", &other, 0.0)
        .clip("d.bvh", &body(1.0), 2.0);
    let imported = folder.import(&ImportOptions::default()).unwrap();
    // The same walk as a, its content another one by its joints' names.
    let (a, c) = (&imported.clips[0].motion, &imported.clips[2].motion);
    let skeleton = &imported.skeleton;
    let (a, c) = (a.joint_positions_m(skeleton), c.joint_positions_m(skeleton));
    let worst = a.iter().zip(&c).map(|(a, c)| a.distance(*c)).fold(0.0, f32::max);
    assert!(worst < 1e-4, "{worst} m");
    assert_eq!(
        folder.report(&imported).last().unwrap(),
        "c.bvh: another hierarchy, retargeted to the library's skeleton by the parts of the body, \
         its path × 1.000"
    );
}

#[test]
fn another_hierarchy_without_parts_is_refused_with_its_joints() {
    let folder = Folder::new();
    let mut joints = body(1.0).joints().to_vec();
    joints[2].name = "Hock".to_owned();
    joints[9].name = "Snout".to_owned();
    folder.clip("a.bvh", &body(1.0), 0.0).clip("b.bvh", &body(1.0), 1.0).clip(
        "dog.bvh",
        &Skeleton::new(joints).unwrap(),
        0.0,
    );
    let error = folder.import(&ImportOptions::default()).unwrap_err().to_string();
    assert!(
        error.ends_with(
            "dog.bvh: its skeleton is not the library's: \"Hock\", \"Snout\" without counterpart \
             there, \"LeftLeg\", \"Head\" missing here, \"LeftFoot\" on another parent; leave the \
             file out, name its joints' roles (--roles), or build a library of such clips alone"
        ),
        "{error}"
    );
}

#[test]
fn the_first_bad_file_in_order_is_reported() {
    let folder = Folder::new();
    for i in 0..20 {
        folder.text(&format!("c{i:02}.bvh"), "HIERARCHY\n");
    }
    folder.clip("a.bvh", &body(1.0), 0.0);
    let error = folder.import(&ImportOptions::default()).unwrap_err().to_string();
    assert!(error.contains("c00.bvh:1: the file ends before MOTION"), "{error}");
}

#[test]
fn reserved_names_are_refused() {
    let folder = Folder::new();
    folder.clip("a@mirror.bvh", &body(1.0), 0.0);
    assert!(folder.import(&ImportOptions::default()).is_err());
}

#[test]
fn a_break_cancels() {
    let folder = Folder::new();
    folder.clip("a.bvh", &body(1.0), 0.0).clip("b.bvh", &body(1.0), 1.0);
    let calls = Mutex::new(Vec::new());
    let result =
        import_files(&[folder.path().to_owned()], &ImportOptions::default(), &|progress| {
            calls.lock().unwrap().push(progress.n_files);
            ControlFlow::Break(())
        });
    assert_eq!(result, Err(ImportError::Cancelled));
    assert!(calls.lock().unwrap().iter().all(|&n| n == 2));
}

#[test]
fn a_t_pose_and_z_up_are_mended_and_said() {
    use crate::guess::{Conform, conform};
    let skeleton = body(1.0);
    let walk = walk(&skeleton, Fps::THIRTY, 0.0);
    let n = skeleton.n_joints();
    let mut rotations = vec![Quat::IDENTITY; n];
    let mut positions = vec![walk.root_positions_m()[0]];
    for frame in 0..walk.n_frames() {
        // Far from the rest pose, so that the T-pose stands out.
        rotations.extend(
            walk.rotations(frame)
                .iter()
                .enumerate()
                .map(|(i, &q)| if i == 0 { q } else { q * Quat::from_rotation_y(0.4) }),
        );
        positions.push(walk.root_positions_m()[frame]);
    }
    let motion = Motion::new(Fps::THIRTY, n, positions, rotations).unwrap();
    let z_up = Quat::from_rotation_x(std::f32::consts::FRAC_PI_2);
    let how = Conform { scale: 1.0, world_from_file: z_up, canonical_from_rest: z_up };
    let (skeleton_z, motion_z) = conform(skeleton.clone(), motion.clone(), &how);
    let folder = Folder::new();
    folder.text("a.bvh", &write(&skeleton_z, &motion_z, &BvhWriteOptions::default()));
    let imported = folder.import(&ImportOptions::default()).unwrap();
    assert_eq!(
        folder.report(&imported),
        [
            "a.bvh: lengths are in centimetres, by the body's size",
            "a.bvh: Z was up, turned to Y up",
            "a.bvh: the rest pose was turned to face +Z",
            "a.bvh: a T-pose before the motion was left out (1 frame)",
        ]
    );
    let clip = &imported.clips[0].motion;
    assert_eq!(clip.n_frames(), motion.n_frames() - 1);
    let kept = motion.slice(1, motion.n_frames());
    let a = kept.joint_positions_m(&skeleton);
    let b = clip.joint_positions_m(&imported.skeleton);
    let worst = a.iter().zip(&b).map(|(a, b)| a.distance(*b)).fold(0.0, f32::max);
    assert!(worst < 1e-4, "{worst} m");
}

#[test]
fn the_real_clips_are_one_library() {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../../shared/mocap/cmu");
    if !folder.is_dir() {
        println!("skipped: there is no {}", folder.display());
        return;
    }
    let import = || {
        import_files(std::slice::from_ref(&folder), &ImportOptions::default(), &|_| {
            ControlFlow::Continue(())
        })
        .unwrap_or_else(|error| panic!("{error}"))
    };
    let start = std::time::Instant::now();
    let imported = import();
    println!("imported in {:?}", start.elapsed());
    for line in imported.report.lines() {
        println!("{line}");
    }
    for warning in imported.warnings.as_slice() {
        println!("{warning}");
    }
    assert_eq!(imported.clips.len(), 101);
    let n_frames: usize = imported.clips.iter().map(|c| c.motion.n_frames()).sum();
    println!("{n_frames} frames");
    assert!((13_200..13_300).contains(&n_frames));
    let leg = imported.skeleton.leg_length_m().unwrap();
    assert!((0.75..0.95).contains(&leg), "{leg}");
    let tags = |id: &str| &imported.clips.iter().find(|c| c.id == id).unwrap().tags;
    assert!(tags("16_40").contains(&"run".to_owned()));
    let pool = rayon::ThreadPoolBuilder::new().num_threads(1).build().unwrap();
    assert_eq!(pool.install(import), imported, "threads make no difference");
}
