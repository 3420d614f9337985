//! `render`: pictures, films, and what is said when there can be none.

use std::fs;
use std::sync::OnceLock;

use motion_tests::cli::{Dir, command};
use motion_tests::walker::Walk;

use crate::{dir_with_library, gaitway, json};

/// Whether this machine can draw; says so where it cannot. Where the tests' environment promises an
/// adapter, its absence is a failure.
#[expect(clippy::print_stderr, reason = "a test that is skipped says so")]
pub(crate) fn can_draw() -> bool {
    static CAN: OnceLock<bool> = OnceLock::new();
    let can = *CAN.get_or_init(|| {
        let dir = dir_with_walk();
        let ran = gaitway(&dir, "render walk.bvh -o a.png --frame 0 --size 16x16");
        let required = std::env::var_os("GAITWAY_REQUIRE_GPU").is_some_and(|v| v == "1");
        assert!(ran.code == Some(0) || !required, "nothing can be drawn: {}", ran.stderr);
        if ran.code != Some(0) {
            assert_eq!(ran.code, Some(1), "{}", ran.stderr);
            assert_eq!(ran.stderr.lines().count(), 1, "{}", ran.stderr);
        }
        ran.code == Some(0)
    });
    if !can {
        eprintln!("skipped");
    }
    can
}

fn dir_with_walk() -> Dir {
    let dir = Dir::new();
    dir.file("walk.bvh", Walk { n_frames: 24, ..Walk::default() }.bvh());
    dir
}

/// Width, height and pixels of a PNG.
fn pixels(dir: &Dir, name: &str) -> (u32, u32, Vec<u8>) {
    let bytes = fs::read(dir.join(name)).expect("it was written");
    let picture = image::load_from_memory(&bytes).expect("it is a picture").to_rgb8();
    (picture.width(), picture.height(), picture.into_raw())
}

/// How many colours a picture has: an empty one has the sky's and the floor's only.
fn n_colors(rgb: &[u8]) -> usize {
    let mut colors: Vec<&[u8]> = rgb.chunks_exact(3).collect();
    colors.sort_unstable();
    colors.dedup();
    colors.len()
}

#[test]
fn a_picture_of_a_frame() {
    if !can_draw() {
        return;
    }
    let dir = dir_with_walk();
    let ran = gaitway(&dir, "render walk.bvh -o a.png --frame 12 --size 160x90 --json").ok();
    let said = json(&ran.stdout);
    assert_eq!(
        (&said["kind"], &said["width"], &said["height"]),
        (&"picture".into(), &160.into(), &90.into())
    );
    assert_eq!(said["frames"], serde_json::json!([12, 12]));
    assert!(said.get("seconds").is_none(), "the same every time: {said}");
    let (width, height, rgb) = pixels(&dir, "a.png");
    assert_eq!((width, height), (160, 90));
    assert!(n_colors(&rgb) > 100, "somebody is to be seen: {} colours", n_colors(&rgb));
    gaitway(&dir, "render walk.bvh -o light.png --frame 12 --size 160x90 --theme light").ok();
    let mean = |rgb: &[u8]| rgb.iter().map(|&b| u64::from(b)).sum::<u64>() / rgb.len() as u64;
    assert!(mean(&pixels(&dir, "light.png").2) > mean(&rgb) + 80, "light is light");
}

#[test]
fn a_contact_sheet_is_what_a_picture_of_a_motion_is() {
    if !can_draw() {
        return;
    }
    let dir = dir_with_walk();
    let ran = gaitway(&dir, "render walk.bvh -o a.png --size 320x200 --json").ok();
    assert_eq!(json(&ran.stdout)["kind"], "sheet");
    assert_eq!(json(&ran.stdout)["frames"], serde_json::json!([0, 23]));
    assert_eq!(json(&ran.stdout)["bytes"], fs::metadata(dir.join("a.png")).unwrap().len());
    let (width, height, _) = pixels(&dir, "a.png");
    assert_eq!((width, height), (320, 200));
}

#[test]
fn a_film_has_a_picture_for_every_frame() {
    if !can_draw() {
        return;
    }
    let dir = dir_with_walk();
    for camera in ["three-quarter", "follow", "turntable", "front", "side", "top"] {
        let line = format!("render walk.bvh -o a.gif --size 96x54 --camera {camera} --json");
        let said = json(&gaitway(&dir, &line).ok().stdout);
        assert_eq!((&said["pictures"], &said["fps"]), (&24.into(), &30.0.into()));
        let file = fs::File::open(dir.join("a.gif")).expect("it was written");
        let mut film = gif::DecodeOptions::new().read_info(file).expect("it is a GIF");
        assert_eq!((film.width(), film.height()), (96, 54));
        let mut delays = Vec::new();
        while let Some(frame) = film.next_frame_info().expect("frames") {
            delays.push(frame.delay);
        }
        assert_eq!(delays.len(), 24);
        assert_eq!(delays.iter().sum::<u16>(), 80, "24 pictures last 0.8 s");
    }
    let line = "render walk.bvh -o b.gif --size 96x54 --frames 6-18 --fps 15 --ghosts 3 --trail";
    let ran = gaitway(&dir, line).ok();
    assert!(ran.stdout.starts_with("b.gif: 7 pictures, 0.5 s, 96 × 54, "), "{}", ran.stdout);
}

#[test]
fn a_project_shows_its_best_motion_the_same_every_time() {
    if !can_draw() {
        return;
    }
    let dir = dir_with_library();
    for name in ["a", "b"] {
        gaitway(
            &dir,
            &format!("render corner.gaitway -o {name}.png --size 320x200 --iterations 10"),
        )
        .ok();
        let line = "--size 96x54 --iterations 10 --frames 0-20";
        gaitway(&dir, &format!("render corner.gaitway -o {name}.gif {line}")).ok();
    }
    for ending in ["png", "gif"] {
        let bytes = |name: &str| fs::read(dir.join(&format!("{name}.{ending}"))).unwrap();
        assert!(bytes("a") == bytes("b"), "two {ending} files differ");
    }
    let marked = pixels(&dir, "a.png").2;
    let line = "render corner.gaitway -o bare.png --size 320x200 --iterations 10 --no-marks";
    gaitway(&dir, line).ok();
    assert_ne!(pixels(&dir, "bare.png").2, marked, "its checkpoints are drawn");
    let ran = gaitway(&dir, "render corner.gaitway -o c.png --iterations 10 --take 900");
    assert_eq!(ran.code, Some(2), "{}", ran.stderr);
    assert!(ran.stderr.contains("motions for A; ask for one of them"), "{}", ran.stderr);
    assert!(!dir.join("c.png").exists());
}

#[test]
fn what_cannot_be_drawn_is_said_before_anything_is_done() {
    let dir = dir_with_walk();
    dir.file("not.glb", "glTF and nothing else");
    dir.file("nobody.gltf", "{\"asset\": {\"version\": \"2.0\"}}");
    let help = "`gaitway render --help` says what can be given";
    for (line, expected) in [
        (
            "walk.bvh -o a.png --size 0x90",
            &*format!(
                "invalid value '0x90' for '--size <WxH>': each side has 16 to 8192 pixels; {help}"
            ),
        ),
        (
            "walk.bvh -o a.png --size big",
            &*format!(
                "invalid value 'big' for '--size <WxH>': use WIDTHxHEIGHT, such as 640x360; {help}"
            ),
        ),
        (
            "walk.bvh -o a.jpeg",
            "a.jpeg: .jpeg is neither a picture nor a film that can be written; choose a name that \
             ends in .png, .gif, .mp4 or .webm",
        ),
        (
            "walk.bvh -o a",
            "a: the name has no ending that says the format; choose a name that ends in .png, .gif, \
             .mp4 or .webm",
        ),
        ("walk.bvh -o a.png --frame 24", "walk.bvh: it has no frame 24; its frames are 0 to 23"),
        ("walk.bvh -o a.gif --frames 9-99", "walk.bvh: it has no frame 99; its frames are 0 to 23"),
        (
            "walk.bvh -o a.gif --frame 2",
            "a.gif: --frame asks for one picture, and this is a film; use --frames A-B, or .png",
        ),
        (
            "walk.bvh -o a.png --fps 12",
            "a.png: --fps is for films, and this is a picture; leave it out, or use .gif",
        ),
        (
            "walk.bvh -o a.gif --fps 60",
            "a.gif: a GIF shows at most 50 pictures a second; use a lower --fps, or .mp4",
        ),
        (
            "walk.bvh -o none/a.png",
            "none/a.png: the folder it goes into does not exist; create the folder first",
        ),
        ("none.bvh -o a.png", "none.bvh: there is no such file; check the path"),
        ("none.gaitway -o a.png", "none.gaitway: there is no such file; check the path"),
        (
            "walk.bvh -o a.png --character none.glb",
            "none.glb: there is no such file; check the path",
        ),
        (
            "walk.bvh -o a.png --character walk.bvh",
            "walk.bvh: it is no glTF file; choose a .glb or .gltf with a skinned body",
        ),
        (
            "walk.bvh -o a.png --character nobody.gltf",
            "nobody.gltf: there is no skin in the file: its mesh is bound to no skeleton; export the \
             character with its armature and skin",
        ),
        (
            "walk.bvh -o a.png --take 2",
            "walk.bvh: it is a motion, and --take, --library, --iterations and --time are for \
             projects; leave them out",
        ),
        (
            "none.gaitway -o a.png --scale 0.01",
            "none.gaitway: it is a project, and --scale, --up and --roles are for motion files; \
             leave them out",
        ),
    ] {
        gaitway(&dir, &format!("render {line}")).refused(&format!("gaitway: {expected}"));
    }
    for line in ["not.glb -o a.png", "walk.bvh -o a.png --character not.glb"] {
        let ran = gaitway(&dir, &format!("render {line}"));
        assert_eq!((ran.code, ran.stderr.lines().count()), (Some(2), 1), "{}", ran.stderr);
        assert!(ran.stderr.starts_with("gaitway: not.glb: "), "{}", ran.stderr);
    }
    let names: Vec<String> = dir.files().into_iter().map(|(name, _)| name).collect();
    assert_eq!(names, ["nobody.gltf", "not.glb", "walk.bvh"], "nothing else is left");
}

#[test]
fn without_ffmpeg_films_can_still_be_gifs() {
    if !can_draw() {
        return;
    }
    let dir = dir_with_walk();
    let args = ["render", "walk.bvh", "-o", "a.mp4", "--size", "96x54"];
    let empty = dir.join("empty");
    fs::create_dir(&empty).expect("the folder is ours");
    let output = command(env!("CARGO_BIN_EXE_gaitway"), dir.path(), &args)
        .env("PATH", &empty)
        .output()
        .expect("the program was built");
    assert_eq!(output.status.code(), Some(2));
    assert_eq!(
        String::from_utf8_lossy(&output.stderr),
        "gaitway: a.mp4: ffmpeg, which makes films of this kind, is not installed; install it, or \
         choose a name that ends in .gif\n"
    );
    assert_eq!(dir.files().len(), 1, "nothing else is left");
}

#[cfg(unix)]
#[test]
fn what_ffmpeg_says_is_passed_on() {
    use std::os::unix::fs::PermissionsExt as _;
    if !can_draw() {
        return;
    }
    let dir = dir_with_walk();
    let script = "#!/bin/sh\necho 'first line' >&2\necho 'Unknown encoder libx264' >&2\nexit 1\n";
    let ffmpeg = dir.file("bin/ffmpeg", script);
    fs::set_permissions(&ffmpeg, fs::Permissions::from_mode(0o755)).expect("the file is ours");
    let args = ["render", "walk.bvh", "-o", "a.mp4", "--size", "96x54"];
    let output = command(env!("CARGO_BIN_EXE_gaitway"), dir.path(), &args)
        .env("PATH", format!("{}:/usr/bin:/bin", dir.join("bin").display()))
        .output()
        .expect("the program was built");
    assert_eq!(output.status.code(), Some(1));
    let said = String::from_utf8_lossy(&output.stderr);
    assert_eq!(said, "gaitway: ffmpeg failed: Unknown encoder libx264\n");
    assert_eq!(dir.files().len(), 2, "nothing else is left");
}

#[test]
fn ffmpeg_makes_films_where_it_is() {
    let has_ffmpeg = std::process::Command::new("ffmpeg").arg("-version").output().is_ok();
    if !has_ffmpeg || !can_draw() {
        return;
    }
    let dir = dir_with_walk();
    for (name, mark) in [("a.mp4", &b"ftyp"[..]), ("a.webm", &b"webm"[..])] {
        let ran =
            gaitway(&dir, &format!("render walk.bvh -o {name} --size 97x55 --frames 0-5")).ok();
        assert!(ran.stdout.contains("6 pictures, 0.2 s, 96 × 54"), "even sides: {}", ran.stdout);
        let bytes = fs::read(dir.join(name)).expect("it was written");
        assert!(bytes[..64].windows(4).any(|four| four == mark), "{name} is what it is called");
    }
    assert_eq!(dir.files().len(), 3);
}

#[test]
fn no_adapter_is_one_clear_line() {
    let dir = dir_with_walk();
    let args = ["render", "walk.bvh", "-o", "a.png"];
    let output = command(env!("CARGO_BIN_EXE_gaitway"), dir.path(), &args)
        // A back end that no machine with these tests has an adapter for.
        .env("WGPU_BACKEND", if cfg!(target_os = "macos") { "vulkan" } else { "metal" })
        .output()
        .expect("the program was built");
    let said = String::from_utf8_lossy(&output.stderr);
    assert_eq!(output.status.code(), Some(1), "{said}");
    assert_eq!(said.lines().count(), 1, "{said}");
    assert!(said.starts_with("gaitway: no graphics adapter can draw here"), "{said}");
    assert!(!dir.join("a.png").exists());
}

/// Real characters are not ours to commit.
#[test]
fn characters_show_their_own_motions_and_others() {
    let Some(shared) = motion_tests::shared_dir() else { return };
    let character = shared.join("characters/CesiumMan.glb");
    if !character.is_file() || !can_draw() {
        return;
    }
    let dir = dir_with_walk();
    let picture = |name: &str, args: &[&std::ffi::OsStr]| {
        let end = ["-o", name, "--frame", "9", "--size", "120x160"];
        let args: Vec<&std::ffi::OsStr> = ["render".as_ref()]
            .into_iter()
            .chain(args.iter().copied())
            .chain(end.map(AsRef::as_ref))
            .collect();
        motion_tests::cli::run(env!("CARGO_BIN_EXE_gaitway"), dir.path(), &args).ok();
        pixels(&dir, name).2
    };
    let own = picture("own.png", &[character.as_os_str()]);
    let walk = "walk.bvh".as_ref();
    let dressed = picture("dressed.png", &[walk, "--character".as_ref(), character.as_os_str()]);
    let mannequin = picture("mannequin.png", &[walk]);
    // The suit has green stripes; a mannequin has no colours.
    let n_green = |rgb: &[u8]| {
        rgb.chunks_exact(3)
            .filter(|p| p[1] > p[0].saturating_add(25) && p[1] > p[2].saturating_add(25))
            .count()
    };
    assert!(
        n_green(&own) > 20 && n_green(&dressed) > 20,
        "{}, {}",
        n_green(&own),
        n_green(&dressed)
    );
    assert_eq!(n_green(&mannequin), 0);
}
