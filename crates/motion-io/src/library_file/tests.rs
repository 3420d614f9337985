//! Library files there and back, and damaged ones.

use std::ops::ControlFlow;
use std::time::Instant;

use glam::{Quat, Vec3};
use motion_core::cancel::CancelToken;
use motion_core::graph::{BuildOptions, build};
use motion_core::motion::Motion;
use motion_core::rotation;
use motion_core::skeleton::Skeleton;
use motion_core::units::Fps;

use super::*;
use crate::guess::test_body::body;
use crate::import::{ImportOptions, Imported, ImportedClip, Report, import_files};

fn graph_of(clips: &ClipSet) -> MotionGraph {
    build(clips, &BuildOptions::default(), &CancelToken::new(), &|_| ()).unwrap()
}

pub(super) fn small() -> LibraryFile {
    let skeleton: Skeleton = body(1.0);
    let n = skeleton.n_joints();
    let clip = |name: &str, seed: f32| {
        let rotations: Vec<Quat> = (0..10 * n)
            .map(|i| rotation::exp(Vec3::new((seed * i as f32).sin(), 0.3 * seed, 0.01 * i as f32)))
            .collect();
        let positions = (0..10).map(|f| Vec3::new(0.1 * f as f32, 0.9, seed)).collect();
        ImportedClip {
            id: name.to_owned(),
            source: name.into(),
            content_hash: ContentHash::of(name.as_bytes()),
            motion: Motion::new(Fps::THIRTY, n, positions, rotations).unwrap(),
            tags: vec!["walk".to_owned(), name.to_owned()],
        }
    };
    let imported = Imported {
        skeleton,
        fps: Fps::THIRTY,
        clips: vec![clip("a", 0.7), clip("b", 1.3)],
        report: Report::default(),
        warnings: crate::diagnostic::Warnings::new(),
    };
    let content_hashes = imported.clips.iter().map(|clip| clip.content_hash).collect();
    let (clips, _) = imported.into_clip_set().unwrap();
    let graph = graph_of(&clips);
    LibraryFile { clips, content_hashes, graph }
}

#[test]
fn a_library_comes_back_to_the_last_bit() {
    let library = small();
    let (bytes, hash) = library.to_bytes();
    let (again, hash_read) = LibraryFile::from_bytes(&bytes, Path::new("a.gwlib")).unwrap();
    assert_eq!(again, library);
    assert_eq!(hash_read, hash);
    assert_eq!(again.to_bytes(), (bytes, hash));
}

#[test]
fn a_library_is_saved_and_loaded_with_its_hash() {
    let dir = tempfile::tempdir().unwrap();
    let path = dir.path().join("a.gwlib");
    let saved = small().save(&path).unwrap();
    let (library, loaded) = LibraryFile::load(&path).unwrap();
    assert_eq!((library, loaded), (small(), saved));
}

#[test]
fn sections_with_right_checksums_and_wrong_content_are_refused() {
    // Each section in turn cut, emptied or with one byte changed, its checksum made anew.
    let (bytes, _) = small().to_bytes();
    let path = Path::new("a.gwlib");
    let container = Container::read(&bytes, path, FORMAT_VERSION).unwrap();
    let names: Vec<&str> = container.names().collect();
    for damaged_name in &names {
        let section = container.find(damaged_name).unwrap();
        for at in (0..section.len()).step_by(7) {
            for change in 0..3 {
                let mut changed = section.to_vec();
                match change {
                    0 => changed.truncate(at),
                    1 => changed[at] = 0xff,
                    _ => changed[at] ^= 0x40,
                }
                let mut writer = ContainerWriter::new();
                for name in &names {
                    let bytes = container.find(name).unwrap().to_vec();
                    writer.add(name, if name == damaged_name { changed.clone() } else { bytes });
                }
                // Some changes make another valid library; none may panic.
                let result = LibraryFile::from_bytes(&writer.finish(FORMAT_VERSION).0, path);
                assert!(change > 0 || result.is_err(), "{damaged_name} cut at {at}");
            }
        }
    }
}

#[test]
fn the_real_clips_come_back() {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../../shared/mocap/cmu");
    if !folder.is_dir() {
        println!("skipped: there is no {}", folder.display());
        return;
    }
    let go_on = |_| ControlFlow::Continue(());
    let imported = import_files(&[folder], &ImportOptions::default(), &go_on).unwrap();
    let content_hashes = imported.clips.iter().map(|clip| clip.content_hash).collect();
    let (clips, _) = imported.into_clip_set().unwrap();
    let graph = graph_of(&clips);
    let n_edges = graph.forest.n_nodes();
    let library = LibraryFile { clips, content_hashes, graph };
    let (bytes, _) = library.to_bytes();
    let start = Instant::now();
    let (again, _) = LibraryFile::from_bytes(&bytes, Path::new("cmu.gwlib")).unwrap();
    println!("{n_edges} edges, {} bytes read in {:?}", bytes.len(), start.elapsed());
    assert!(again == library, "the clips of the file are those that were saved");
}
