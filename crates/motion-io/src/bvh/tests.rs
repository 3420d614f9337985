//! BVH in, out, and every way in which a file can be wrong.

use std::path::PathBuf;

use glam::{Quat, Vec3};
use motion_core::rotation;
use proptest::prelude::*;

use super::*;
use crate::diagnostic::Warnings;

/// Two joints, two frames; the second frame is on line 20.
const GOOD: &str = "HIERARCHY
ROOT Hips
{
  OFFSET 0 0 0
  CHANNELS 6 Xposition Yposition Zposition Zrotation Xrotation Yrotation
  JOINT Head
  {
    OFFSET 0 60 0
    CHANNELS 3 Zrotation Xrotation Yrotation
    End Site
    {
      OFFSET 0 20 0
    }
  }
}
MOTION
Frames: 2
Frame Time: 0.0333333
0 90 0 0 0 0 0 0 0
1 91 2 10 20 30 40 50 60
";

fn read_text(text: impl AsRef<[u8]>) -> Result<Bvh, FileError> {
    read(text.as_ref(), Path::new("a.bvh"), &mut Warnings::new())
}

fn motion_of(bvh: &Bvh, metres_per_unit: f64) -> (Skeleton, Motion) {
    bvh.to_motion(metres_per_unit, Path::new("a.bvh"), &mut Warnings::new()).expect("it was read")
}

/// The error of `GOOD` with its first `from` replaced by `to`.
#[track_caller]
fn check_error(from: &str, to: &str, expected: &str) {
    assert!(GOOD.contains(from), "{from:?} is not in the good file");
    let text = GOOD.replacen(from, to, 1);
    let error = read_text(&text).expect_err("must be refused");
    assert_eq!(error.to_string(), expected, "{from:?} -> {to:?}");
}

#[test]
fn the_good_file_is_good() {
    let bvh = read_text(GOOD).unwrap();
    assert_eq!((bvh.n_frames(), bvh.n_channels, bvh.joints.len()), (2, 9, 2));
    assert_eq!(bvh.fps, Fps::THIRTY);
    assert_eq!(bvh.joints[1].end_site, Some(DVec3::new(0.0, 20.0, 0.0)));
    assert_eq!(bvh.joints[1].first_channel, 6);
}

#[test]
fn rotations_multiply_as_listed_and_lengths_are_metres() {
    let (skeleton, motion) = motion_of(&read_text(GOOD).unwrap(), 0.01);
    assert_eq!(skeleton.joints()[1].offset_m, Vec3::new(0.0, 0.6, 0.0));
    assert_eq!(motion.root_positions_m()[1], Vec3::new(0.01, 0.91, 0.02));
    let expected = Quat::from_rotation_z(10f32.to_radians())
        * Quat::from_rotation_x(20f32.to_radians())
        * Quat::from_rotation_y(30f32.to_radians());
    assert!(rotation::angle_between_rad(motion.root_rotation(1), expected) < 1e-6);
}

#[test]
fn malformed_hierarchies_are_refused_with_their_line() {
    check_error(
        "HIERARCHY",
        "HELLO",
        "a.bvh:1: a BVH file begins with HIERARCHY, this one with \"HELLO\"; check that it is the \
         right file",
    );
    check_error("JOINT Head", "JOINT", "a.bvh:6: a joint has no name; write one behind JOINT");
    check_error(
        "JOINT Head\n  {",
        "JOINT Head\n",
        "a.bvh:8: joint \"Head\" is followed by \"OFFSET\" instead of a brace; add the missing {",
    );
    check_error(
        "OFFSET 0 60 0",
        "OFFSET 0 60",
        "a.bvh:8: OFFSET has 2 numbers instead of 3; write OFFSET x y z",
    );
    check_error(
        "OFFSET 0 60 0",
        "OFFSET 0 60 0 1",
        "a.bvh:8: OFFSET has more than 3 numbers; write OFFSET x y z",
    );
    check_error(
        "OFFSET 0 60 0",
        "OFFSET 0 six 0",
        "a.bvh:8: the OFFSET \"six\" is not a number; write numbers like 1.5 or 1e-2",
    );
    check_error(
        "OFFSET 0 60 0",
        "OFFSET 0 1e30 0",
        "a.bvh:8: the OFFSET \"1e30\" is not within ±100000; export the body in metres or \
         centimetres",
    );
    check_error(
        "OFFSET 0 60 0",
        "OFFSET 0 NaN 0",
        "a.bvh:8: the OFFSET \"NaN\" is not within ±100000; export the body in metres or \
         centimetres",
    );
    check_error(
        "    OFFSET 0 60 0\n",
        "",
        "a.bvh:6: joint \"Head\" has no OFFSET; add a line OFFSET x y z",
    );
    check_error(
        "CHANNELS 3 Z",
        "CHANNELS 7 Z",
        "a.bvh:9: CHANNELS is not followed by a number up to 6; write CHANNELS 3 Zrotation \
         Xrotation Yrotation",
    );
    check_error(
        "CHANNELS 3 Z",
        "CHANNELS 4 Z",
        "a.bvh:9: CHANNELS says 4 and lists 3; correct the number",
    );
    check_error(
        "CHANNELS 3 Z",
        "CHANNELS 2 Z",
        "a.bvh:9: CHANNELS says 2 and lists more; correct the number",
    );
    check_error(
        "CHANNELS 3 Zrotation",
        "CHANNELS 3 Wrotation",
        "a.bvh:9: \"Wrotation\" is not a channel; use Xposition to Zposition and Xrotation to \
         Zrotation",
    );
    check_error(
        "CHANNELS 3 Zrotation",
        "CHANNELS 3 Yrotation",
        "a.bvh:9: the channel \"Yrotation\" is listed twice; keep one of them",
    );
    check_error(
        "}\nMOTION",
        "}\nROOT Prop\n{\nOFFSET 0 0 0\n}\nMOTION",
        "a.bvh:16: there is a second ROOT; keep one body in a file",
    );
    check_error(
        "}\nMOTION",
        "}\nJOINT Prop\n{\nOFFSET 0 0 0\n}\nMOTION",
        "a.bvh:16: a JOINT stands outside the ROOT; put it within the braces of its parent",
    );
    check_error(
        "}\nMOTION",
        "MOTION",
        "a.bvh:15: joint \"Hips\" has no closing brace; add the missing }",
    );
    check_error(
        "}\nMOTION",
        "}\n}\nMOTION",
        "a.bvh:16: \"}\" is not expected here; write ROOT or MOTION",
    );
    check_error(
        "    End Site",
        "    Wheel",
        "a.bvh:10: \"Wheel\" is not expected within a joint; write OFFSET, CHANNELS, JOINT, End \
         Site or }",
    );
    check_error(
        "      OFFSET 0 20 0",
        "      LENGTH 20",
        "a.bvh:12: \"LENGTH\" is not expected within an End Site; write OFFSET or }",
    );
    check_error(
        "    OFFSET 0 60 0",
        "    OFFSET 0 60 0\n    OFFSET 0 60 0",
        "a.bvh:9: joint \"Head\" has a second OFFSET; keep one of them",
    );
}

#[test]
fn malformed_motions_are_refused_with_their_line() {
    check_error("MOTION\n", "", "a.bvh:16: \"Frames:\" is not expected here; write ROOT or MOTION");
    check_error(
        "Frames: 2",
        "Frames: 2147483648",
        "a.bvh:17: 2147483648 frames are more than the 1000000 that are allowed; split the motion \
         into several files",
    );
    check_error(
        "Frames: 2",
        "Frames: 99999999999999999999999999999999999999999999",
        "a.bvh:17: the number of frames \"9999999999999999999999999999999999999999…\" is not a \
         whole number; write how many lines of numbers follow",
    );
    check_error(
        "Frames: 2",
        "Frames: -2",
        "a.bvh:17: the number of frames \"-2\" is not a whole number; write how many lines of \
         numbers follow",
    );
    check_error("Frames: 2", "Frames: 0", "a.bvh:17: there are no frames; export at least one");
    check_error(
        "Frames: 2",
        "Frames: 900000",
        "a.bvh:20: the file ends after 2 of the 900000 frames that line 17 says; export it again, \
         it is cut off",
    );
    check_error(
        "Frames: 2",
        "Frames: 3",
        "a.bvh:20: the file ends after 2 of the 3 frames that line 17 says; export it again, it is \
         cut off",
    );
    check_error(
        "Frames: 2",
        "Frames: 1",
        "a.bvh:20: there are more frames than the 1 that line 17 says; correct the number behind \
         Frames:",
    );
    check_error(
        "Frames: 2\n",
        "",
        "a.bvh:17: \"Frame Time: 0.0333333\" stands where Frames: is expected; write Frames: and \
         Frame Time: behind MOTION",
    );
    for (time, what) in [
        ("0", "the frame time \"0\" is not within 0.001 to 1 seconds"),
        ("-0.03", "the frame time \"-0.03\" is not within 0.001 to 1 seconds"),
        ("1e9", "the frame time \"1e9\" is not within 0.001 to 1 seconds"),
        ("nan", "the frame time \"nan\" is not within 0.001 to 1 seconds"),
        ("", "the frame time \"\" is not a number"),
    ] {
        let expected =
            format!("a.bvh:18: {what}; write the seconds between frames, like 0.0333333");
        check_error("Time: 0.0333333", &format!("Time: {time}"), &expected);
    }
    check_error(
        "0 90 0 0 0 0 0 0 0\n",
        "0 90 0 0 0 0 0 0\n",
        "a.bvh:19: the frame has 8 numbers instead of 9; export it again, or correct the CHANNELS",
    );
    check_error(
        "40 50 60\n",
        "40 50 60 70\n",
        "a.bvh:20: the frame has 10 numbers instead of 9; export it again, or correct the CHANNELS",
    );
    for word in ["nan", "inf", "-1e300", "1e400"] {
        let expected = format!(
            "a.bvh:20: the value \"{word}\" is not within ±10000000; export it again, the motion \
             is damaged"
        );
        check_error("91 2 10", &format!("91 {word} 10"), &expected);
    }
    check_error(
        "91 2 10",
        "91 2,5 10",
        "a.bvh:20: \"2,5\" is not a number; write decimals with a point",
    );
    check_error("91 2 10", "91 \0 10", "a.bvh:20: \"\u{fffd}\" is not a number; export it again");
}

#[test]
fn files_that_are_no_bvh_are_refused() {
    let utf16: Vec<u8> = GOOD.encode_utf16().flat_map(u16::to_be_bytes).collect();
    let with_mark = [&[0xfe, 0xff][..], &utf16].concat();
    for (bytes, expected) in [
        (&b""[..], "a.bvh: the file is empty; export it again"),
        (b" \r\n\n", "a.bvh: the file is empty; export it again"),
        (b"HIERARCHY", "a.bvh:1: the file ends before MOTION; export it again, it is cut off"),
        (
            b"HIERARCHY\nMOTION\n",
            "a.bvh:2: there is no ROOT before MOTION; export it again with its skeleton",
        ),
        (
            b"HIERARCHY\nROOT a\n{\nOFFSET 0 0 0\n}\nMOTION\nFrames: 1\nFrame Time: 1\n\n",
            "a.bvh:6: no joint has channels, so nothing can move; export the file with joint \
             rotations",
        ),
        (
            b"\x7fELF\x02\x01\0\0\xff\xfe",
            "a.bvh:1: a BVH file begins with HIERARCHY, this one with \
             \"\u{fffd}ELF\u{fffd}\u{fffd}\u{fffd}\u{fffd}\u{fffd}\u{fffd}\"; check that it is the \
             right file",
        ),
        (&with_mark, "a.bvh:1: the text is UTF-16; save it as UTF-8 or plain ASCII"),
    ] {
        assert_eq!(read_text(bytes).unwrap_err().to_string(), expected);
    }
}

#[test]
fn too_many_and_too_deep_joints_are_refused_before_memory() {
    let flat: String = (0..2000).map(|i| format!("JOINT j{i}\n{{\nOFFSET 0 0 0\n}}\n")).collect();
    let error = read_text(format!("HIERARCHY\nROOT r\n{{\nOFFSET 0 0 0\n{flat}")).unwrap_err();
    assert_eq!((error.line, error.what.as_str()), (Some(4097), "there are more than 1024 joints"));
    let deep: String = (0..2000).map(|i| format!("JOINT j{i}\n{{\n")).collect();
    let error = read_text(format!("HIERARCHY\nROOT r\n{{\n{deep}")).unwrap_err();
    assert_eq!(error.what, "joints are nested more than 256 deep");
}

#[test]
fn dialects_read_the_same() {
    let good = read_text(GOOD).unwrap();
    for (name, text) in [
        ("CR LF", GOOD.replace('\n', "\r\n")),
        ("CR", GOOD.replace('\n', "\r")),
        ("tabs", GOOD.replace(' ', "\t").replace("Frame\tTime", "Frame Time")),
        ("tab in the header", GOOD.replace("Frame Time: ", "Frame\t Time:")),
        ("no space behind the colon", GOOD.replace("Frames: ", "Frames:")),
        ("no final newline", GOOD.trim_end().to_owned()),
        ("blank lines", GOOD.replace('\n', "\n \n")),
        ("scientific notation", GOOD.replace("90 0", "9.0e+1 0E0")),
        ("byte order mark", format!("\u{feff}{GOOD}")),
        ("lower case", GOOD.replace("ROOT", "root").replace("JOINT", "Joint")),
        ("braces on the line", GOOD.replace("\n{", " {").replace("Head\n", "Head")),
        ("named end site", GOOD.replace("End Site", "End Site Head_end")),
        ("trailing blanks", GOOD.replace('\n', " \t\n")),
    ] {
        let mut bvh = read_text(&text).unwrap_or_else(|error| panic!("{name}: {error}"));
        for (joint, original) in bvh.joints.iter_mut().zip(&good.joints) {
            joint.line = original.line;
        }
        assert_eq!(bvh, good, "{name}");
    }
}

#[test]
fn names_may_be_anything_and_doubles_are_told_apart() {
    let bytes: Vec<u8> = GOOD.replace("Head", "Kopf \u{fc}ber#").into_bytes();
    assert_eq!(read_text(&bytes).unwrap().joints[1].name, "Kopf \u{fc}ber#");
    let latin1: Vec<u8> = bytes.iter().copied().filter(|&b| b != 0xc3).collect();
    assert_eq!(read_text(&latin1).unwrap().joints[1].name, "Kopf \u{fffd}ber#");

    let mut warnings = Warnings::new();
    let doubled = GOOD.replace("Head", "Hips");
    let bvh = read(doubled.as_bytes(), Path::new("a.bvh"), &mut warnings).unwrap();
    assert_eq!(bvh.joints[1].name, "Hips_2");
    assert_eq!(
        warnings.as_slice()[0].to_string(),
        "a.bvh:6: a second joint is called \"Hips\"; it is taken as \"Hips_2\""
    );
}

#[test]
fn positions_of_inner_joints_become_offsets() {
    let text = |a: &str, b: &str| {
        GOOD.replace("CHANNELS 3", "CHANNELS 4 Yposition")
            .replace("0 0 0 0 0 0 0\n", &format!("0 0 0 0 {a} 0 0 0\n"))
            .replace("30 40", &format!("30 {b} 40"))
    };
    for (a, b, offset, n_warnings) in
        [("70", "70", 70.0, 0), ("0", "0", 60.0, 0), ("50", "70", 60.0, 1)]
    {
        let bvh = read_text(text(a, b)).unwrap();
        let mut warnings = Warnings::new();
        let (skeleton, _) = bvh.to_motion(1.0, Path::new("a.bvh"), &mut warnings).unwrap();
        assert_eq!(skeleton.joints()[1].offset_m.y, offset, "{a} {b}");
        assert_eq!(warnings.as_slice().len(), n_warnings, "{a} {b}");
    }
}

/// A body of two chains whose joints are not in depth-first order.
fn two_arms() -> Skeleton {
    use motion_core::ids::JointIdx;
    use motion_core::skeleton::Joint;
    let joint = |name: &str, parent: Option<u32>, x: f32| Joint {
        name: name.to_owned(),
        parent: parent.map(JointIdx),
        offset_m: Vec3::new(x, 0.1, 0.0),
        end_site_m: None,
    };
    let mut joints = vec![
        joint("Root", None, 0.0),
        joint("LeftArm", Some(0), 0.2),
        joint("RightArm", Some(0), -0.2),
        joint("LeftHand", Some(1), 0.3),
        joint("RightHand", Some(2), -0.3),
    ];
    joints[0].offset_m = Vec3::ZERO;
    joints[3].end_site_m = Some(Vec3::new(0.1, 0.0, 0.0));
    Skeleton::new(joints).unwrap()
}

fn rotation_vector() -> impl Strategy<Value = Vec3> {
    (-3f32..3.0, -3f32..3.0, -3f32..3.0).prop_map(|(x, y, z)| Vec3::new(x, y, z))
}

proptest! {
    #[test]
    fn a_written_motion_reads_back(
        vectors in prop::collection::vec(rotation_vector(), 5..60),
        place in rotation_vector(),
        zyx in any::<bool>(),
    ) {
        let skeleton = two_arms();
        let n_frames = vectors.len() / 5;
        let rotations: Vec<Quat> = vectors[..5 * n_frames].iter().map(|&v| rotation::exp(v)).collect();
        let positions = (0..n_frames).map(|f| place * f as f32).collect();
        let motion = Motion::new(Fps::THIRTY, 5, positions, rotations).unwrap();
        let options = BvhWriteOptions {
            euler_order: if zyx { EulerOrder::Zyx } else { EulerOrder::Zxy },
            ..BvhWriteOptions::default()
        };
        let text = write(&skeleton, &motion, &options);
        prop_assert_eq!(&text, &write(&skeleton, &motion, &options));
        let (skeleton_2, motion_2) = motion_of(&read_text(&text).unwrap(), 0.01);
        prop_assert_eq!(motion_2.fps(), motion.fps());
        for (idx, joint) in skeleton.joints().iter().enumerate() {
            let again = skeleton_2.by_name(&joint.name).unwrap();
            prop_assert!(skeleton_2.joint(again).offset_m.distance(joint.offset_m) < 1e-7);
            prop_assert_eq!(skeleton_2.joint(again).end_site_m, joint.end_site_m);
            for frame in 0..n_frames {
                let (a, b) = (motion.rotations(frame)[idx], motion_2.rotations(frame)[again.idx()]);
                prop_assert!(rotation::angle_between_rad(a, b).to_degrees() < 0.01);
            }
        }
        for (a, b) in motion.root_positions_m().iter().zip(motion_2.root_positions_m()) {
            prop_assert!(a.distance(*b) < 1e-4);
        }
    }

    #[test]
    fn random_bytes_never_panic(bytes in prop::collection::vec(any::<u8>(), 0..400)) {
        drop(read_text(&bytes));
        drop(read_text([b"HIERARCHY ", &bytes[..]].concat()));
    }

    #[test]
    fn random_words_never_panic(words in prop::collection::vec(
        prop::sample::select(vec![
            "HIERARCHY", "ROOT", "JOINT", "End", "Site", "OFFSET", "CHANNELS", "MOTION", "{", "}",
            "Frames:", "Frame Time:", "\n", "\r", "0", "1", "3", "6", "-1", "0.03", "nan", "a",
            "Xposition", "Zrotation", "Xrotation", "Yrotation",
        ]), 0..80)
    ) {
        drop(read_text(words.join(" ")));
        drop(read_text(format!("HIERARCHY ROOT a\n{{ {}", words.join(" "))));
    }

    #[test]
    fn damaged_files_never_panic(
        cut in 0..GOOD.len(),
        edits in prop::collection::vec((0..GOOD.len(), any::<u8>()), 0..6),
    ) {
        let mut bytes = GOOD.as_bytes().to_vec();
        for (at, byte) in edits {
            bytes[at] = byte;
        }
        for text in [&bytes[..], &bytes[..cut], &bytes[cut..]] {
            if let Ok(bvh) = read_text(text) {
                drop(bvh.to_motion(1.0, Path::new("a.bvh"), &mut Warnings::new()));
            }
        }
    }
}

#[test]
fn a_spin_is_written_without_jumps() {
    let skeleton = two_arms();
    let n_frames = 200;
    let rotations =
        (0..n_frames).flat_map(|f| [Quat::from_rotation_y(0.1 * f as f32); 5]).collect();
    let motion = Motion::new(Fps::THIRTY, 5, vec![Vec3::ZERO; n_frames], rotations).unwrap();
    let text = write(&skeleton, &motion, &BvhWriteOptions::default());
    let bvh = read_text(&text).unwrap();
    for pair in bvh.values.windows(2 * bvh.n_channels).step_by(bvh.n_channels) {
        let (a, b) = pair.split_at(bvh.n_channels);
        let step = a.iter().zip(b).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
        assert!(step < 6.0, "a step of {step}°");
    }
}

#[test]
fn what_comes_back_is_compared_joint_by_joint() {
    let skeleton = two_arms();
    let turns = (0..20).map(|nth| rotation::exp(Vec3::new(0.1, 0.2, -0.3) * nth as f32));
    let motion = Motion::new(Fps::THIRTY, 5, vec![Vec3::Y; 4], turns.collect()).unwrap();
    let options = BvhWriteOptions::default();
    let text = write(&skeleton, &motion, &options);
    let compare = |motion: &Motion| {
        round_trip(text.as_bytes(), Path::new("a.bvh"), &skeleton, motion, &options)
    };
    assert!(compare(&motion).unwrap().worst_m < 1e-6);
    let mut other = motion.clone();
    other.root_positions_m_mut()[2].y += 0.25;
    let worst = compare(&other).unwrap();
    assert!((worst.worst_m - 0.25).abs() < 1e-5 && worst.frame == 2, "{worst:?}");
    assert!(compare(&motion.slice(0, 3)).is_err(), "another number of frames");
}

#[test]
fn odd_rates_survive() {
    let skeleton = two_arms();
    for fps in [30.0, 29.97, 30_000.0 / 1001.0, 120.0, 23.976, 59.94, 7.3, 1000.0, 1.0] {
        let fps = Fps::new(fps).unwrap();
        let motion = Motion::new(fps, 5, vec![Vec3::ZERO], vec![Quat::IDENTITY; 5]).unwrap();
        let read = read_text(write(&skeleton, &motion, &BvhWriteOptions::default())).unwrap();
        assert!((read.fps.get() - fps.get()).abs() < 1e-9 * fps.get(), "{fps:?} {:?}", read.fps);
    }
}

/// The real clips, relative to this crate; `None` (and a printed word) where they are missing.
fn real_clips() -> Option<PathBuf> {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../../shared/mocap/cmu");
    if folder.is_dir() {
        return Some(folder);
    }
    println!("skipped: there is no {}", folder.display());
    None
}

#[test]
fn a_real_clip_reads_back_as_written() {
    let Some(folder) = real_clips() else { return };
    for name in ["127_24.bvh", "49_08.bvh"] {
        let bytes = std::fs::read(folder.join(name)).unwrap();
        let (skeleton, motion) = motion_of(&read_text(bytes).unwrap(), 0.056_444);
        let text = write(&skeleton, &motion, &BvhWriteOptions::default());
        let (skeleton_2, motion_2) = motion_of(&read_text(&text).unwrap(), 0.01);
        assert_eq!(skeleton.n_joints(), skeleton_2.n_joints());
        let a = motion.joint_positions_m(&skeleton);
        let b = motion_2.joint_positions_m(&skeleton_2);
        let worst = a.iter().zip(&b).map(|(a, b)| a.distance(*b)).fold(0.0, f32::max);
        assert!(worst < 1e-4, "{name}: {worst} m");
    }
}
