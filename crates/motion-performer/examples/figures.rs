//! Prints figures of every built-in clip.
#![allow(clippy::print_stdout, clippy::disallowed_methods, reason = "a development tool")]
use motion_performer::builtin_clips;
fn main() -> Result<(), Box<dyn std::error::Error>> {
    let start = std::time::Instant::now();
    let set = builtin_clips()?;
    println!("{} clips, {} frames in {:?}", set.clips().len(), set.n_frames(), start.elapsed());
    let sk = set.skeleton();
    let n = sk.n_joints();
    for clip in set.clips() {
        let p = clip.motion.joint_positions_m(sk);
        let nf = clip.n_frames();
        let mut acc: Vec<(f32, usize, usize)> = Vec::new();
        let mut slide = 0f32;
        let mut pen = 0f32;
        let mut speed = (0f32, 0, 0);
        let mut kn = (999f32, 0f32);
        for f in 0..nf {
            for j in 0..n {
                if f + 1 < nf && f > 0 {
                    let a = (p[(f + 1) * n + j] - p[f * n + j] * 2.0 + p[(f - 1) * n + j]).length()
                        * 900.0;
                    acc.push((a, f, j));
                }
                if f > 0 {
                    let v = (p[f * n + j] - p[(f - 1) * n + j]).length() * 30.0;
                    if v > speed.0 {
                        speed = (v, f, j);
                    }
                }
                pen = pen.max(-(p[f * n + j].y));
            }
            for (s, b) in [(0usize, 17usize), (1, 21)] {
                let c = |f: usize| {
                    let c = clip.track.contacts[f];
                    if s == 0 { c.left } else { c.right }
                };
                if f > 0 && c(f) && c(f - 1) {
                    slide = slide.max(p[f * n + b].distance(p[(f - 1) * n + b]));
                }
                let k = motion_core::rotation::log(clip.motion.rotations(f)[b - 2])
                    .length()
                    .to_degrees();
                kn = (kn.0.min(k), kn.1.max(k));
                if pen < 0.025 - p[f * n + b].y {
                    pen = 0.025 - p[f * n + b].y;
                }
            }
        }
        acc.sort_by(|a, b| b.0.total_cmp(&a.0));
        let w = acc[0];
        let hands = acc.iter().find(|a| a.2 <= 13).unwrap();
        let t = &clip.track.world_from_torso;
        let turn: f32 = (1..nf).map(|f| (t[f - 1].inverse() * t[f]).heading_rad()).sum();
        println!(
            "{:22} {:3} fr  acc {:5.1} ({} f{}) p99 {:4.1} upper {:5.1} ({} f{})  v {:4.1} ({})  slide {:.1e} pen {:.3} knee {:.0}..{:.0} turn {:6.1} end ({:.2},{:.2})",
            clip.id,
            nf,
            w.0,
            sk.joints()[w.2].name,
            w.1,
            acc[acc.len() / 100].0,
            hands.0,
            sk.joints()[hands.2].name,
            hands.1,
            speed.0,
            sk.joints()[speed.2].name,
            slide,
            pen,
            kn.0,
            kn.1,
            turn.to_degrees(),
            t[nf - 1].x_m,
            t[nf - 1].z_m
        );
    }
    Ok(())
}
