//! Where a human body's landmarks are, read from a plan; what the plan lacks is put where it
//! usually is.
//!
//! Shares of body height are those of Drillis and Contini (1966) as printed in Winter,
//! *Biomechanics and Motor Control of Human Movement*, fig. 4.1: thigh 0.245, shin 0.246, foot
//! 0.152 long and ankle 0.039 high, upper arm 0.186, forearm 0.146, hand 0.108, chin to crown
//! 0.130.

use glam::Vec3;

use crate::body_plan::{BodyPart, BodyPlan, Side};

use super::field::Plane;

/// An arm from the shoulder to the fingertips.
#[derive(Clone, Debug)]
pub(super) struct Arm {
    pub(super) shoulder_m: Vec3,
    pub(super) elbow_m: Vec3,
    pub(super) wrist_m: Vec3,
    /// Where the longest finger ends.
    pub(super) tip_m: Vec3,
    /// Which joints move the collar, upper arm, forearm and hand.
    pub(super) movers: [usize; 4],
}

/// A leg from the hip joint to the toes.
#[derive(Clone, Debug)]
pub(super) struct Leg {
    pub(super) hip_m: Vec3,
    pub(super) knee_m: Vec3,
    pub(super) ankle_m: Vec3,
    /// The joint of the toes.
    pub(super) ball_m: Vec3,
    /// Where the foot looks, level.
    pub(super) forward: Vec3,
    /// How long the toes are.
    pub(super) toes_m: f32,
    /// The sole.
    pub(super) sole: Plane,
    /// Which joints move the thigh, shin, foot and toes.
    pub(super) movers: [usize; 4],
}

/// The landmarks of a human body.
#[derive(Clone, Debug)]
pub(super) struct Figure {
    /// 1 for a body of 1.75 m.
    pub(super) scale: f32,
    /// Joints from the hips to the head, each with its place; at least one.
    pub(super) spine: Vec<(usize, Vec3)>,
    /// How many of them, from the end on, are the neck's and the head's.
    pub(super) n_neck: usize,
    /// The joint of the head, or what moves it.
    pub(super) head_joint: usize,
    /// Between the hip joints.
    pub(super) pelvis_m: Vec3,
    /// Between the shoulder joints.
    pub(super) chest_m: Vec3,
    /// Half the way from one hip joint to the other, and from one shoulder to the other.
    pub(super) half_hips_m: f32,
    pub(super) half_shoulders_m: f32,
    /// Where the skull sits on the neck.
    pub(super) skull_m: Vec3,
    /// The top of the head.
    pub(super) crown_m: Vec3,
    pub(super) arms: [Option<Arm>; 2],
    pub(super) legs: [Option<Leg>; 2],
}

/// The height that all tables of this module are for.
pub(super) const TABLE_HEIGHT_M: f32 = 1.75;

/// +1 on the left, −1 on the right.
pub(super) fn sign(side: Side) -> f32 {
    if side == Side::Left { 1.0 } else { -1.0 }
}

struct Reader<'a> {
    plan: &'a BodyPlan,
    positions_m: &'a [Vec3],
}

impl Reader<'_> {
    fn joint(&self, part: BodyPart) -> Option<usize> {
        self.plan.joints.iter().position(|joint| joint.part == Some(part))
    }

    fn at(&self, joint: usize) -> Vec3 {
        self.positions_m[joint]
    }

    /// The first of the parts that is there, and all joints from it to the root.
    fn path_to_root(&self, mut joint: usize) -> Vec<usize> {
        let mut path = vec![joint];
        while let Some(parent) = self.plan.joints[joint].parent.filter(|&p| p < joint) {
            path.push(parent);
            joint = parent;
        }
        path
    }

    /// The end of the bone of `joint`: its end site, or its child farthest away.
    fn end(&self, joint: usize) -> Option<Vec3> {
        let from = self.at(joint);
        let children = (joint + 1..self.plan.joints.len())
            .filter(|&child| self.plan.joints[child].parent == Some(joint))
            .map(|child| self.at(child));
        self.plan.joints[joint]
            .end_m
            .filter(|end| end.is_finite())
            .into_iter()
            .chain(children)
            .filter(|to| to.distance(from) > 1e-6)
            .max_by(|a, b| a.distance(from).total_cmp(&b.distance(from)))
    }

    /// The end of the longest chain below `joint`, such as a fingertip.
    fn tip(&self, joint: usize) -> Option<Vec3> {
        let from = self.at(joint);
        (joint..self.plan.joints.len())
            .filter(|&below| self.path_to_root(below).contains(&joint))
            .filter_map(|below| self.end(below))
            .max_by(|a, b| a.distance(from).total_cmp(&b.distance(from)))
    }
}

impl Figure {
    /// The landmarks of `plan`, whose joints are at `positions_m` (finite). `None` where too few
    /// parts are known to call it a human body: it takes hips or a back, and legs or arms.
    pub(super) fn read(plan: &BodyPlan, positions_m: &[Vec3]) -> Option<Self> {
        let reader = Reader { plan, positions_m };
        let leg = |side| reader.joint(BodyPart::Thigh(side)).or(reader.joint(BodyPart::Shin(side)));
        let arm =
            |side| reader.joint(BodyPart::UpperArm(side)).or(reader.joint(BodyPart::Forearm(side)));
        let has_limbs =
            Side::BOTH.into_iter().any(|side| leg(side).is_some() || arm(side).is_some());
        let trunk = reader.joint(BodyPart::Hips).or(reader.joint(BodyPart::Spine))?;
        if !has_limbs {
            return None;
        }
        let scale = scale(&reader);
        let head_joint = reader.joint(BodyPart::Head);
        let top = head_joint
            .or(reader.joint(BodyPart::Neck))
            .or_else(|| plan.joints.iter().rposition(|j| j.part == Some(BodyPart::Spine)))
            .unwrap_or(trunk);
        let mut spine: Vec<usize> = reader.path_to_root(top);
        spine.reverse();
        let begin = spine.iter().position(|&joint| joint == trunk).unwrap_or(0);
        let spine: Vec<(usize, Vec3)> =
            spine[begin..].iter().map(|&joint| (joint, reader.at(joint))).collect();
        let neck_at = spine.iter().position(|&(joint, _)| {
            matches!(plan.joints[joint].part, Some(BodyPart::Neck | BodyPart::Head))
        });
        let n_neck = neck_at.map_or(0, |at| spine.len() - at);

        let side_of = |find: &dyn Fn(Side) -> Option<usize>| -> [Option<Vec3>; 2] {
            Side::BOTH.map(|side| find(side).map(|joint| reader.at(joint)))
        };
        let root_m = spine[0].1;
        let (pelvis_m, half_hips_m) = middle(
            side_of(&|side| reader.joint(BodyPart::Thigh(side))),
            root_m - Vec3::Y * 0.065 * scale,
            0.092 * scale,
        );
        let neck_m = neck_at.map(|at| spine[at].1);
        let usual_chest_m = neck_m.map_or_else(
            || {
                let (_, last) = spine[spine.len() - 1];
                let above = last.y.max(pelvis_m.y + 0.3 * scale) + 0.1 * scale;
                Vec3::new(pelvis_m.x, above.max(pelvis_m.y + 0.5 * scale), last.z)
            },
            |neck| neck - Vec3::Y * 0.03 * scale,
        );
        let (chest_m, half_shoulders_m) = middle(
            side_of(&|side| reader.joint(BodyPart::UpperArm(side))),
            usual_chest_m,
            0.18 * scale,
        );
        let skull_m = head_joint.map_or_else(
            || neck_m.unwrap_or(chest_m + Vec3::Y * 0.03 * scale) + Vec3::Y * 0.1 * scale,
            |joint| reader.at(joint),
        );
        // What a file calls the head's end may be its middle, as CMU's is, and a head's joint may
        // be anywhere from its base to the ears: then shoulders tell better how high the crown is.
        let usual_m = chest_m.y + 0.32 * scale - skull_m.y;
        let usual_m = usual_m.clamp(0.13 * scale, 0.21 * scale);
        let end_m = head_joint.and_then(|joint| reader.end(joint)).map(|end| end.y - skull_m.y);
        let is_crown = |m: &f32| (0.17 * scale..0.22 * scale).contains(m);
        let head_m = end_m.filter(is_crown).unwrap_or(usual_m);
        let crown_m = skull_m + Vec3::Y * head_m;

        Some(Self {
            scale,
            head_joint: spine[spine.len() - 1].0,
            n_neck,
            pelvis_m,
            chest_m,
            half_hips_m: half_hips_m.clamp(0.05 * scale, 0.16 * scale),
            half_shoulders_m: half_shoulders_m.clamp(0.10 * scale, 0.28 * scale),
            skull_m,
            crown_m,
            arms: Side::BOTH.map(|side| read_arm(&reader, side, scale, spine[0].0)),
            legs: Side::BOTH.map(|side| read_leg(&reader, side, scale)),
            spine,
        })
    }
}

/// Between two points and half the way between them; beside a lone one, or where they usually are.
fn middle([left, right]: [Option<Vec3>; 2], usual_m: Vec3, usual_half_m: f32) -> (Vec3, f32) {
    match (left, right) {
        (Some(l), Some(r)) => (0.5 * (l + r), 0.5 * (l.x - r.x).abs()),
        (Some(one), None) | (None, Some(one)) => {
            let half_m = (one.x - usual_m.x).abs();
            (Vec3::new(usual_m.x, one.y, one.z), half_m)
        }
        (None, None) => (usual_m, usual_half_m),
    }
}

/// How large the body is beside one of [`TABLE_HEIGHT_M`], from the lengths of its bones.
fn scale(reader: &Reader<'_>) -> f32 {
    use BodyPart::{Foot, Forearm, Hand, Shin, Thigh, UpperArm};
    let mut heights_m: Vec<(f32, f32)> = Vec::new(); // (height, weight)
    let mut bone = |from: Option<usize>, to: Option<usize>, share: f32, weight: f32| {
        if let (Some(from), Some(to)) = (from, to) {
            let length_m = reader.at(from).distance(reader.at(to));
            if length_m > 1e-5 {
                heights_m.push((length_m / share, weight));
            }
        }
    };
    for side in Side::BOTH {
        let joint = |part: BodyPart| reader.joint(part);
        bone(joint(Thigh(side)), joint(Shin(side)), 0.245, 1.0);
        bone(joint(Shin(side)), joint(Foot(side)), 0.246, 1.0);
        // From the joint's middle an arm is shorter than from the acromion.
        bone(joint(UpperArm(side)), joint(Forearm(side)), 0.165, 0.5);
        bone(joint(Forearm(side)), joint(Hand(side)), 0.146, 0.5);
        bone(joint(Thigh(side)), joint(UpperArm(side)), 0.29, 1.0);
    }
    heights_m.sort_by(|a, b| a.0.total_cmp(&b.0));
    let total: f32 = heights_m.iter().map(|h| h.1).sum();
    if total > 0.0 {
        // The middle half: one odd bone does not make a giant.
        let (mut sum, mut weights, mut before) = (0.0, 0.0, 0.0);
        for &(height_m, weight) in &heights_m {
            let from = f32::max(before, 0.25 * total);
            let to = f32::min(before + weight, 0.75 * total);
            if to > from {
                sum += height_m * (to - from);
                weights += to - from;
            }
            before += weight;
        }
        return (sum / weights / TABLE_HEIGHT_M).max(1e-4);
    }
    let low = reader.positions_m.iter().copied().reduce(Vec3::min).unwrap_or(Vec3::ZERO);
    let high = reader.positions_m.iter().copied().reduce(Vec3::max).unwrap_or(Vec3::ZERO);
    let size_m = low.distance(high);
    if size_m > 1e-4 { size_m / TABLE_HEIGHT_M } else { 1.0 }
}

fn read_arm(reader: &Reader<'_>, side: Side, scale: f32, root: usize) -> Option<Arm> {
    let upper = reader.joint(BodyPart::UpperArm(side));
    let fore = reader.joint(BodyPart::Forearm(side));
    let hand = reader.joint(BodyPart::Hand(side));
    let first = upper.or(fore)?;
    let outward = Vec3::X * sign(side);
    let shoulder_m = reader.at(first);
    let direction = |from: Vec3, to: Option<Vec3>, usual: Vec3| {
        to.and_then(|to| (to - from).try_normalize()).unwrap_or(usual)
    };
    let elbow_m = match (upper, fore) {
        (Some(upper), Some(fore)) if reader.at(fore).distance(reader.at(upper)) > 1e-3 * scale => {
            reader.at(fore)
        }
        _ => {
            let along = direction(shoulder_m, reader.end(first), outward);
            shoulder_m + along * 0.285 * scale
        }
    };
    let upper_direction = direction(shoulder_m, Some(elbow_m), outward);
    let wrist_m = match hand {
        Some(hand) if reader.at(hand).distance(elbow_m) > 1e-3 * scale => reader.at(hand),
        _ => {
            let end = fore.and_then(|fore| reader.end(fore));
            elbow_m + direction(elbow_m, end, upper_direction) * 0.25 * scale
        }
    };
    let fore_direction = direction(elbow_m, Some(wrist_m), upper_direction);
    let hand_end = hand.and_then(|hand| reader.tip(hand));
    let along = direction(wrist_m, hand_end, fore_direction);
    // A hand that a file bends back is no bind pose.
    let along = if along.dot(fore_direction) < 0.5 { fore_direction } else { along };
    let tip_m = wrist_m + along * hand_length_m(hand_end.map(|end| end.distance(wrist_m)), scale);
    let upper_mover = upper.unwrap_or(first);
    let fore_mover = fore.unwrap_or(upper_mover);
    let collar = reader.joint(BodyPart::Collar(side)).filter(|&collar| collar < upper_mover);
    let carrier = reader.plan.joints[first].parent.unwrap_or(root);
    let movers = [collar.unwrap_or(carrier), upper_mover, fore_mover, hand.unwrap_or(fore_mover)];
    Some(Arm { shoulder_m, elbow_m, wrist_m, tip_m, movers })
}

fn hand_length_m(measured_m: Option<f32>, scale: f32) -> f32 {
    let usual_m = 0.183 * scale;
    measured_m.filter(|m| (0.15 * scale..0.21 * scale).contains(m)).unwrap_or(usual_m)
}

fn read_leg(reader: &Reader<'_>, side: Side, scale: f32) -> Option<Leg> {
    let thigh = reader.joint(BodyPart::Thigh(side));
    let shin = reader.joint(BodyPart::Shin(side));
    let foot = reader.joint(BodyPart::Foot(side));
    let toes = reader.joint(BodyPart::Toes(side));
    let first = thigh.or(shin)?;
    let hip_m = reader.at(first);
    let is_apart = |a: Vec3, b: Vec3| a.distance(b) > 1e-3 * scale;
    let direction = |from: Vec3, to: Option<Vec3>, usual: Vec3| {
        to.and_then(|to| (to - from).try_normalize()).unwrap_or(usual)
    };
    let knee_m = match (thigh, shin) {
        (Some(thigh), Some(shin)) if is_apart(reader.at(thigh), reader.at(shin)) => reader.at(shin),
        _ => hip_m + direction(hip_m, reader.end(first), -Vec3::Y) * 0.42 * scale,
    };
    let thigh_direction = direction(hip_m, Some(knee_m), -Vec3::Y);
    let ankle_m = match foot {
        Some(foot) if is_apart(reader.at(foot), knee_m) => reader.at(foot),
        _ => {
            let end = shin.and_then(|shin| reader.end(shin));
            knee_m + direction(knee_m, end, thigh_direction) * 0.425 * scale
        }
    };
    let foot_mover = foot.or(shin).unwrap_or(first);
    let ball = toes.map(|toes| reader.at(toes)).filter(|&ball| is_apart(ball, ankle_m));
    let level = |v: Vec3| Vec3::new(v.x, 0.0, v.z);
    let end = foot.and_then(|foot| reader.end(foot));
    let forward = ball
        .or(end)
        .map(|to| level(to - ankle_m))
        .filter(|v| v.length() > 0.02 * scale)
        .and_then(Vec3::try_normalize)
        .unwrap_or(Vec3::Z);
    let given_m = reader.plan.sole_m[side.idx()];
    let given_m =
        if given_m.is_finite() { given_m.clamp(0.0, 0.25 * scale) } else { 0.025 * scale };
    let toe_end = toes.and_then(|toes| reader.end(toes));
    let normal = sole_normal(hip_m, knee_m, ankle_m, ball, toe_end, forward);
    let below = ball.unwrap_or(ankle_m);
    let sole = Plane { point_m: below - normal * given_m, normal };
    let ball_m = ball.unwrap_or_else(|| {
        let ball = ankle_m + forward * 0.125 * scale;
        ball - normal * (sole.above_m(ball) - 0.025 * scale)
    });
    let usual_m = 0.070 * scale;
    let toes_m = toe_end
        .map(|end| level(end - ball_m).length())
        .filter(|m| (0.045 * scale..0.09 * scale).contains(m))
        .unwrap_or(usual_m);
    let movers = [first, shin.unwrap_or(first), foot_mover, toes.unwrap_or(foot_mover)];
    Some(Leg { hip_m, knee_m, ankle_m, ball_m, forward, toes_m, sole, movers })
}

/// A leg that leans outwards by more than this is no leg of a standing person (cosine: 12°).
const PLUMB_COS: f32 = 0.978;

/// Which way a foot's sole looks up in the bind pose.
///
/// Straight up, but for skeletons whose zero pose straddles with straight ankles, as CMU's do:
/// there the foot leans with the leg, and is flat when the leg is plumb (in CMU's walks, planted
/// feet are turned by 24° from the zero pose, in which shins lean by 20°). Such a foot is known by
/// a thigh and a shin that lean alike, and a ball of the foot that lies below the ankle along the
/// shin where the toes tell their direction.
fn sole_normal(
    hip_m: Vec3,
    knee_m: Vec3,
    ankle_m: Vec3,
    ball: Option<Vec3>,
    toe_end: Option<Vec3>,
    forward: Vec3,
) -> Vec3 {
    let across = |from: Vec3, to: Vec3, axis: Vec3| {
        (to - from).reject_from_normalized(axis).try_normalize().unwrap_or(-Vec3::Y)
    };
    let (thigh, shin) = (across(hip_m, knee_m, forward), across(knee_m, ankle_m, forward));
    let is_straddled = -shin.y < PLUMB_COS && -shin.y > 0.6 && thigh.dot(shin) > PLUMB_COS;
    let foot_leans = match (ball, toe_end) {
        (Some(ball), Some(end)) => {
            let toes = Vec3::new(end.x - ball.x, 0.0, end.z - ball.z);
            toes.try_normalize()
                .is_none_or(|toes| across(ankle_m, ball, toes).dot(shin) > PLUMB_COS)
        }
        _ => true,
    };
    if is_straddled && foot_leans { -shin } else { Vec3::Y }
}
