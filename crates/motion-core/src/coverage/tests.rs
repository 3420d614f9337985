//! Coverage of small libraries whose gaps are known.

use super::*;
use crate::cancel::CancelToken;
use crate::graph::{BuildOptions, build};
use crate::testing::{Walk, set, walks};

fn coverage(clips: &ClipSet) -> Coverage {
    let cancel = CancelToken::new();
    let graph = build(clips, &BuildOptions::default(), &cancel, &|_| ()).expect("a graph");
    Coverage::new(clips, &graph)
}

fn sentences(coverage: &Coverage) -> Vec<String> {
    coverage.missing.iter().map(ToString::to_string).collect()
}

#[test]
fn time_is_counted_once() {
    let clips = walks();
    let coverage = coverage(&clips);
    let in_cells: f64 = coverage.travel.cells.iter().map(|cell| cell.secs).sum();
    assert!((in_cells - clips.n_frames() as f64 / 30.0).abs() < 1e-9, "{in_cells} s");
    assert!((coverage.secs - 3.0 * 59.0 / 30.0).abs() < 1e-9, "{} s", coverage.secs);
    assert_eq!(coverage.ways.clips.len(), 3);
    assert_eq!(coverage.ways.with_bridges.sizes.iter().sum::<usize>(), 3);
}

#[test]
fn a_library_of_left_turns_asks_for_the_others() {
    let walk =
        |turn_rad_s, phase| Walk { n_frames: 90, speed_m_s: 0.8, turn_rad_s, phase }.motion();
    let coverage = coverage(&set(vec![walk(0.7, 0.0), walk(0.8, 0.3)]));
    let said = sentences(&coverage);
    let has = |text: &str| said.iter().any(|sentence| sentence.contains(text));
    assert!(has("no right turn while walking: record 3–4 takes"), "{said:#?}");
    assert!(has("or build the library with --mirror"), "{said:#?}");
    assert!(!has("no left turn while walking"), "{said:#?}");
    assert!(has("no run: record") && has("no jump: record"), "{said:#?}");
    assert!(!has("while running"), "who does not run need not turn: {said:#?}");
    assert!(coverage.travel.secs(SpeedClass::Slow, TurnClass::Left) > 5.0);
    assert!(coverage.travel.secs(SpeedClass::Slow, TurnClass::Right) < EMPTY_SECS);
    assert!((coverage.tag_secs("turn left") - 6.0).abs() < 0.1);
}

#[test]
fn classes_meet_without_a_gap() {
    for (speed, class) in [(0.0, "standing"), (0.3, "slow"), (1.79, "walking"), (9.0, "running")] {
        assert_eq!(SpeedClass::of(speed).name(), class, "{speed} m/s");
    }
    for (deg, class) in [(-61.0, "sharp right"), (-20.0, "straight"), (20.1, "left")] {
        assert_eq!(TurnClass::of(f32::to_radians(deg)).name(), class, "{deg} degrees/s");
    }
    for (idx, class) in SpeedClass::ALL.into_iter().enumerate() {
        assert_eq!((class as usize, SpeedClass::of(class.from_m_s())), (idx, class));
    }
    for (idx, class) in TurnClass::ALL.into_iter().enumerate() {
        assert_eq!(class as usize, idx);
    }
}

#[test]
fn clips_that_lead_nowhere_are_named() {
    let clips = walks();
    let options = BuildOptions::default();
    let mut graph = build(&clips, &options, &CancelToken::new(), &|_| ()).expect("a graph");
    graph.with_bridges.dead_from[1] = 5;
    let said = sentences(&Coverage::new(&clips, &graph));
    assert!(
        said.iter().any(|s| s.starts_with("nothing leads out of clip 1 after frame 5: record")),
        "{said:#?}"
    );
}
