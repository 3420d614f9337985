#![allow(clippy::all, clippy::unwrap_used, clippy::print_stdout, clippy::print_stderr)]
use glam::{Vec2, Vec3};
use motion_core::cancel::CancelToken;
use motion_core::constraint::*;
use motion_core::score::Wishes;
use motion_core::search::*;
use motion_core::units::FrameIdx;
use motion_io::diagnostic::Warnings;
use motion_io::project_file::{self, ConstraintKind as K, Shape};
use std::sync::Arc;
use std::time::Instant;

fn wishes(p: &project_file::Project, c: &project_file::Character, lib: &SearchLibrary) -> Wishes {
    let mut w = Wishes::default();
    for k in &c.constraints {
        let weight = k.weight.unwrap_or(1.0) as f32;
        match &k.kind {
            K::Body { frame, position_m, heading_deg, .. } => w.body.push(BodyConstraint {
                frame: *frame,
                position_m: Vec2::new(position_m[0] as f32, position_m[1] as f32),
                heading_rad: (heading_deg.unwrap_or(0.0) as f32).to_radians(),
                height_m: None,
                weight,
                tolerance: Tolerance::default(),
            }),
            K::Joint { frame, joint, position_m, .. } => {
                let j = lib.clips().skeleton().find(joint).unwrap();
                w.joints.push(JointConstraint::new(
                    *frame,
                    j,
                    Vec3::new(position_m[0] as f32, position_m[1] as f32, position_m[2] as f32),
                ));
            }
            K::Pose { frame, clip, clip_frame, .. } => w.poses.push(PoseConstraint::new(
                *frame,
                lib.clips().by_id(clip).unwrap(),
                FrameIdx(*clip_frame),
            )),
            K::Style { from, to, tag } => {
                w.styles.push(StyleConstraint { from: *from, to: *to, tag: tag.clone(), weight })
            }
            _ => {}
        }
    }
    w.body.sort_by_key(|b| b.frame);
    for o in &p.obstacles {
        if let Shape::Box { center_m, size_m, heading_deg } = o.shape {
            let v = |a: [f64; 3]| Vec3::new(a[0] as f32, a[1] as f32, a[2] as f32);
            w.obstacles.push(Obstacle::Box {
                center_m: v(center_m),
                size_m: v(size_m),
                heading_rad: (heading_deg as f32).to_radians(),
            });
        }
    }
    if let Some(l) = &c.length {
        w.length =
            l.frames.map(|frames| LengthWish { frames, mode: LengthMode::Preferred, weight: 1.0 });
    }
    w
}

fn main() {
    let args: Vec<String> = std::env::args().collect();
    let secs: f64 = args[1].parse().unwrap();
    let seeds: u64 = args[2].parse().unwrap();
    let only: Vec<&str> = args[3..].iter().map(String::as_str).collect();
    let (file, _) =
        motion_io::library_file::LibraryFile::load(std::path::Path::new("/tmp/cmu.gwlib")).unwrap();
    let mut file = file;
    if !std::path::Path::new("/tmp/cmu2.gwlib").exists() {
        file.graph = motion_core::graph::build(
            &file.clips,
            &motion_core::graph::BuildOptions::default(),
            &CancelToken::new(),
            &|_| (),
        )
        .unwrap();
        file.save(std::path::Path::new("/tmp/cmu2.gwlib")).unwrap();
    }
    let (file, _) =
        motion_io::library_file::LibraryFile::load(std::path::Path::new("/tmp/cmu2.gwlib"))
            .unwrap();
    let motion_io::library_file::LibraryFile { clips, graph, .. } = file;
    let lib = Arc::new(SearchLibrary::new(Arc::new(clips), Arc::new(graph)));
    let dir = std::path::PathBuf::from("/work/shared/problems");
    let mut files: Vec<_> = std::fs::read_dir(dir)
        .unwrap()
        .map(|e| e.unwrap().path())
        .filter(|p| p.extension().is_some_and(|e| e == "gaitway"))
        .collect();
    files.sort();
    for f in files {
        let name = f.file_stem().unwrap().to_string_lossy().to_string();
        if name.starts_with("09") || (!only.is_empty() && !only.iter().any(|o| name.starts_with(o)))
        {
            continue;
        }
        let p = project_file::load(&f, &mut Warnings::new()).unwrap();
        let mut firsts = vec![];
        let mut newest = 0.0;
        let mut cpu = vec![];
        let mut bests = vec![];
        let mut alts = vec![];
        let mut its = vec![];
        let mut terms = None;
        let mut accs = 0;
        let mut cuts = 0;
        let mut bests1 = vec![];
        let mut mins = vec![];
        for seed in 1..=seeds {
            let problem = Problem {
                wishes: wishes(&p, &p.characters[0], &lib),
                allowed_clips: vec![true; lib.clips().clips().len()],
                bridges: true,
            };
            let w = problem.wishes.clone();
            let t0 = Instant::now();
            let mut s = match Search::new(Arc::clone(&lib), problem, seed) {
                Ok(s) => s,
                Err(e) => {
                    println!("{name}: {e}");
                    break;
                }
            };
            let new_s = t0.elapsed().as_secs_f64();
            let t = Instant::now();
            let mut first = f64::INFINITY;
            let mut best1 = f32::INFINITY;
            while t.elapsed().as_secs_f64() < secs {
                s.step(&CancelToken::new());
                if t.elapsed().as_secs_f64() < 1.0 {
                    best1 = s.progress().best;
                }
                if first.is_infinite() && s.progress().first_acceptable.is_some() {
                    first = t.elapsed().as_secs_f64();
                }
            }
            firsts.push(first);
            newest = new_s;
            bests.push(s.progress().best);
            bests1.push(best1);
            alts.push(s.alternatives().len());
            its.push(s.progress().iteration);
            mins.push(s.progress().n_minima);
            let _ = &mut cpu;
            let _: &Vec<f64> = &cpu;
            if let Some(b) = s.alternatives().first() {
                if let Some(j) = s.judge(&b.path) {
                    accs += usize::from(j.is_acceptable(&w));
                    terms = Some((j.terms, j.n_frames, j.deepest_m, j.styles.clone()));
                    cuts = b.path.cuts.len();
                }
            }
        }
        firsts.sort_by(f64::total_cmp);
        bests.sort_by(f32::total_cmp);
        bests1.sort_by(f32::total_cmp);
        print!("new {:.3} ", newest);
        println!(
            "{name}: first {:.3}/{:.3} best1s {:.3}/{:.3} best {:.3}/{:.3} acc {accs} alts {alts:?} rounds {:?} minima {:?} cuts {cuts}",
            firsts[firsts.len() / 2],
            firsts.last().unwrap(),
            bests1[bests1.len() / 2],
            bests1.last().unwrap(),
            bests[bests.len() / 2],
            bests[bests.len() - 1],
            its[0],
            mins[0]
        );
        println!("     {terms:?}");
    }
}
