//! Bodies that are no people, as the text of BVH files: a dog that trots and a robot arm that
//! swings. No joint has a name or a place that a person's has.

use std::f64::consts::TAU;

/// A joint: name, depth in the tree, offset in centimetres, and where a leaf's bone ends.
type Bone = (&'static str, usize, [f64; 3], Option<[f64; 3]>);

/// A rotation of a joint, degrees about Z, X and Y, in the order of the channels.
type Turn = [f64; 3];

const DOG: &[Bone] = &[
    ("Rump", 0, [0.0, 0.0, 0.0], None),
    ("Loin", 1, [0.0, 2.0, 18.0], None),
    ("Withers", 2, [0.0, 1.0, 24.0], None),
    ("Poll", 3, [0.0, 14.0, 14.0], None),
    ("Muzzle", 4, [0.0, 2.0, 8.0], Some([0.0, -2.0, 12.0])),
    ("PawFL1", 3, [7.0, -8.0, 2.0], None),
    ("PawFL2", 4, [0.0, -20.0, -3.0], None),
    ("PawFL3", 5, [0.0, -22.0, 3.0], Some([0.0, -1.0, 6.0])),
    ("PawFR1", 3, [-7.0, -8.0, 2.0], None),
    ("PawFR2", 4, [0.0, -20.0, -3.0], None),
    ("PawFR3", 5, [0.0, -22.0, 3.0], Some([0.0, -1.0, 6.0])),
    ("PawHL1", 1, [7.0, -6.0, -2.0], None),
    ("PawHL2", 2, [0.0, -20.0, 5.0], None),
    ("PawHL3", 3, [0.0, -23.0, -5.0], Some([0.0, -1.0, 6.0])),
    ("PawHR1", 1, [-7.0, -6.0, -2.0], None),
    ("PawHR2", 2, [0.0, -20.0, 5.0], None),
    ("PawHR3", 3, [0.0, -23.0, -5.0], Some([0.0, -1.0, 6.0])),
    ("Tail1", 1, [0.0, 2.0, -8.0], None),
    ("Tail2", 2, [0.0, 4.0, -14.0], Some([0.0, 6.0, -12.0])),
];

const ARM: &[Bone] = &[
    ("Plinth", 0, [0.0, 0.0, 0.0], None),
    ("Turret", 1, [0.0, 30.0, 0.0], None),
    ("Boom", 2, [0.0, 20.0, 8.0], None),
    ("Jib", 3, [0.0, 55.0, 0.0], None),
    ("Swivel", 4, [0.0, 0.0, 45.0], None),
    ("Jaw1", 5, [4.0, 0.0, 10.0], Some([0.0, 0.0, 8.0])),
    ("Jaw2", 5, [-4.0, 0.0, 10.0], Some([0.0, 0.0, 8.0])),
];

/// A dog that trots for `n_frames` at 30 frames per second, ahead at `speed_m_s` and turning by
/// `turn_deg_s` to the left; `phase` is where in the gait cycle it begins, in cycles.
pub fn dog(n_frames: usize, speed_m_s: f64, turn_deg_s: f64, phase: f64) -> String {
    let (mut x, mut z) = (0.0, 0.0);
    let mut frames = Vec::new();
    for frame in 0..n_frames {
        let secs = frame as f64 / 30.0;
        let heading = turn_deg_s * secs;
        let (sin, cos) = heading.to_radians().sin_cos();
        x += sin * speed_m_s * 100.0 / 30.0;
        z += cos * speed_m_s * 100.0 / 30.0;
        let cycle = TAU * (1.8 * secs + phase);
        let swing = 25.0 * speed_m_s.min(1.5) / 1.5;
        let pose = |name: &str| -> Turn {
            // A trot: fore and hind leg of opposite sides go together.
            let side = if name.contains("FL") || name.contains("HR") { 0.0 } else { TAU / 2.0 };
            let at = cycle + side;
            match name {
                "Rump" => [0.0, 2.0 * (2.0 * cycle).sin(), heading],
                "Poll" => [0.0, 4.0 * (2.0 * cycle).cos(), 0.0],
                "Tail1" => [0.0, 0.0, 20.0 * cycle.sin()],
                _ if name.ends_with('1') && name.starts_with("Paw") => [0.0, swing * at.sin(), 0.0],
                _ if name.ends_with('2') && name.starts_with("Paw") => {
                    [0.0, swing * (0.5 + 0.5 * at.cos()), 0.0]
                }
                _ => [0.0; 3],
            }
        };
        let bounce = 1.5 * (2.0 * cycle).sin();
        frames.push(([x, 52.0 + bounce, z], DOG.iter().map(|bone| pose(bone.0)).collect()));
    }
    bvh(DOG, &frames)
}

/// A robot arm on its plinth for `n_frames` at 30 frames per second: swings to and fro by
/// `swing_deg` and bends its boom by `reach_deg`, `hertz` times a second.
pub fn robot_arm(n_frames: usize, swing_deg: f64, reach_deg: f64, hertz: f64) -> String {
    let frame = |frame: usize| {
        let cycle = TAU * hertz * frame as f64 / 30.0;
        let pose = |name: &str| -> Turn {
            match name {
                "Turret" => [0.0, 0.0, swing_deg * cycle.sin()],
                "Boom" => [0.0, reach_deg * (0.5 - 0.5 * cycle.cos()), 0.0],
                "Jib" => [0.0, -0.6 * reach_deg * cycle.sin(), 0.0],
                "Jaw1" => [0.0, 0.0, 10.0 * cycle.sin()],
                "Jaw2" => [0.0, 0.0, -10.0 * cycle.sin()],
                _ => [0.0; 3],
            }
        };
        ([0.0; 3], ARM.iter().map(|bone| pose(bone.0)).collect())
    };
    bvh(ARM, &(0..n_frames).map(frame).collect::<Vec<_>>())
}

fn bvh(bones: &[Bone], frames: &[([f64; 3], Vec<Turn>)]) -> String {
    let mut text = String::from("HIERARCHY\n");
    for (idx, &(name, depth, [x, y, z], end)) in bones.iter().enumerate() {
        let pad = "  ".repeat(depth);
        let word = if idx == 0 { "ROOT" } else { "JOINT" };
        let places = if idx == 0 { "6 Xposition Yposition Zposition" } else { "3" };
        text.push_str(&format!("{pad}{word} {name}\n{pad}{{\n{pad}  OFFSET {x} {y} {z}\n"));
        text.push_str(&format!("{pad}  CHANNELS {places} Zrotation Xrotation Yrotation\n"));
        if let Some([x, y, z]) = end {
            text.push_str(&format!("{pad}  End Site\n{pad}  {{\n{pad}    OFFSET {x} {y} {z}\n"));
            text.push_str(&format!("{pad}  }}\n"));
        }
        let next = bones.get(idx + 1).map_or(0, |bone| bone.1);
        let is_last = idx + 1 == bones.len();
        for closing in (next..=depth).rev().filter(|closing| *closing > 0 || is_last) {
            text.push_str(&format!("{}}}\n", "  ".repeat(closing)));
        }
    }
    text.push_str(&format!("MOTION\nFrames: {}\nFrame Time: {}\n", frames.len(), 1.0 / 30.0));
    for (place, turns) in frames {
        let numbers = place.iter().chain(turns.iter().flatten());
        let words: Vec<String> = numbers.map(|number| format!("{number:.4}")).collect();
        text.push_str(&words.join(" "));
        text.push('\n');
    }
    text
}
