//! What files ask is what the search is asked.

use glam::{Vec2, Vec3};
use motion_core::constraint::Obstacle;
use motion_core::units::FrameIdx;
use motion_io::diagnostic::Warnings;
use motion_io::project_file;

use super::*;
use crate::fixture::library;

/// The problem of the first character of a project with these keys.
fn problem(keys: &str, constraints: &str) -> Result<CharacterProblem, FileError> {
    let text = format!(
        "{{\"gaitway\": 1, \"name\": \"p\", \"fps\": 30, \"library\": \"builtin\", {keys}
          \"characters\": [{{\"name\": \"A\", \"constraints\": [{constraints}]}}]}}"
    );
    let path = Path::new("p.gaitway");
    let project = project_file::read(text.as_bytes(), path, &mut Warnings::new())?;
    problem_of(&project, &project.characters[0], &library(), true, path)
}

fn names_in_use(problem: &CharacterProblem) -> Vec<String> {
    let library = library();
    let clips = library.clips.clips().iter().zip(&problem.problem.allowed_clips);
    clips.filter(|(_, allowed)| **allowed).map(|(clip, _)| clip.id.clone()).collect()
}

#[test]
fn a_palette_is_patterns_and_tags_and_has_mirror_images_along() {
    for (palette, expected) in [
        ("{\"include\": [\"walk*\"]}", "walk walk_late walk@mirror walk_late@mirror"),
        ("{\"include\": [\"WALK\"]}", "walk walk@mirror"),
        ("{\"include\": [\"????\"], \"exclude\": [\"*@mirror\"]}", "left slow walk"),
        ("{\"exclude\": [\"walk*\", \"left\"]}", "right slow right@mirror slow@mirror"),
        ("{\"tags\": [\"late\"]}", "walk_late walk_late@mirror"),
    ] {
        let found = problem(&format!("\"palette\": {palette},"), "").unwrap();
        assert_eq!(names_in_use(&found).join(" "), expected, "{palette}");
    }
}

#[test]
fn constraints_come_in_the_order_of_their_frames_under_their_ids() {
    let found = problem(
        "",
        "{\"id\": \"b\", \"kind\": \"body\", \"frame\": 50, \"position\": [0, 4], \"heading\": 90},
         {\"id\": \"a\", \"kind\": \"body\", \"frame\": 10, \"position\": [0, 0], \"heading\": -90}",
    );
    let found = found.unwrap();
    assert_eq!(found.ids.body, ["a", "b"]);
    let headings: Vec<f32> =
        found.problem.wishes.body.iter().map(|wish| wish.heading_rad.to_degrees()).collect();
    assert_eq!(headings, [-90.0, 90.0], "degrees become radians");
    assert_eq!(found.remarks, [""; 0]);
}

/// The refusal of a project with these constraints, without whose they are.
#[track_caller]
fn refusal(keys: &str, constraints: &str) -> String {
    let text = problem(keys, constraints).expect_err("it cannot be asked").to_string();
    text.strip_prefix("p.gaitway: character \"A\": ").expect("says whose it is").to_owned()
}

#[test]
fn only_the_first_open_heading_is_that_of_the_way() {
    let found = problem(
        "",
        "{\"id\": \"a\", \"kind\": \"body\", \"frame\": 0, \"position\": [0, 0]},
         {\"id\": \"b\", \"kind\": \"body\", \"frame\": 60, \"position\": [3, 0]}",
    );
    let found = found.unwrap();
    let body = &found.problem.wishes.body;
    assert!((body[0].heading_rad.to_degrees() - 90.0).abs() < 1e-3, "{:?}", body[0]);
    assert!(
        body[0].tolerance.heading_rad.is_finite() && body[1].tolerance.heading_rad.is_infinite()
    );
    assert_eq!(
        found.remarks,
        ["body constraint \"a\" leaves its heading open; the direction of the way was taken, 90°"]
    );
}

#[test]
fn a_pose_before_it_places_the_motion_instead() {
    let found = problem(
        "",
        "{\"id\": \"p\", \"kind\": \"pose\", \"frame\": 0, \"clip\": \"walk\", \"clip_frame\": 3,
          \"position\": [1, 2], \"heading\": 90},
         {\"id\": \"b\", \"kind\": \"body\", \"frame\": 60, \"position\": [3, 0]}",
    );
    let found = found.unwrap();
    assert!(found.problem.wishes.body[0].tolerance.heading_rad.is_infinite());
    assert_eq!(found.problem.wishes.anchor().map(|(frame, _)| frame), Some(0));
    assert_eq!(found.remarks, [""; 0]);
}

#[test]
fn every_kind_becomes_a_wish() {
    let obstacle =
        "{\"shape\": \"ceiling\", \"center\": [0, 1.4, 5], \"size\": [2, 0, 1], \"heading\": 90}";
    let found = problem(
        &format!("\"obstacles\": [{obstacle}],"),
        "{\"id\": \"b\", \"kind\": \"body\", \"frame\": 0, \"position\": [0, 0], \"heading\": 0,
          \"tolerance\": {\"position\": 0.5}},
         {\"id\": \"j\", \"kind\": \"joint\", \"frame\": 5, \"joint\": \"Head\", \"position\": [0, 1.7, 1],
          \"velocity\": [0, 0, 1], \"weight\": 2, \"tolerance\": 0.1},
         {\"id\": \"p\", \"kind\": \"pose\", \"frame\": 9, \"clip\": \"left\", \"clip_frame\": 7},
         {\"id\": \"s\", \"kind\": \"style\", \"from\": 0, \"to\": 9, \"tag\": \"walk\"},
         {\"id\": \"w\", \"kind\": \"path\", \"from\": 0, \"to\": 30, \"points\": [[0, 0], [0, 2]]},
         {\"id\": \"l\", \"kind\": \"lock\", \"from\": 20, \"to\": 24,
          \"pieces\": [{\"clip\": \"walk\", \"from\": 30, \"to\": 34}]}",
    );
    let found = found.unwrap();
    let (wishes, ids) = (&found.problem.wishes, &found.ids);
    let all = [&ids.body, &ids.joints, &ids.poses, &ids.styles, &ids.follows, &ids.locks];
    assert_eq!(all.map(|ids| ids.join(" ")), ["b", "j", "p", "s", "w", "l"]);
    let body = wishes.body[0].tolerance;
    assert_eq!((body.position_m, body.frames), (0.5, 10.0), "what is left out is the usual");
    let joint = &wishes.joints[0];
    assert_eq!((joint.weight, joint.tolerance_m), (2.0, 0.1));
    assert_eq!(joint.velocity_m_s, Some(Vec3::Z));
    assert_eq!((wishes.poses[0].frame, wishes.poses[0].clip_frame), (9, FrameIdx(7)));
    assert_eq!(wishes.poses[0].place(), None);
    assert_eq!(
        (wishes.styles[0].from, wishes.styles[0].to, wishes.styles[0].tag.as_str()),
        (0, 9, "walk")
    );
    assert_eq!(wishes.follows[0].points_m, [Vec2::ZERO, Vec2::new(0.0, 2.0)]);
    assert_eq!(wishes.locks[0].pieces[0].from, FrameIdx(30));
    let Obstacle::Ceiling { center_m, size_m, heading_rad } = wishes.obstacles[0] else {
        panic!("{:?}", wishes.obstacles);
    };
    assert_eq!((center_m, size_m), (Vec3::new(0.0, 1.4, 5.0), Vec2::new(2.0, 1.0)));
    assert!((heading_rad - std::f32::consts::FRAC_PI_2).abs() < 1e-6, "degrees become radians");
}

#[test]
fn a_tolerance_of_nothing_is_a_small_one() {
    let found = problem(
        "",
        "{\"id\": \"b\", \"kind\": \"body\", \"frame\": 0, \"position\": [0, 0], \"heading\": 0,
          \"tolerance\": {\"position\": 0, \"heading\": 0, \"frames\": 0}}",
    );
    let tolerance = found.unwrap().problem.wishes.body[0].tolerance;
    assert!(tolerance.is_valid() && tolerance.position_m < 0.01, "{tolerance:?}");
}

#[test]
fn what_cannot_be_shown_is_refused_by_its_id() {
    let pose = |clip: &str, frame: u32| {
        format!(
            "{{\"id\": \"kick\", \"kind\": \"pose\", \"frame\": 5, \"clip\": \"{clip}\", \"clip_frame\": {frame}}}"
        )
    };
    assert_eq!(
        refusal("", &pose("135_04", 3)),
        "pose constraint \"kick\" shows clip \"135_04\", which is not in the library; import the \
         clip, or choose one of the library's"
    );
    let n_frames = library().clips.clips()[0].n_frames();
    let clip = library().clips.clips()[0].id.clone();
    let (frame, last) = (n_frames as u32 + 3, n_frames - 1);
    assert_eq!(
        refusal("", &pose(&clip, frame)),
        format!(
            "pose constraint \"kick\" shows frame {frame} of clip {clip:?}, which ends at frame \
             {last}; choose a frame from 0 to {last}"
        )
    );
    let palette = "\"palette\": {\"exclude\": [\"left\"]},";
    assert_eq!(
        refusal(palette, &pose("left", 3)),
        "pose constraint \"kick\" shows clip \"left\", which the palette leaves out; include the \
         clip, or choose another"
    );
    let joint = "{\"id\": \"tail\", \"kind\": \"joint\", \"frame\": 5, \"joint\": \"Tail\", \"position\": [0, 1, 0]}";
    assert_eq!(
        refusal("", joint),
        "joint constraint \"tail\" speaks of \"Tail\", which this body does not have; name a joint \
         of the library's skeleton, or a role such as Head or LeftHand"
    );
    let lock = "{\"id\": \"keep\", \"kind\": \"lock\", \"from\": 5, \"to\": 9,
        \"pieces\": [{\"clip\": \"walk\", \"from\": 0, \"to\": 9}]}";
    assert_eq!(
        refusal("", lock),
        "lock constraint \"keep\" speaks of 5 frames and its pieces show 10; correct its \"to\", \
         its \"from\" or its pieces, so that both are 5"
    );
    let path = "{\"id\": \"way\", \"kind\": \"path\", \"from\": 5, \"to\": 5, \"points\": [[0, 0], [0, 3]]}";
    assert_eq!(
        refusal("", path),
        "path constraint \"way\" begins and ends at frame 5; give it a stretch of time: a \"to\" \
         after \"from\""
    );
    let two = format!("{}, {}", pose("walk", 3), pose("walk", 4).replace("kick", "roll"));
    assert_eq!(
        refusal("", &two),
        "pose \"kick\" and pose \"roll\" ask for different things at one frame; move one of them \
         to another frame, or remove it"
    );
}

#[test]
fn a_tag_that_nothing_has_is_said_with_those_that_there_are() {
    let style = "{\"id\": \"s\", \"kind\": \"style\", \"from\": 0, \"to\": 9, \"tag\": \"swim\"}";
    let found = problem("", style).unwrap();
    assert_eq!(found.problem.wishes.styles.len(), 1, "it counts all the same");
    let remark = &found.remarks[0];
    assert!(
        remark.starts_with(
            "style constraint \"s\" asks for \"swim\", which no clip in use has; they have "
        ),
        "{remark}"
    );
    assert!(remark.contains("walk"), "{remark}");
}

#[test]
fn weights_reach_the_search() {
    let names = ["continuity", "length", "body", "joint", "style", "path", "environment"];
    let all: Vec<String> =
        names.iter().zip(2..).map(|(name, value)| format!("\"{name}\": {value}")).collect();
    let weights = format!("\"search\": {{\"weights\": {{{}, \"mood\": 3}}}},", all.join(", "));
    let found = problem(&weights, "").unwrap();
    assert_eq!(found.problem.wishes.weights.all(), [2.0, 3.0, 4.0, 5.0, 6.0, 7.0, 8.0]);
    assert_eq!(found.remarks, ["the weight \"mood\" is of no term of the score"]);
}
