//! What part of the body a joint is, recognised from the shape of the tree.
//!
//! Names come first ([`RoleMap::from_names`]); this adds what they leave open:
//!
//! * Without any named leg, a person is looked for: two like chains (legs) at a joint that also
//!   carries a trunk, on which two like chains (arms) sit and, between them, a neck. Which side is
//!   left is said by names, else by where the feet point. A trunk that lies across the legs at rest
//!   is that of a dog.
//! * Hips that do not carry both thighs are no hips: the joint that carries thighs and arms is.
//! * Thighs that begin at one point are bones of the pelvis; where only one joint of the leg is
//!   named below them, that is the thigh.
//! * A hand that hangs on the trunk itself is all there is of that arm, and plays the upper arm.
//! * Without a named back, the joints between hips and arms are the back.

use glam::Vec3;

use super::{Joint, JointRole, RoleMap, names};
use crate::contacts::Side;
use crate::ids::JointIdx;

/// Two chains are like each other where their bones differ by less than this share, on average.
const LIKE_SHARE: f32 = 0.12;

/// A trunk goes away from where the legs go by more than this, radians: 105 degrees. What has its
/// trunk across its legs goes on four of them.
const UPRIGHT_RAD: f32 = 1.83;

/// Arms reach at least this share of what legs reach.
const MIN_ARM_SHARE: f32 = 0.3;

/// Adds the roles that names left open.
pub(super) fn complete(joints: &[Joint], roles: &mut RoleMap) {
    use JointRole as R;
    let tree = Tree::new(joints);
    let named = |role: R| roles.joint(role).is_some();
    if ![R::LeftUpLeg, R::LeftLeg, R::RightUpLeg, R::RightLeg].into_iter().any(named)
        && let Some(person) = tree.person()
    {
        person.name_parts(&tree, roles);
    }
    tree.mend_hips(roles);
    tree.mend_thighs(roles);
    tree.mend_arms(roles);
    tree.mend_back(roles);
}

/// Joints with what is below them.
struct Tree<'a> {
    joints: &'a [Joint],
    positions_m: Vec<Vec3>,
    children: Vec<Vec<usize>>,
    depth: Vec<usize>,
    /// Length of the longest way down, metres.
    reach_m: Vec<f32>,
}

impl<'a> Tree<'a> {
    fn new(joints: &'a [Joint]) -> Self {
        let n = joints.len();
        let (mut positions_m, mut depth) = (vec![Vec3::ZERO; n], vec![0; n]);
        let (mut children, mut reach_m) = (vec![Vec::new(); n], vec![0.0_f32; n]);
        for (idx, joint) in joints.iter().enumerate() {
            if let Some(parent) = joint.parent {
                positions_m[idx] = positions_m[parent.idx()] + joint.offset_m;
                depth[idx] = depth[parent.idx()] + 1;
                children[parent.idx()].push(idx);
            }
        }
        for (idx, joint) in joints.iter().enumerate().rev() {
            if let Some(parent) = joint.parent {
                let reach = reach_m[idx] + joint.offset_m.length();
                reach_m[parent.idx()] = reach_m[parent.idx()].max(reach);
            }
        }
        Self { joints, positions_m, children, depth, reach_m }
    }

    /// From `joint` the longest way down.
    fn chain(&self, joint: usize) -> Vec<usize> {
        let mut chain = vec![joint];
        while let Some(next) = self.farthest(&self.children[chain[chain.len() - 1]]) {
            chain.push(next);
        }
        chain
    }

    fn farthest(&self, joints: &[usize]) -> Option<usize> {
        let length = |&joint: &usize| self.reach_m[joint] + self.joints[joint].offset_m.length();
        joints.iter().copied().max_by(|a, b| length(a).total_cmp(&length(b)).then(b.cmp(a)))
    }

    /// The two longest chains below `joint` that are like each other.
    fn limbs(&self, joint: usize) -> Option<[Vec<usize>; 2]> {
        let chains: Vec<Vec<usize>> =
            self.children[joint].iter().map(|&child| self.chain(child)).collect();
        let mut best: Option<(f32, [usize; 2])> = None;
        for (a, b) in (0..chains.len()).flat_map(|a| (a + 1..chains.len()).map(move |b| (a, b))) {
            let reach = self.reach_m[chains[a][0]].min(self.reach_m[chains[b][0]]);
            let longer = best.is_none_or(|(known, _)| reach > known);
            if longer && reach > 0.0 && self.are_alike(&chains[a], &chains[b]) {
                best = Some((reach, [a, b]));
            }
        }
        best.map(|(_, pair)| pair.map(|chain| chains[chain].clone()))
    }

    /// Whether two chains have as many joints, at least two, and bones of the same lengths.
    fn are_alike(&self, a: &[usize], b: &[usize]) -> bool {
        if a.len() != b.len() || a.len() < 2 {
            return false;
        }
        let length = |&joint: &usize| self.joints[joint].offset_m.length();
        let (mut sum, mut difference) = (0.0, 0.0);
        for (a, b) in a[1..].iter().map(length).zip(b[1..].iter().map(length)) {
            sum += a + b;
            difference += (a - b).abs();
        }
        2.0 * difference < LIKE_SHARE * sum
    }

    /// Legs, trunk, arms and neck, where the tree has the shape of a person.
    fn person(&self) -> Option<Person> {
        let mut order: Vec<usize> = (0..self.joints.len()).collect();
        order.sort_by_key(|&joint| (self.depth[joint], joint));
        order.iter().find_map(|&hips| {
            let legs = self.limbs(hips)?;
            let leg_reach = self.reach_m[legs[0][0]];
            let chest = order.iter().copied().find_map(|chest| {
                let below = self.way_up(chest, hips)?;
                let first = *below.last()?;
                let on_trunk = legs.iter().all(|leg| leg[0] != first);
                let arms = if on_trunk { self.limbs(chest)? } else { return None };
                let long = self.reach_m[arms[0][0]] > MIN_ARM_SHARE * leg_reach;
                long.then_some((chest, arms))
            });
            let (chest, arms) = chest?;
            let up = self.positions_m[chest] - self.positions_m[hips];
            let down =
                |leg: &[usize]| self.positions_m[leg[leg.len() - 1]] - self.positions_m[leg[0]];
            if legs.iter().all(|leg| up.angle_between(down(leg)) < UPRIGHT_RAD) {
                return None;
            }
            let neck = self.children[chest].iter().copied();
            let neck = neck.filter(|&child| arms.iter().all(|arm| arm[0] != child));
            let height = |child: &usize| {
                let chain = self.chain(*child);
                up.dot(self.positions_m[chain[chain.len() - 1]] - self.positions_m[chest])
            };
            let neck = neck.max_by(|a, b| height(a).total_cmp(&height(b)));
            let neck = neck.map_or(Vec::new(), |neck| self.chain(neck));
            Some(Person { hips, chest, legs, arms, neck })
        })
    }

    /// The joints from `joint` up to below `above`, or `None` where that does not carry it.
    fn way_up(&self, joint: usize, above: usize) -> Option<Vec<usize>> {
        let mut way = Vec::new();
        let mut at = joint;
        while at != above {
            way.push(at);
            at = self.joints[at].parent?.idx();
        }
        Some(way)
    }

    /// The lowest joint that carries both, or is one and carries the other.
    fn common(&self, a: usize, b: usize) -> usize {
        let (mut a, mut b) = (a, b);
        while a != b {
            // The deeper one has a parent, since depths differ or both are below the root.
            let deeper = if self.depth[a] >= self.depth[b] { &mut a } else { &mut b };
            *deeper = self.joints[*deeper].parent.map_or(0, JointIdx::idx);
        }
        a
    }

    fn mend_hips(&self, roles: &mut RoleMap) {
        use JointRole as R;
        let at = |role| roles.joint(role).map(JointIdx::idx);
        let (Some(left), Some(right)) = (at(R::LeftUpLeg), at(R::RightUpLeg)) else { return };
        let carries =
            |hips: usize| [left, right].into_iter().all(|thigh| self.way_up(thigh, hips).is_some());
        if at(R::Hips).is_some_and(carries) {
            return;
        }
        let others = [R::Spine, R::LeftArm, R::RightArm, R::Head].into_iter().filter_map(at);
        let hips = others.fold(self.common(left, right), |a, b| self.common(a, b));
        if roles.role_of(JointIdx::from_idx(hips)).is_none() {
            roles.set(R::Hips, JointIdx::from_idx(hips));
        }
    }

    fn mend_thighs(&self, roles: &mut RoleMap) {
        use JointRole as R;
        let legs =
            [(R::LeftUpLeg, R::LeftLeg, R::LeftFoot), (R::RightUpLeg, R::RightLeg, R::RightFoot)];
        let named = legs.map(|(thigh, shin, foot)| {
            let shin = roles.joint(shin).filter(|_| roles.joint(foot).is_none());
            roles.joint(thigh).zip(shin)
        });
        let [Some((left, left_shin)), Some((right, right_shin))] = named else { return };
        let apart = |a: JointIdx, b: JointIdx| {
            self.positions_m[a.idx()].distance(self.positions_m[b.idx()])
        };
        if apart(left, right) < 0.05 * apart(left_shin, right_shin) {
            for ((thigh, shin, _), joint) in legs.into_iter().zip([left_shin, right_shin]) {
                roles.unset(shin);
                roles.set(thigh, joint);
            }
        }
    }

    fn mend_arms(&self, roles: &mut RoleMap) {
        use JointRole as R;
        let sides = [
            (R::LeftArm, R::LeftForeArm, R::LeftHand),
            (R::RightArm, R::RightForeArm, R::RightHand),
        ];
        let lone = sides.map(|(arm, fore_arm, hand)| {
            let alone = roles.joint(arm).is_none() && roles.joint(fore_arm).is_none();
            roles.joint(hand).filter(|_| alone)
        });
        let [Some(left), Some(right)] = lone else { return };
        if self.joints[left.idx()].parent != self.joints[right.idx()].parent {
            return;
        }
        for ((arm, _, hand), joint) in sides.into_iter().zip([left, right]) {
            roles.unset(hand);
            roles.set(arm, joint);
        }
    }

    fn mend_back(&self, roles: &mut RoleMap) {
        use JointRole as R;
        let at = |role| roles.joint(role).map(JointIdx::idx);
        if [R::Spine, R::Spine1, R::Spine2].into_iter().any(|role| at(role).is_some()) {
            return;
        }
        let (Some(hips), Some(left), Some(right)) = (at(R::Hips), at(R::LeftArm), at(R::RightArm))
        else {
            return;
        };
        let has_head = at(R::Neck).is_some() || at(R::Head).is_some();
        let chest = self.common(left, right);
        self.name_back(hips, chest, roles);
        if !has_head && chest != hips {
            let arms = [left, right];
            let free =
                |&child: &usize| arms.into_iter().all(|arm| self.way_up(arm, child).is_none());
            let up: Vec<usize> = self.children[chest].iter().copied().filter(free).collect();
            if let Some(neck) = self.farthest(&up) {
                name_neck(&self.chain(neck), roles);
            }
        }
    }

    /// Names the joints between hips and arms: the first, the middle one and the last.
    fn name_back(&self, hips: usize, chest: usize, roles: &mut RoleMap) {
        use JointRole as R;
        let Some(mut back) = self.way_up(chest, hips) else { return };
        back.reverse();
        let chosen: &[usize] = match back.len() {
            0 => &[],
            1 => &[0],
            2 => &[0, 1],
            n => &[0, n / 2, n - 1],
        };
        for (role, &link) in [R::Spine, R::Spine1, R::Spine2].into_iter().zip(chosen) {
            name(role, back[link], roles);
        }
    }
}

/// The parts of a body, as joints.
struct Person {
    hips: usize,
    chest: usize,
    legs: [Vec<usize>; 2],
    arms: [Vec<usize>; 2],
    neck: Vec<usize>,
}

impl Person {
    fn name_parts(&self, tree: &Tree<'_>, roles: &mut RoleMap) {
        use JointRole as R;
        // A root that names took for hips is above them.
        roles.set(R::Hips, JointIdx::from_idx(self.hips));
        let left = self.left(tree);
        for (side, legs) in [(Side::Left, &self.legs), (Side::Right, &self.legs)] {
            let parts = match side {
                Side::Left => [R::LeftUpLeg, R::LeftLeg, R::LeftFoot, R::LeftToeBase],
                Side::Right => [R::RightUpLeg, R::RightLeg, R::RightFoot, R::RightToeBase],
            };
            let leg = sided(tree, legs, side, left);
            for (role, &joint) in parts.into_iter().zip(&leg[upper(tree, leg)..]) {
                name(role, joint, roles);
            }
            let parts = match side {
                Side::Left => [R::LeftArm, R::LeftForeArm, R::LeftHand],
                Side::Right => [R::RightArm, R::RightForeArm, R::RightHand],
            };
            let shoulder = if side == Side::Left { R::LeftShoulder } else { R::RightShoulder };
            let arm = sided(tree, &self.arms, side, left);
            let first = upper(tree, arm);
            if first > 0 {
                name(shoulder, arm[first - 1], roles);
            }
            for (role, &joint) in parts.into_iter().zip(&arm[first..]) {
                name(role, joint, roles);
            }
        }
        tree.name_back(self.hips, self.chest, roles);
        name_neck(&self.neck, roles);
    }

    /// The direction of the body's left: its feet point ahead. Without feet it looks along +Z.
    fn left(&self, tree: &Tree<'_>) -> Vec3 {
        let up = tree.positions_m[self.chest] - tree.positions_m[self.hips];
        let up = up.try_normalize().unwrap_or(Vec3::Y);
        let toes = self.legs.iter().map(|leg| {
            let toe = upper(tree, leg) + 3;
            match (leg.get(toe - 1), leg.get(toe)) {
                (Some(&ankle), Some(&toe)) => tree.positions_m[toe] - tree.positions_m[ankle],
                _ => Vec3::ZERO,
            }
        });
        let ahead = toes.sum::<Vec3>().reject_from_normalized(up);
        up.cross(ahead.try_normalize().unwrap_or(Vec3::Z))
    }
}

/// The limb of a side: by the names of its joints, else by where it begins.
fn sided<'a>(tree: &Tree<'_>, limbs: &'a [Vec<usize>; 2], side: Side, left: Vec3) -> &'a [usize] {
    let named =
        |limb: &[usize]| limb.iter().find_map(|&joint| names::read(&tree.joints[joint].name).side);
    let first_is_left = match (named(&limbs[0]), named(&limbs[1])) {
        (Some(first), Some(second)) if first != second => first == Side::Left,
        _ => {
            // The ends of limbs are further apart than their beginnings.
            let place = |limb: &[usize]| -> Vec3 {
                limb.iter().map(|&joint| tree.positions_m[joint]).sum::<Vec3>()
            };
            left.dot(place(&limbs[0]) - place(&limbs[1])) > 0.0
        }
    };
    &limbs[usize::from(first_is_left != (side == Side::Left))]
}

/// Where in a chain the thigh or upper arm is: it begins the two longest bones on end.
fn upper(tree: &Tree<'_>, limb: &[usize]) -> usize {
    let bone = |at: usize| tree.joints[limb[at]].offset_m.length();
    let both = |at: &usize| bone(at + 1).min(bone(at + 2));
    let candidates = 0..limb.len().saturating_sub(2);
    candidates.max_by(|a, b| both(a).total_cmp(&both(b)).then(b.cmp(a))).unwrap_or(0)
}

fn name_neck(neck: &[usize], roles: &mut RoleMap) {
    match neck {
        [] => {}
        [head] => name(JointRole::Head, *head, roles),
        [neck, head, ..] => {
            name(JointRole::Neck, *neck, roles);
            name(JointRole::Head, *head, roles);
        }
    }
}

/// Gives a role that is open to a joint that has none.
fn name(role: JointRole, joint: usize, roles: &mut RoleMap) {
    let joint = JointIdx::from_idx(joint);
    if roles.joint(role).is_none() && roles.role_of(joint).is_none() {
        roles.set(role, joint);
    }
}

#[cfg(test)]
mod tests {
    use glam::Quat;

    use super::*;
    use crate::skeleton::Skeleton;
    use crate::testing::bodies::t_pose;
    use crate::testing::joint;

    /// The roles of a body's joints, in order.
    fn roles_of(skeleton: &Skeleton) -> Vec<Option<JointRole>> {
        let joints = (0..skeleton.n_joints()).map(JointIdx::from_idx);
        joints.map(|joint| skeleton.roles().role_of(joint)).collect()
    }

    /// A body with other names and its rest pose turned.
    fn renamed(skeleton: &Skeleton, turn: Quat, rename: impl Fn(usize) -> String) -> Skeleton {
        let joints = skeleton.joints().iter().enumerate().map(|(idx, joint)| Joint {
            name: rename(idx),
            offset_m: turn * joint.offset_m,
            ..joint.clone()
        });
        Skeleton::new(joints.collect()).unwrap()
    }

    #[test]
    fn a_person_without_names_is_recognised_however_it_stands() {
        let body = t_pose(1.0);
        for turn in [Quat::IDENTITY, Quat::from_rotation_x(1.57), Quat::from_rotation_y(2.0)] {
            let nameless = renamed(&body, turn, |idx| format!("n{idx}"));
            assert_eq!(roles_of(&nameless), roles_of(&body));
        }
    }

    #[test]
    fn sides_are_those_of_names() {
        let body = t_pose(1.0);
        let mirrored = renamed(&body, Quat::IDENTITY, |idx| match idx {
            1..=4 | 14..=17 => format!("limb_R_{idx}"),
            5..=8 | 18..=21 => format!("limb_L_{idx}"),
            _ => format!("n{idx}"),
        });
        assert_eq!(mirrored.by_role(JointRole::LeftUpLeg), Some(JointIdx(5)));
        assert_eq!(mirrored.by_role(JointRole::RightHand), Some(JointIdx(17)));
    }

    #[test]
    fn a_dog_is_no_person_and_a_ladder_none() {
        let tail = [joint("a", None, [0.0; 3]), joint("b", Some(0), [0.0, 1.0, 0.0])];
        assert_eq!(roles_of(&Skeleton::new(tail.to_vec()).unwrap()), [None; 2]);
        let fork = [
            joint("a", None, [0.0; 3]),
            joint("b", Some(0), [0.1, 0.0, 0.0]),
            joint("c", Some(1), [0.0, -0.4, 0.0]),
            joint("d", Some(0), [-0.1, 0.0, 0.0]),
            joint("e", Some(3), [0.0, -0.4, 0.0]),
        ];
        assert_eq!(roles_of(&Skeleton::new(fork.to_vec()).unwrap()), [None; 5]);
    }

    #[test]
    fn hips_carry_the_thighs() {
        let body = [
            joint("Body", None, [0.0; 3]),
            joint("Hips", Some(0), [0.0, 0.1, 0.0]),
            joint("Abdomen", Some(1), [0.0, 0.2, 0.0]),
            joint("UpperLeg.L", Some(0), [0.1, 0.0, 0.0]),
            joint("UpperLeg.R", Some(0), [-0.1, 0.0, 0.0]),
        ];
        let body = Skeleton::new(body.to_vec()).unwrap();
        assert_eq!(body.by_role(JointRole::Hips), Some(JointIdx(0)));
        assert_eq!(body.by_role(JointRole::Spine), Some(JointIdx(2)));
    }

    #[test]
    fn limbs_of_one_piece_are_arms_and_thighs_and_what_carries_them_is_the_back() {
        let body = [
            joint("root", None, [0.0; 3]),
            joint("body_low", Some(0), [0.0, 0.1, 0.0]),
            joint("body_up", Some(1), [0.0, 0.5, 0.0]),
            joint("hat", Some(2), [0.0, 0.5, 0.0]),
            joint("hand_L", Some(1), [0.5, 0.3, 0.0]),
            joint("hand_R", Some(1), [-0.5, 0.3, 0.0]),
            joint("hip_L", Some(0), [0.0; 3]),
            joint("hip_R", Some(0), [0.0; 3]),
            joint("leg_L", Some(6), [0.3, 0.0, 0.0]),
            joint("leg_R", Some(7), [-0.3, 0.0, 0.0]),
        ];
        let body = Skeleton::new(body.to_vec()).unwrap();
        use JointRole as R;
        let expected = [
            Some(R::Hips),
            Some(R::Spine),
            Some(R::Neck),
            Some(R::Head),
            Some(R::LeftArm),
            Some(R::RightArm),
            None,
            None,
            Some(R::LeftUpLeg),
            Some(R::RightUpLeg),
        ];
        assert_eq!(roles_of(&body), expected);
    }
}
