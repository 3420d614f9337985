//! A small body that walks, as the text of a BVH file: input for tests of the program.
//!
//! It is no good motion (its feet slide), but it has a gait cycle, a heading and a speed, so that
//! walks of it are alike where they should be.

/// One walk.
#[derive(Clone, Copy, Debug)]
pub struct Walk {
    /// How many frames.
    pub n_frames: usize,
    /// Frames per second.
    pub fps: f64,
    /// Metres per second, ahead.
    pub speed_m_s: f64,
    /// Degrees per second, to the left.
    pub turn_deg_s: f64,
    /// Where in the gait cycle it begins, in cycles.
    pub phase: f64,
    /// Size of the body; 1 is 1.7 m.
    pub size: f64,
}

impl Default for Walk {
    fn default() -> Self {
        Self { n_frames: 60, fps: 30.0, speed_m_s: 1.2, turn_deg_s: 0.0, phase: 0.0, size: 1.0 }
    }
}

/// Name, depth in the tree, offset in centimetres; an end site follows a joint whose next is not
/// deeper.
const JOINTS: &[(&str, usize, [f64; 3])] = &[
    ("Hips", 0, [0.0, 0.0, 0.0]),
    ("Spine", 1, [0.0, 12.0, 0.0]),
    ("Spine1", 2, [0.0, 15.0, 0.0]),
    ("Neck", 3, [0.0, 20.0, 0.0]),
    ("Head", 4, [0.0, 10.0, 0.0]),
    ("LeftArm", 3, [18.0, 16.0, 0.0]),
    ("LeftForeArm", 4, [28.0, 0.0, 0.0]),
    ("LeftHand", 5, [24.0, 0.0, 0.0]),
    ("RightArm", 3, [-18.0, 16.0, 0.0]),
    ("RightForeArm", 4, [-28.0, 0.0, 0.0]),
    ("RightHand", 5, [-24.0, 0.0, 0.0]),
    ("LeftUpLeg", 1, [9.0, -4.0, 0.0]),
    ("LeftLeg", 2, [0.0, -42.0, 0.0]),
    ("LeftFoot", 3, [0.0, -41.0, 0.0]),
    ("LeftToeBase", 4, [0.0, -6.0, 13.0]),
    ("RightUpLeg", 1, [-9.0, -4.0, 0.0]),
    ("RightLeg", 2, [0.0, -42.0, 0.0]),
    ("RightFoot", 3, [0.0, -41.0, 0.0]),
    ("RightToeBase", 4, [0.0, -6.0, 13.0]),
];

impl Walk {
    /// The BVH file, in centimetres.
    pub fn bvh(&self) -> String {
        let mut text = String::from("HIERARCHY\n");
        for (idx, &(name, depth, offset)) in JOINTS.iter().enumerate() {
            let pad = "  ".repeat(depth);
            let [x, y, z] = offset.map(|v| v * self.size);
            let word = if idx == 0 { "ROOT" } else { "JOINT" };
            let channels = if idx == 0 {
                "6 Xposition Yposition Zposition Zrotation Xrotation Yrotation"
            } else {
                "3 Zrotation Xrotation Yrotation"
            };
            text.push_str(&format!("{pad}{word} {name}\n{pad}{{\n"));
            text.push_str(&format!("{pad}  OFFSET {x} {y} {z}\n{pad}  CHANNELS {channels}\n"));
            let next = JOINTS.get(idx + 1).map_or(0, |&(_, depth, _)| depth);
            if next <= depth {
                text.push_str(&format!("{pad}  End Site\n{pad}  {{\n"));
                text.push_str(&format!("{pad}    OFFSET 0 {} 0\n{pad}  }}\n", 5.0 * self.size));
                for closing in (next..=depth).rev() {
                    // The root is closed once, at the very end.
                    if closing > 0 || idx + 1 == JOINTS.len() {
                        text.push_str(&format!("{}}}\n", "  ".repeat(closing)));
                    }
                }
            }
        }
        let header = format!("MOTION\nFrames: {}\nFrame Time: {}\n", self.n_frames, 1.0 / self.fps);
        text.push_str(&header);
        let (mut x, mut z, mut heading_deg) = (0.0_f64, 0.0_f64, 0.0_f64);
        for frame in 0..self.n_frames {
            let numbers = self.frame(frame, x, z, heading_deg);
            let line: Vec<String> = numbers.iter().map(|v| format!("{v:.5}")).collect();
            text.push_str(&line.join(" "));
            text.push('\n');
            // A body speeds up and slows down with every step, and sways.
            let pulse = (2.0 * std::f64::consts::TAU * self.cycle(frame)).sin();
            let step_cm = 100.0 * self.speed_m_s / self.fps * (1.0 + 0.1 * pulse);
            x += step_cm * heading_deg.to_radians().sin();
            z += step_cm * heading_deg.to_radians().cos();
            heading_deg += self.turn_deg_s / self.fps;
        }
        text
    }

    /// Where a frame is in the gait, in cycles: two steps of 0.7 m each at every speed.
    fn cycle(&self, frame: usize) -> f64 {
        self.phase + frame as f64 / self.fps * self.speed_m_s / (1.4 * self.size)
    }

    /// The channels of one frame.
    fn frame(&self, frame: usize, x: f64, z: f64, heading_deg: f64) -> Vec<f64> {
        let cycle = self.cycle(frame);
        let swing = 25.0 * (self.speed_m_s / 1.2).min(1.5);
        let angle = |shift: f64| (std::f64::consts::TAU * (cycle + shift)).sin();
        let bob = 1.5 * angle(0.1);
        let sway_deg = 3.0 * angle(0.2);
        let heading_deg = heading_deg + sway_deg;
        let mut numbers = vec![x, (93.5 + bob) * self.size, z, 0.0, 0.0, heading_deg];
        for &(name, _, _) in &JOINTS[1..] {
            let (shift, part) = match name.strip_prefix("Left") {
                Some(part) => (0.0, part),
                None => (0.5, name.strip_prefix("Right").unwrap_or(name)),
            };
            let (roll, pitch) = match part {
                "UpLeg" => (0.0, -swing * angle(shift)),
                "Leg" => (0.0, swing * (1.0 - angle(shift + 0.3)) * 0.9),
                "Foot" => (0.0, -0.5 * swing * (1.0 - angle(shift + 0.3))),
                "Arm" => (if shift == 0.0 { -75.0 } else { 75.0 }, 0.0),
                "ForeArm" => (0.0, 5.0 + swing * 0.5 * angle(shift)),
                // The head and the hands make up for the sway.
                _ => (0.5 * sway_deg, 0.3 * sway_deg),
            };
            numbers.extend([roll, pitch, 0.0]);
        }
        numbers
    }
}

/// A small library: five walks that differ in speed, turn and phase.
pub fn small_library() -> Vec<(&'static str, Walk)> {
    let walk = Walk::default();
    vec![
        ("walk", Walk { n_frames: 90, ..walk }),
        ("walk_late", Walk { phase: 0.4, ..walk }),
        ("left", Walk { turn_deg_s: 40.0, n_frames: 75, ..walk }),
        ("right", Walk { turn_deg_s: -40.0, n_frames: 75, ..walk }),
        ("slow", Walk { speed_m_s: 0.8, phase: 0.2, ..walk }),
    ]
}
