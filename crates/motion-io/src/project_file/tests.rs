//! Projects in, out, and every way in which one can be wrong.

use proptest::prelude::*;

use super::*;

/// Everything that a project can have, a constraint a line.
const FULL: &str = r#"{
  "gaitway": 1,
  "name": "turn and jump",
  "about": "all kinds",
  "fps": 29.97,
  "library": "../mocap/cmu",
  "hashes": {"library": "ab12", "clips": {"16_15": "cd34"}},
  "palette": {"include": ["*"], "exclude": ["*sit*"], "tags": []},
  "characters": [
    {
      "name": "A",
      "length": {"frames": 240, "mode": "exact", "weight": 1.5},
      "body": "hero.glb",
      "library": "builtin",
      "constraints": [
        {"id": "start", "kind": "body", "frame": 0, "position": [0.0, 0.0], "heading": 0.0},
        {"id": "end", "kind": "body", "frame": 239, "position": [3.0, 1.0], "heading": 90.0},
        {"id": "j", "kind": "joint", "frame": 120, "joint": "Head", "position": [1.2, 2.0, 0.4]},
        {"id": "p", "kind": "pose", "frame": 200, "clip": "jump_up", "clip_frame": 55},
        {"id": "s", "kind": "style", "from": 0, "to": 100, "tag": "run", "tolerance": 0.3},
        {"id": "w", "kind": "path", "from": 0, "to": 200, "points": [[0.0, 0.0], [1.0, 2.0]]},
        {
          "id": "l",
          "kind": "lock",
          "from": 30,
          "to": 90,
          "pieces": [{"clip": "a", "from": 1, "to": 9}],
          "weight": 2.0,
          "tolerance": {"position": 0.1, "heading": 5.0, "frames": 3.0}
        }
      ]
    },
    {"name": "B", "constraints": []}
  ],
  "interactions": [
    {
      "id": "meet",
      "frame": 90,
      "members": [
        {"character": "A", "clip": "a", "clip_frame": 10},
        {"character": "B", "clip": "b", "clip_frame": 20}
      ],
      "relative": [
        {"position": [0.0, 0.0], "heading": 0.0},
        {"position": [0.0, 1.2], "heading": 180.0}
      ]
    }
  ],
  "obstacles": [
    {"shape": "box", "center": [1.0, 0.5, 2.0], "size": [1.0, 1.0, 1.0], "heading": 0.0},
    {"shape": "cylinder", "center": [0.0, 1.0, 3.0], "radius": 0.4, "height": 2.0},
    {"shape": "ceiling", "center": [0.0, 1.4, 5.0], "size": [2.0, 0.0, 1.0], "heading": 0.0}
  ],
  "search": {
    "seed": 18446744073709551615,
    "alternatives": 6,
    "tau": 0.1,
    "mirror": true,
    "bridges": false,
    "weights": {"continuity": 2.0}
  },
  "editor": {"camera": [1, 2, 3]}
}
"#;

fn read_text(text: impl AsRef<[u8]>) -> Result<Project, FileError> {
    read(text.as_ref(), Path::new("p.gaitway"), &mut Warnings::new())
}

/// The error of `FULL` with its first `from` replaced by `to`.
#[track_caller]
fn check_error(from: &str, to: &str, expected: &str) {
    assert!(FULL.contains(from), "{from:?} is not in the full project");
    let error = read_text(FULL.replacen(from, to, 1)).expect_err("must be refused");
    assert_eq!(error.to_string(), expected, "{from:?} -> {to:?}");
}

#[test]
fn a_full_project_round_trips_byte_for_byte() {
    let mut warnings = Warnings::new();
    let project = read(FULL.as_bytes(), Path::new("p.gaitway"), &mut warnings).unwrap();
    assert!(warnings.is_empty(), "{warnings:?}");
    assert_eq!(write(&project), FULL);
    assert_eq!(project.search.seed, u64::MAX);
}

#[test]
fn a_path_says_where_one_looks_on_it() {
    let heading = |written: &str| {
        let text = FULL.replacen("[1.0, 2.0]]", &format!("[1.0, 2.0]]{written}"), 1);
        let project = read_text(&text).expect("a sound project");
        let ConstraintKind::Path { heading, .. } = project.characters[0].constraints[5].kind else {
            panic!("the sixth is the path")
        };
        (heading, write(&project).contains("\"along\""))
    };
    assert_eq!(heading(", \"heading\": \"along\""), (PathHeading::Along, true));
    assert_eq!(heading(", \"heading\": \"free\""), (PathHeading::Free, false));
    assert_eq!(heading(""), (PathHeading::Free, false));
}

#[test]
fn numbers_survive_bit_for_bit() {
    for number in ["0.1", "1e-7", "0.30000000000000004", "-123.456789012345678", "5e-324"] {
        let project = read_text(FULL.replacen("3.0, 1.0", &format!("3.0, {number}"), 1)).unwrap();
        assert_eq!(read_text(write(&project)).unwrap(), project, "{number}");
    }
}

#[test]
fn unknown_keys_are_kept_and_warned_about() {
    let text = FULL
        .replacen("\"frame\": 239,", "\"frame\": 239, \"mood\": {\"x\": [1]},", 1)
        .replacen("\"about\"", "\"zeta\": null, \"about\"", 1);
    let mut warnings = Warnings::new();
    let project = read(text.as_bytes(), Path::new("p.gaitway"), &mut warnings).unwrap();
    let said: Vec<String> = warnings.as_slice().iter().map(ToString::to_string).collect();
    assert_eq!(
        said,
        [
            "p.gaitway:17: characters[0].constraints[1].mood is an unknown key; it is kept",
            "p.gaitway:4: zeta is an unknown key; it is kept",
        ]
    );
    let saved = write(&project);
    assert!(saved.contains("\"mood\": {\"x\": [1]}") && saved.contains("\"zeta\": null"));
    assert_eq!(write(&read_text(&saved).unwrap()), saved);
}

#[test]
fn ids_are_given_where_left_out_and_stay() {
    let text = r#"{"gaitway": 1, "characters": [{"name": "A", "constraints": [
        {"kind": "body", "frame": 0, "position": [0, 0], "heading": 0},
        {"kind": "body", "frame": 9, "position": [0, 0], "heading": 0},
        {"kind": "style", "from": 0, "to": 4, "tag": "run"},
        {"id": "body-1", "kind": "body", "frame": 5, "position": [0, 0], "heading": 0}]}]}"#;
    let project = read_text(text).unwrap();
    let ids: Vec<&str> = project.characters[0].constraints.iter().map(|c| c.id.as_str()).collect();
    assert_eq!(ids, ["body-2", "body-3", "style-1", "body-1"]);
    assert_eq!(read_text(write(&project)).unwrap(), project);
    assert_eq!((project.fps, project.library.as_str()), (30.0, "builtin"));
    assert_eq!(project.search, Search::default());
}

#[test]
fn broken_json_is_refused_with_its_line() {
    for (text, expected) in [
        ("", "p.gaitway: the file is empty; check that it is the right file"),
        (
            "{\"gaitway\": 1,\n\"name\": \"x\"\n\"fps\": 30}",
            "p.gaitway:3: the JSON is broken at column 1: expected `,` or `}`; mend it, or restore \
             an older copy",
        ),
        (
            "{\"gaitway\": 1,\n",
            "p.gaitway:2: the JSON is broken at column 0: EOF while parsing a value; mend it, or \
             restore an older copy",
        ),
        (
            "{\"gaitway\": 1} x",
            "p.gaitway:1: the JSON is broken at column 16: trailing characters; mend it, or \
             restore an older copy",
        ),
        (
            "{\"gaitway\": NaN}",
            "p.gaitway:1: the JSON is broken at column 13: expected value; mend it, or restore an \
             older copy",
        ),
        (
            "{\"gaitway\": 1e999}",
            "p.gaitway:1: the JSON is broken at column 17: number out of range; mend it, or \
             restore an older copy",
        ),
        ("[1]", "p.gaitway:1: the file is not an object; write {…}"),
        (
            "{\"name\": 1}",
            "p.gaitway:1: the file has no \"gaitway\"; check that it is the right file, or add \
             \"gaitway\": 1",
        ),
    ] {
        assert_eq!(read_text(text).unwrap_err().to_string(), expected);
    }
    let deep = format!("{{\"a\":{}", "[".repeat(100_000));
    assert!(read_text(deep).unwrap_err().what.contains("recursion limit exceeded"));
    let error = read_text(b"{\n\"gaitway\": \"\xff\"}").unwrap_err();
    assert_eq!(error.to_string(), "p.gaitway:2: the text is not UTF-8; save it as UTF-8");
}

#[test]
fn wrong_values_are_refused_with_their_line() {
    check_error(
        "\"gaitway\": 1",
        "\"gaitway\": 2",
        "p.gaitway:2: gaitway is version 2, newer than the 1 that is known here; open it with a \
         newer Gaitway",
    );
    check_error("29.97", "0", "p.gaitway:5: fps is 0; use a rate from 1 to 1000");
    check_error(
        "\"../mocap/cmu\"",
        "7",
        "p.gaitway:6: library is not a text; write it in \"quotes\"",
    );
    check_error(
        "[\"*sit*\"]",
        "\"*sit*\"",
        "p.gaitway:8: palette.exclude is not a list; write […]",
    );
    check_error(
        "\"A\"",
        "\"../A\"",
        "p.gaitway:11: characters[0].name is \"../A\", which has a character that file names must \
         not have; files are named after it: use letters, digits, blanks, - and _",
    );
    check_error(
        "\"B\"",
        "\"a\"",
        "p.gaitway:33: characters[1].name is \"a\" again; give every character its own name",
    );
    check_error(
        "\"frames\": 240",
        "\"frames\": 0",
        "p.gaitway:12: characters[0].length.frames is 0; a motion has at least 1 frame",
    );
    check_error(
        "\"frames\": 240, ",
        "",
        "p.gaitway:12: characters[0].length has no \"frames\"; add \"frames\": 240",
    );
    check_error(
        "\"exact\"",
        "\"loose\"",
        "p.gaitway:12: characters[0].length.mode is \"loose\"; write \"free\", \"preferred\" or \
         \"exact\"",
    );
    check_error(
        "\"weight\": 1.5",
        "\"weight\": -1",
        "p.gaitway:12: characters[0].length.weight is -1, below 0; write 0 or more",
    );
    check_error(
        "\"search\": {",
        "\"search\": 7, \"x\": {",
        "p.gaitway:54: search is not an object; write {…}",
    );
    check_error(
        "\"alternatives\": 6",
        "\"alternatives\": 1e9",
        "p.gaitway:56: search.alternatives is 1000000000, which is not from 0 to 1000; correct the \
         number",
    );
    check_error(
        "18446744073709551615",
        "-1",
        "p.gaitway:55: search.seed is not a whole number from 0 to 2^64 - 1; write a number like 1",
    );
    check_error(
        "\"mirror\": true",
        "\"mirror\": \"yes\"",
        "p.gaitway:58: search.mirror is neither true nor false; write true or false",
    );
}

#[test]
fn wrong_constraints_are_refused_with_their_line() {
    check_error(
        "\"frame\": 239",
        "\"frame\": 0",
        "p.gaitway:17: characters[0].constraints[1] is a second body constraint at frame 0; keep \
         one of them or move one to another frame",
    );
    check_error(
        "\"frame\": 239",
        "\"frame\": 240",
        "p.gaitway:17: characters[0].constraints[1] speaks of frame 240, but the length is 240; \
         use frames up to 239",
    );
    check_error(
        "\"frame\": 239",
        "\"frame\": 1000000",
        "p.gaitway:17: characters[0].constraints[1].frame is 1000000, which is not from 0 to \
         999999; correct the number",
    );
    check_error(
        "\"frame\": 239",
        "\"frame\": -1",
        "p.gaitway:17: characters[0].constraints[1].frame is -1, which is not from 0 to 999999; \
         correct the number",
    );
    check_error(
        "\"frame\": 239",
        "\"frame\": 1.5",
        "p.gaitway:17: characters[0].constraints[1].frame is not a whole number; write a number \
         like 12",
    );
    check_error(
        "[3.0, 1.0]",
        "[3.0, 1.0, 2.0]",
        "p.gaitway:17: characters[0].constraints[1].position has 3 numbers instead of 2; write [x, \
         z]",
    );
    check_error(
        "[3.0, 1.0]",
        "[3.0, 1e30]",
        "p.gaitway:17: characters[0].constraints[1].position[1] is 1000000000000000000000000000000, \
         which is not within ±10000; write a smaller number",
    );
    check_error(
        "\"heading\": 90.0",
        "\"heading\": \"left\"",
        "p.gaitway:17: characters[0].constraints[1].heading is not a number; write a number like \
         1.5",
    );
    check_error(
        "\"kind\": \"joint\"",
        "\"kind\": \"hat\"",
        "p.gaitway:18: characters[0].constraints[2].kind is \"hat\"; write \"body\", \"joint\", \
         \"pose\", \"style\", \"path\" or \"lock\"",
    );
    check_error(
        "\"Head\"",
        "\"\"",
        "p.gaitway:18: characters[0].constraints[2].joint is empty; write a name",
    );
    check_error(
        "\"to\": 100",
        "\"to\": 100, \"from\": 101",
        "p.gaitway:20: characters[0].constraints[4].to is 100, before \"from\" at 101; write the \
         earlier frame first",
    );
    check_error(
        "\"tolerance\": 0.3",
        "\"tolerance\": -0.3",
        "p.gaitway:20: characters[0].constraints[4].tolerance is -0.3, below 0; write 0 or more",
    );
    check_error(
        "[[0.0, 0.0], [1.0, 2.0]]",
        "[[0.0, 0.0]]",
        "p.gaitway:21: characters[0].constraints[5].points has fewer than 2 points; add points [x, \
         z]",
    );
    check_error(
        "\"id\": \"end\"",
        "\"id\": \"start\"",
        "p.gaitway:17: characters[0].constraints[1].id is \"start\" again; give each its own id, or \
         leave it out",
    );
}

#[test]
fn wrong_scenes_are_refused_with_their_line() {
    check_error(
        "\"character\": \"B\"",
        "\"character\": \"C\"",
        "p.gaitway:41: interactions[0].members[1].character is \"C\", whom the project does not \
         have; name one of its characters",
    );
    check_error(
        ",\n        {\"position\": [0.0, 1.2], \"heading\": 180.0}",
        "",
        "p.gaitway:43: interactions[0].relative has 1 entries for 2 members; give every member one \
         place",
    );
    check_error(
        "\"cylinder\"",
        "\"ball\"",
        "p.gaitway:51: obstacles[1].shape is \"ball\"; write \"box\", \"cylinder\" or \"ceiling\"",
    );
    check_error(
        "[1.0, 1.0, 1.0]",
        "[1.0, -1.0, 1.0]",
        "p.gaitway:50: obstacles[0].size has an edge below 0; write lengths of 0 or more",
    );
    let error = read_text("{\"gaitway\": 1,\n\"characters\": []}").unwrap_err();
    assert_eq!(
        error.to_string(),
        "p.gaitway:2: characters is empty; add a character: {\"name\": \"A\"}"
    );
}

#[test]
fn an_invalid_project_is_not_saved_over_a_good_one() {
    let dir = tempfile::tempdir().unwrap();
    let path = dir.path().join("p.gaitway");
    let mut project = read_text(FULL).unwrap();
    save(&project, &path).unwrap();
    assert_eq!(load(&path, &mut Warnings::new()).unwrap(), project);
    project.characters[0].constraints[0].weight = Some(f64::NAN);
    project.characters[0].name = "a/b".to_owned();
    let error = save(&project, &path).unwrap_err();
    assert_eq!(error.line, None);
    assert_eq!(std::fs::read_to_string(&path).unwrap(), FULL);
}

#[test]
fn libraries_are_found_beside_the_project() {
    let project = read_text(FULL).unwrap();
    let path = project.library_path(Path::new("x/p.gaitway"));
    assert_eq!(path.as_deref(), Some(Path::new("x/../mocap/cmu")));
    assert_eq!(relative_to("builtin", Path::new("p.gaitway")), None);
}

#[test]
fn tags_by_hand_are_read_and_written_as_they_stand() {
    let project = |tags: &str| {
        read_text(format!(
            "{{\"gaitway\": 1, \"tags\": {tags}, \"characters\": [{{\"name\": \"A\"}}]}}"
        ))
    };
    let tags =
        "{\"16_15\": [\"tired\", {\"tag\": \"limp\", \"from\": 10, \"to\": 40, \"mood\": 1}]}";
    let read = project(tags).unwrap();
    let given = read.hand_tags();
    assert_eq!(given.of("16_15").len(), 2);
    assert!(given.of("16_15")[1].has(motion_core::units::FrameIdx(40)));
    let saved = write(&read);
    assert_eq!(read_text(&saved).unwrap(), read);
    assert!(saved.contains("\"mood\": 1"), "{saved}");
    for (bad, expected) in [
        ("[]", "tags is not an object"),
        ("{\"a\": [\" \"]}", "tags.a[0] is empty"),
        (
            "{\"a\": [{\"tag\": \"x\", \"from\": 9, \"to\": 3}]}",
            "tags.a[0].to does not end a stretch",
        ),
        ("{\"a\": [{\"tag\": \"x\", \"from\": 9}]}", "tags.a[0] does not end a stretch"),
    ] {
        let said = project(bad).unwrap_err().to_string();
        assert!(said.contains(expected), "{said}");
    }
}

#[test]
fn the_shared_problems_are_read_without_a_warning() {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../../shared/problems");
    let Ok(entries) = std::fs::read_dir(&folder) else {
        println!("skipped: there is no {}", folder.display());
        return;
    };
    for path in entries.map(|entry| entry.unwrap().path()) {
        if path.extension().is_some_and(|e| e == "gaitway") {
            let mut warnings = Warnings::new();
            let project = load(&path, &mut warnings).unwrap_or_else(|error| panic!("{error}"));
            assert!(warnings.is_empty(), "{warnings:?}");
            let saved = write(&project);
            assert_eq!(write(&read_text(&saved).unwrap()), saved, "{}", path.display());
        }
    }
}

proptest! {
    #[test]
    fn random_bytes_never_panic(bytes in prop::collection::vec(any::<u8>(), 0..300)) {
        drop(read_text(&bytes));
    }

    #[test]
    fn damaged_projects_never_panic_and_sound_ones_round_trip(
        cut in 0..FULL.len(),
        edits in prop::collection::vec(
            (0..FULL.len(), prop::sample::select(b"0123456789-.eE\"[]{},: \nanbt\xff".to_vec())),
            0..5,
        ),
    ) {
        let mut bytes = FULL.as_bytes().to_vec();
        for (at, byte) in edits {
            bytes[at] = byte;
        }
        drop(read_text(&bytes[..cut]));
        if let Ok(project) = read_text(&bytes) {
            let saved = write(&project);
            prop_assert_eq!(read_text(&saved).unwrap(), project);
        }
    }

    #[test]
    fn values_of_another_kind_never_panic(
        at in 0usize..60,
        with in prop::sample::select(vec!["null", "1", "-1", "1e300", "\"x\"", "[]", "{}", "true"]),
    ) {
        // Replaces the value behind the `at`-th colon, up to the next comma or bracket.
        let Some((colon, _)) = FULL.match_indices(": ").nth(at) else { return Ok(()) };
        let rest = &FULL[colon + 2..];
        let end = rest.find([',', '}', '\n']).unwrap_or(rest.len());
        drop(read_text(format!("{}: {with}{}", &FULL[..colon], &rest[end..])));
    }
}
