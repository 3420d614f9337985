//! Projects with one mistake each, and the line that says it.

use motion_tests::cli::Dir;

use crate::{CORNER, dir_with_library, gaitway};

/// Replaces `from` by `to` in a good project and expects this after `gaitway: bad.gaitway`.
#[track_caller]
fn check(dir: &Dir, from: &str, to: &str, expected: &str) {
    assert!(CORNER.contains(from), "{from:?} is not in the project");
    dir.file("bad.gaitway", CORNER.replace(from, to));
    gaitway(dir, "solve bad.gaitway -o out --iterations 1")
        .refused(&format!("gaitway: bad.gaitway{expected}"));
    assert!(!dir.join("out").exists(), "nothing is written for a project that is refused");
}

#[test]
fn what_is_wrong_is_said_with_its_line() {
    let dir = dir_with_library();
    for (from, to, expected) in [
        (
            "\"gaitway\": 1",
            "\"gaitway\": 2",
            ":2: gaitway is version 2, newer than the 1 that is known here; \
             open it with a newer Gaitway",
        ),
        ("\"fps\": 30", "\"fps\": 0", ":4: fps is 0; use a rate from 1 to 1000"),
        (
            "\"frames\": 90",
            "\"frames\": 0",
            ":8: characters[0].length.frames is 0; a motion has at least 1 frame",
        ),
        (
            "\"frame\": 89",
            "\"frame\": 0",
            ":11: characters[0].constraints[1] is a second body constraint at \
             frame 0; keep one of them or move one to another frame",
        ),
        (
            "\"frame\": 89",
            "\"frame\": -1",
            ":11: characters[0].constraints[1].frame is -1, which is not from 0 to \
             999999; correct the number",
        ),
        (
            "[1.5, 2.5]",
            "[1.5]",
            ":11: characters[0].constraints[1].position has 1 numbers instead of \
             2; write [x, z]",
        ),
        (
            "\"kind\": \"body\"",
            "\"kind\": \"bdy\"",
            ":10: characters[0].constraints[0].kind is \"bdy\"; write \"body\", \
             \"joint\", \"pose\", \"style\", \"path\" or \"lock\"",
        ),
        (
            "\"end\"",
            "\"start\"",
            ":11: characters[0].constraints[1].id is \"start\" again; give each \
             its own id, or leave it out",
        ),
        (
            "\"A\"",
            "\"../A\"",
            ":7: characters[0].name is \"../A\", which has a character that file \
             names must not have; files are named after it: use letters, digits, \
             blanks, - and _",
        ),
        (
            "}],",
            "",
            ":14: the JSON is broken at column 3: expected `,` or `}`; mend it, or \
             restore an older copy",
        ),
    ] {
        check(&dir, from, to, expected);
    }
}

#[test]
fn what_does_not_fit_the_library() {
    let dir = dir_with_library();
    check(
        &dir,
        "\"fps\": 30",
        "\"fps\": 24",
        ": the project counts 24 frames per second and its library 30; \
         build the library again with --fps, or change the project",
    );
    check(
        &dir,
        "\"library\": \"small.gwlib\"",
        "\"library\": \"small.gwlib\", \"palette\": {\"include\": [\"sit*\"]}",
        ": the palette leaves none of the library's 5 clips; include more or exclude less",
    );
    check(
        &dir,
        "\"library\": \"small.gwlib\"",
        "\"library\": \"small.gwlib\", \"palette\": {\"include\": [\"[\"]}",
        ": the palette has a pattern that is none (error parsing glob '[': unclosed character \
         class; missing ']'); use * for anything and ? for one character",
    );
    dir.file("lost.gaitway", CORNER.replace("small.gwlib", "lost.gwlib"));
    gaitway(&dir, "solve lost.gaitway -o out")
        .refused("gaitway: lost.gwlib: there is no such file; check the path");
}
