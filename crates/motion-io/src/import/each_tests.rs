//! Imports of which a part is refused, and that join a library.

use motion_core::skeleton::{Joint, Skeleton};

use super::tests::Folder;
use super::*;
use crate::guess::test_body::body;

/// What became of each file, in words, without the folder's name.
fn told(folder: &Folder, files: &[FileFate]) -> Vec<String> {
    let base = format!("{}/", folder.path().display());
    let line = |file: &FileFate| {
        let what = match &file.fate {
            Fate::Imported { id, n_frames, is_brought, .. } => {
                format!("{id}, {n_frames} frames{}", if *is_brought { ", brought" } else { "" })
            }
            Fate::Same(id) => format!("the same as {id}"),
            Fate::Refused(error) => error.what.clone(),
        };
        format!("{}: {what}", file.path.display()).replace(&base, "")
    };
    files.iter().map(line).collect()
}

fn each(inputs: &[PathBuf], joined: Option<&Joined<'_>>) -> EachImported {
    import_each(inputs, &ImportOptions::default(), joined, &|_| ControlFlow::Continue(())).unwrap()
}

#[test]
fn every_file_has_its_fate_and_none_stands_in_the_way() {
    let folder = Folder::new();
    let mut dog: Vec<Joint> = body(1.0).joints().to_vec();
    dog[2].name = "Hock".to_owned();
    dog[9].name = "Snout".to_owned();
    folder
        .clip("a.bvh", &body(1.0), 0.0)
        .clip("b.bvh", &body(1.0), 0.0)
        .clip("big.bvh", &body(1.25), 1.0)
        .clip("c.bvh", &body(1.0), 2.0)
        .text("cut.bvh", "HIERARCHY\n")
        .clip("dog.bvh", &Skeleton::new(dog).unwrap(), 1.0)
        .clip("sub/a.bvh", &body(1.0), 3.0)
        .text("notes.txt", "");
    let at = |name: &str| folder.path().join(name);
    let inputs = [folder.path().to_owned(), at("sub"), at("notes.txt"), at("none")];
    let imported = each(&inputs, None);
    let files = told(&folder, &imported.files);
    assert_eq!(
        files[..5],
        [
            "a.bvh: a, 20 frames",
            "b.bvh: the same as a",
            "big.bvh: big, 20 frames, brought",
            "c.bvh: c, 20 frames",
            "cut.bvh: the file ends before MOTION",
        ]
    );
    assert!(files[5].starts_with("dog.bvh: its skeleton is not the library's: "), "{}", files[5]);
    assert!(
        files[6].starts_with("sub/a.bvh: its clip is called \"a\", as that of "),
        "{}",
        files[6]
    );
    assert_eq!(files[7], "notes.txt: it is not a kind of motion file that can be read");
    assert_eq!(files[8], "none: there is no such file");
    let ids: Vec<&str> = imported.clips.iter().map(|clip| clip.id.as_str()).collect();
    assert_eq!(ids, ["a", "big", "c"]);
}

#[test]
fn clips_that_join_others_come_to_their_skeleton_under_other_names() {
    let (there, new) = (Folder::new(), Folder::new());
    there.clip("a.bvh", &body(1.0), 0.0).clip("b.bvh", &body(1.0), 1.0);
    let first = each(&[there.path().to_owned()], None);
    let skeleton = first.skeleton.unwrap();
    let joined = Joined {
        skeleton: &skeleton,
        some_motion: Some(&first.clips[0].motion),
        clips: first.clips.iter().map(|c| (c.id.as_str(), c.content_hash)).collect(),
        n_frames: 40,
    };
    new.clip("a.bvh", &body(1.25), 0.0)
        .clip("copy.bvh", &body(1.0), 1.0)
        .clip("d.bvh", &body(1.25), 2.0)
        .clip("e.bvh", &body(1.25), 3.0);
    let second = each(&[new.path().to_owned()], Some(&joined));
    assert_eq!(
        told(&new, &second.files),
        [
            "a.bvh: its clip is called \"a\", as one of the library, and is another one",
            "copy.bvh: the same as b",
            "d.bvh: d, 20 frames, brought",
            "e.bvh: e, 20 frames, brought",
        ]
    );
    assert_eq!(second.skeleton, Some(skeleton));
}

#[test]
fn nothing_that_can_be_read_is_no_skeleton() {
    let folder = Folder::new();
    folder.text("cut.bvh", "HIERARCHY\n");
    let imported = each(&[folder.path().to_owned()], None);
    assert_eq!((imported.skeleton, imported.clips.len(), imported.files.len()), (None, 0, 1));
}

#[test]
fn a_break_cancels_it() {
    let folder = Folder::new();
    folder.clip("a.bvh", &body(1.0), 0.0);
    let inputs = [folder.path().to_owned()];
    let options = ImportOptions::default();
    let stopped = import_each(&inputs, &options, None, &|_| ControlFlow::Break(()));
    assert!(stopped.is_err());
}
