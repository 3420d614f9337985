//! What every mannequin promises, on bodies of several kinds and on random ones.

mod bodies;
mod random;
mod skin;
mod sole;

use std::collections::BTreeSet;

use glam::DVec3;

use super::*;
use bodies::{child, cmu, dog, every_human, lafan, mixamo, robot_arm};

fn volume_litres(mesh: &SkinnedMesh) -> f32 {
    // About a point of its own: seen from far away, a thin body's parts cancel to noise.
    let from = mesh.vertices().first().map_or(DVec3::ZERO, |vertex| vertex.position_m.as_dvec3());
    let at = |v: u32| mesh.vertices()[v as usize].position_m.as_dvec3() - from;
    let sixth = |t: &[u32; 3]| at(t[0]).dot(at(t[1]).cross(at(t[2])));
    (mesh.triangles().iter().map(sixth).sum::<f64>() / 6.0 * 1e3) as f32
}

/// Checks that every edge has two triangles, one each way, that none is without area, and that
/// they look outwards. Returns how many vertices more there are than a sphere's triangles need.
#[track_caller]
fn check_closed(mesh: &SkinnedMesh) -> i64 {
    let mut edges: BTreeSet<(u32, u32)> = BTreeSet::new();
    for &[a, b, c] in mesh.triangles() {
        let [p, q, r] = [a, b, c].map(|v| mesh.vertices()[v as usize].position_m.as_dvec3());
        let longest = p.distance(q).max(q.distance(r)).max(r.distance(p));
        let area = (q - p).cross(r - p).length();
        assert!(area > 1e-6 * longest * longest && longest > 0.0, "a triangle without area");
        for (from, to) in [(a, b), (b, c), (c, a)] {
            assert!(edges.insert((from, to)), "edge {from}-{to} is there twice");
        }
    }
    for &(from, to) in &edges {
        assert!(edges.contains(&(to, from)), "edge {from}-{to} is open");
    }
    assert!(volume_litres(mesh) > 0.0, "inside out");
    mesh.vertices().len() as i64 - (mesh.triangles().len() / 2) as i64 - 2
}

#[test]
fn a_human_body_is_one_piece_without_holes_at_every_level() {
    for (name, plan) in every_human() {
        let model = mannequin(&plan);
        assert_eq!(model.levels().len(), LEVEL_TRIANGLES.len(), "{name}");
        for (level, most) in model.levels().iter().zip(LEVEL_TRIANGLES) {
            let n = level.triangles().len();
            assert!(n <= most && n > most * 9 / 10, "{name} has {n} triangles");
            assert_eq!(check_closed(level), 0, "{name} at {n} triangles is no sphere");
        }
    }
}

/// Bodies of 1.75 m weigh 60 to 70 kg at a density of 1; the coarsest level loses a little.
#[test]
fn a_body_weighs_what_a_person_weighs() {
    for (name, plan) in [("Mixamo", mixamo()), ("LaFAN1", lafan()), ("CMU", cmu())] {
        for level in mannequin(&plan).levels() {
            let litres = volume_litres(level);
            assert!((50.0..80.0).contains(&litres), "{name}: {litres} l");
        }
    }
    let litres = volume_litres(&mannequin(&child()).levels()[0]);
    assert!((11.0..20.0).contains(&litres), "a child of 1.08 m: {litres} l");
}

#[test]
fn a_body_reaches_from_the_floor_to_the_crown() {
    for (name, plan) in [("Mixamo", mixamo()), ("LaFAN1", lafan())] {
        let model = mannequin(&plan);
        let mesh = &model.levels()[0];
        let top = mesh.vertices().iter().map(|v| v.position_m.y).fold(f32::MIN, f32::max);
        assert!((1.70..1.82).contains(&top), "{name}: {top}");
    }
}

#[test]
fn a_body_that_is_its_own_mirror_image_has_such_a_skin() {
    for level in mannequin(&mixamo()).levels() {
        let key = |p: Vec3| (p * 1e5).round().as_ivec3().to_array();
        let all: BTreeSet<[i32; 3]> = level.vertices().iter().map(|v| key(v.position_m)).collect();
        let is_there = |p: Vec3| {
            let k = key(p);
            let near = |d: i32| [k[0] + d, k[1], k[2]];
            [0, 1, -1].into_iter().any(|d| all.contains(&near(d)))
        };
        for v in level.vertices() {
            let image = v.position_m * Vec3::new(-1.0, 1.0, 1.0);
            assert!(is_there(image), "nothing is at {image}");
        }
    }
}

#[test]
fn other_skeletons_have_a_body_too() {
    for (name, plan) in [("dog", dog()), ("robot arm", robot_arm())] {
        let model = mannequin(&plan);
        assert!(model.levels().len() >= 3, "{name}");
        for level in model.levels() {
            check_closed(level);
            // Joints with bones of their own move something.
            let moves = |joint: usize| {
                level.vertices().iter().any(|v| {
                    let is_it = |(&j, &w): (&u16, &f32)| usize::from(j) == joint && w > 0.3;
                    v.joints.iter().zip(&v.weights).any(is_it)
                })
            };
            assert!(moves(0) && moves(1), "{name}");
        }
    }
}

#[test]
fn threads_make_no_difference() {
    let plan = cmu();
    let one = rayon::ThreadPoolBuilder::new().num_threads(1).build().unwrap();
    assert_eq!(one.install(|| mannequin(&plan)), mannequin(&plan));
}

#[test]
fn absurd_plans_are_coarse_not_large() {
    let plan = bodies::chain(1000, 1000.0);
    let model = mannequin(&plan);
    assert!(model.levels()[0].triangles().len() <= LEVEL_TRIANGLES[0]);
    check_closed(&model.levels()[0]);
    let nothing = BodyPlan { joints: Vec::new(), sole_m: [0.0; 2] };
    assert_eq!(mannequin(&nothing).levels()[0].joint_from_mesh().len(), 1);
}
