//! Motion files with one mistake each, and the line that says it.

use motion_tests::cli::Dir;

use crate::gaitway;

/// A file without mistakes: two joints, two frames.
const GOOD: &str = "\
HIERARCHY
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
0 90 1 0 0 0 0 0 0
";

/// Replaces the first `from` by `to` in the good file and expects this after `gaitway: bad.bvh`,
/// and that nothing was written.
#[track_caller]
fn check(from: &str, to: &str, expected: &str) {
    assert!(GOOD.contains(from), "{from:?} is not in the good file");
    check_bytes(GOOD.replacen(from, to, 1).as_bytes(), expected);
}

#[track_caller]
fn check_bytes(bytes: &[u8], expected: &str) {
    let dir = Dir::new();
    dir.file("bad.bvh", bytes);
    gaitway(&dir, "convert bad.bvh out.bvh").refused(&format!("gaitway: bad.bvh{expected}"));
    let files: Vec<String> = dir.files().into_iter().map(|(name, _)| name).collect();
    assert_eq!(files, ["bad.bvh"], "a refused conversion leaves nothing behind");
}

#[test]
fn a_good_file_is_converted() {
    let dir = Dir::new();
    dir.file("good.bvh", GOOD);
    gaitway(&dir, "convert good.bvh out.bvh --scale 0.01").ok();
    assert!(dir.join("out.bvh").is_file(), "the motion is written");
}

#[test]
fn what_is_no_bvh() {
    check_bytes(b"", ": the file is empty; export it again");
    check_bytes(b"\xff\xfeH\0I\0", ":1: the text is UTF-16; save it as UTF-8 or plain ASCII");
    check(
        "HIERARCHY",
        "HIERACHY",
        ":1: a BVH file begins with HIERARCHY, this one with \"HIERACHY\"; \
         check that it is the right file",
    );
}

#[test]
fn joints() {
    check(
        "MOTION\n",
        "ROOT Second\n{\n OFFSET 0 0 0\n}\nMOTION\n",
        ":16: there is a second ROOT; keep one body in a file",
    );
    check(
        "    OFFSET 0 60 0\n",
        "    OFFSET 0 60\n",
        ":8: OFFSET has 2 numbers instead of 3; write OFFSET x y z",
    );
    check(
        "0 60 0",
        "0 nan 0",
        ":8: the OFFSET \"nan\" is not within ±100000; export the body in metres or centimetres",
    );
    check(
        "0 60 0",
        "0 1e30 0",
        ":8: the OFFSET \"1e30\" is not within ±100000; export the body in metres or centimetres",
    );
    check("    OFFSET 0 60 0\n", "", ":6: joint \"Head\" has no OFFSET; add a line OFFSET x y z");
    check("  }\n}\n", "  }\n", ":15: joint \"Hips\" has no closing brace; add the missing }");
    check(
        "ROOT Hips\n{",
        "ROOT Hips",
        ":3: joint \"Hips\" is followed by \"OFFSET\" instead of a brace; add the missing {",
    );
    check(
        "CHANNELS 3 Zrotation",
        "CHANNELS 4 Zrotation",
        ":9: CHANNELS says 4 and lists 3; correct the number",
    );
    check(
        "CHANNELS 3 Zrotation",
        "CHANNELS 3 Zspin",
        ":9: \"Zspin\" is not a channel; use Xposition to Zposition and Xrotation to Zrotation",
    );
    check(
        "CHANNELS 3 Zrotation Xrotation Yrotation\n    End",
        "CHANNELS 3 Zrotation Xrotation Zrotation\n    End",
        ":9: the channel \"Zrotation\" is listed twice; keep one of them",
    );
    check(
        "CHANNELS 3",
        "CHANNELS 4000000000",
        ":9: CHANNELS is not followed by a number up to 6; \
         write CHANNELS 3 Zrotation Xrotation Yrotation",
    );
    check("JOINT Head", "JOINT", ":6: a joint has no name; write one behind JOINT");
}

#[test]
fn too_many_joints() {
    let mut text = String::from("HIERARCHY\nROOT R\n{\nOFFSET 0 0 0\nCHANNELS 1 Xrotation\n");
    for joint in 0..2000 {
        text.push_str(&format!("JOINT J{joint}\n{{\nOFFSET 0 1 0\n}}\n"));
    }
    check_bytes(
        text.as_bytes(),
        ":4098: there are more than 1024 joints; export the body without helpers",
    );
    let mut text = String::from("HIERARCHY\nROOT R\n{\nOFFSET 0 0 0\n");
    for joint in 0..2000 {
        text.push_str(&format!("JOINT J{joint}\n{{\nOFFSET 0 1 0\n"));
    }
    check_bytes(
        text.as_bytes(),
        ":770: joints are nested more than 256 deep; export the body without helpers",
    );
}

#[test]
fn the_head_of_the_motion() {
    check(
        "Frames: 2",
        "Frames: two",
        ":17: the number of frames \"two\" is not a whole number; \
         write how many lines of numbers follow",
    );
    check("Frames: 2", "Frames: 0", ":17: there are no frames; export at least one");
    check(
        "Frames: 2",
        "Frames: 2147483648",
        ":17: 2147483648 frames are more than the 1000000 that are allowed; \
         split the motion into several files",
    );
    check(
        "Frames: 2",
        "Frames: 900000",
        ":20: the file ends after 2 of the 900000 frames that line 17 says; \
         export it again, it is cut off",
    );
    check(
        "Frames: 2",
        "Frames: 1",
        ":20: there are more frames than the 1 that line 17 says; \
         correct the number behind Frames:",
    );
    check(
        "0.0333333",
        "0",
        ":18: the frame time \"0\" is not within 0.001 to 1 seconds; \
         write the seconds between frames, like 0.0333333",
    );
    check(
        "0.0333333",
        "nan",
        ":18: the frame time \"nan\" is not within 0.001 to 1 seconds; \
         write the seconds between frames, like 0.0333333",
    );
    check(
        "Frame Time",
        "Time",
        ":18: \"Time: 0.0333333\" stands where Frame Time: is expected; \
         write Frames: and Frame Time: behind MOTION",
    );
}

#[test]
fn frames() {
    check(
        "0 90 1 0",
        "0 90 1",
        ":20: the frame has 8 numbers instead of 9; export it again, or correct the CHANNELS",
    );
    check(
        "0 90 1 0",
        "0 90 1 0 7",
        ":20: the frame has 10 numbers instead of 9; export it again, or correct the CHANNELS",
    );
    check("0 90 1 0", "0 90,5 1 0", ":20: \"90,5\" is not a number; write decimals with a point");
    check("0 90 1 0", "0 up 1 0", ":20: \"up\" is not a number; export it again");
    check(
        "0 90 1 0",
        "0 1e38 1 0",
        ":20: the value \"1e38\" is not within ±10000000; export it again, the motion is damaged",
    );
    check(
        "0 90 1 0 0 0 0 0 0\n",
        "",
        ":19: the file ends after 1 of the 2 frames that line 17 says; \
         export it again, it is cut off",
    );
}

/// Any prefix of a file, and any byte of it changed, is either a motion or an error in one line.
#[test]
fn damage_of_any_kind_is_an_error_and_no_panic() {
    let dir = Dir::new();
    for cut in (0..GOOD.len()).step_by(23) {
        dir.file("bad.bvh", &GOOD.as_bytes()[..cut]);
        let mut bytes = GOOD.as_bytes().to_vec();
        bytes[cut] = bytes[cut].wrapping_add(cut as u8).wrapping_add(1);
        dir.file("worse.bvh", &bytes);
        for file in ["bad.bvh", "worse.bvh"] {
            let ran = gaitway(&dir, &format!("convert {file} out.bvh"));
            let said = ran.stderr.lines().filter(|line| !line.contains("warning:")).count();
            let as_promised = matches!((ran.code, said), (Some(0), 0) | (Some(2), 1));
            assert!(as_promised, "{file} cut at {cut}: {:?} {}", ran.code, ran.stderr);
        }
    }
}

#[test]
fn files_that_are_not_there_or_not_files() {
    let dir = Dir::new();
    gaitway(&dir, "convert none.bvh out.bvh")
        .refused("gaitway: none.bvh: there is no such file; check the path");
    gaitway(&dir, "measure .").refused("gaitway: .: it is a folder; name a file");
    dir.file("good.bvh", GOOD);
    gaitway(&dir, "convert good.bvh no/out.bvh --scale 0.01").refused(
        "gaitway: no/out.bvh: the folder it goes into does not exist; create the folder first",
    );
}
