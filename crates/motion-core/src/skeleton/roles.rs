//! What part of the body a joint is, recognised from its name.
//!
//! Names are read by [`names::read`]: a side, if there is one, and a word for
//! the part. Each role lists its words, best first; of equally good joints the one nearest to
//! the root plays the role. Three habits of naming need more than a list:
//!
//! * A `shoulder` is the collar bone, but the upper arm where there is a collar bone besides.
//! * A `foot` is the ankle, but the ball of the foot where there is an ankle besides.
//! * `Spine` and `Spine1` mean those roles; other names for parts of the back (`spine_01`,
//!   `chest`, `LowerBack`) are taken in their order from the root.

use super::names::{self, Part};
use crate::contacts::Side;
use crate::ids::JointIdx;

macro_rules! roles {
    ($($name:ident),* $(,)?) => {
        /// A part of the human body. The names are Mixamo's, which most tools know.
        #[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
        pub enum JointRole {
            $(#[doc = concat!("The joint usually called `", stringify!($name), "`.")] $name,)*
        }

        impl JointRole {
            /// Every role, body first, then limbs.
            pub const ALL: &[Self] = &[$(Self::$name),*];

            /// The role's name as files and people write it.
            pub fn name(self) -> &'static str {
                match self { $(Self::$name => stringify!($name)),* }
            }
        }
    };
}

roles! {
    Hips, Spine, Spine1, Spine2, Neck, Head,
    LeftShoulder, LeftArm, LeftForeArm, LeftHand,
    RightShoulder, RightArm, RightForeArm, RightHand,
    LeftUpLeg, LeftLeg, LeftFoot, LeftToeBase,
    RightUpLeg, RightLeg, RightFoot, RightToeBase,
}

impl JointRole {
    /// The role of that name (exact).
    pub fn from_name(name: &str) -> Option<Self> {
        Self::ALL.iter().copied().find(|role| role.name() == name)
    }

    /// The same part on the other side; a part of the middle is its own opposite.
    pub fn opposite(self) -> Self {
        let name = self.name();
        let other = match (name.strip_prefix("Left"), name.strip_prefix("Right")) {
            (Some(part), _) => format!("Right{part}"),
            (_, Some(part)) => format!("Left{part}"),
            _ => return self,
        };
        Self::from_name(&other).unwrap_or(self)
    }
}

/// Which joint of a skeleton plays which role.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct RoleMap {
    joints: [Option<JointIdx>; JointRole::ALL.len()],
}

impl RoleMap {
    /// Roles recognised from joint names, given in the skeleton's order (parents first).
    ///
    /// Known conventions: Mixamo, CMU (BVH and ASF), `LaFAN1`, `HumanIK`, Unreal, VRM and Unity,
    /// 3ds Max Biped, Blender, Poser and DAZ, SMPL, Xsens. Names that fit none play no role.
    pub fn from_names<'a>(names: impl IntoIterator<Item = &'a str>) -> Self {
        let parts: Vec<Part> = names.into_iter().map(names::read).collect();
        let mut roles = Self::default();
        roles.take(&parts, JointRole::Hips, None, HIPS);
        roles.take(&parts, JointRole::Neck, None, NECK);
        roles.take(&parts, JointRole::Head, None, HEAD);
        roles.take_spine(&parts);
        for side in Side::BOTH {
            roles.take_limbs(&parts, side);
        }
        roles
    }

    /// The joint with that role.
    pub fn joint(&self, role: JointRole) -> Option<JointIdx> {
        self.joints[role as usize]
    }

    /// Gives `joint` the role.
    pub fn set(&mut self, role: JointRole, joint: JointIdx) {
        self.joints[role as usize] = Some(joint);
    }

    /// Takes the role from whichever joint has it.
    pub(super) fn unset(&mut self, role: JointRole) {
        self.joints[role as usize] = None;
    }

    /// The role of `joint`, if it has one.
    pub fn role_of(&self, joint: JointIdx) -> Option<JointRole> {
        JointRole::ALL.iter().copied().find(|&role| self.joint(role) == Some(joint))
    }

    /// Gives `role` to the first joint without a role that is on `side` and called by the best of
    /// `words`; whether there was one.
    fn take(
        &mut self,
        parts: &[Part],
        role: JointRole,
        side: Option<Side>,
        words: &[&str],
    ) -> bool {
        for word in words {
            let found = (0..parts.len()).map(JointIdx::from_idx).find(|&joint| {
                let part = &parts[joint.idx()];
                part.side == side && part.word == *word && self.role_of(joint).is_none()
            });
            if let Some(joint) = found {
                self.set(role, joint);
                return true;
            }
        }
        false
    }

    fn take_spine(&mut self, parts: &[Part]) {
        use JointRole::{Spine, Spine1, Spine2};
        let has = |word: &str| parts.iter().any(|part| part.side.is_none() && part.word == word);
        if has("spine") && has("spine1") {
            self.take(parts, Spine, None, &["spine"]);
            self.take(parts, Spine1, None, &["spine1"]);
            self.take(parts, Spine2, None, &["spine2"]);
            return;
        }
        let back: Vec<JointIdx> = (0..parts.len())
            .filter(|&idx| parts[idx].side.is_none() && BACK.contains(&parts[idx].word.as_str()))
            .map(JointIdx::from_idx)
            .collect();
        let chosen: &[usize] = match back.len() {
            0 => &[],
            1 => &[0],
            2 => &[0, 1],
            n => &[0, n / 2, n - 1],
        };
        for (&role, &link) in [Spine, Spine1, Spine2].iter().zip(chosen) {
            self.set(role, back[link]);
        }
    }

    fn take_limbs(&mut self, parts: &[Part], side: Side) {
        use JointRole as R;
        let on = |left, right| if side == Side::Left { left } else { right };
        let has = |words: &[&str]| {
            parts.iter().any(|p| p.side == Some(side) && words.contains(&p.word.as_str()))
        };
        let side_of = Some(side);

        let (shoulder, arm) = (on(R::LeftShoulder, R::RightShoulder), on(R::LeftArm, R::RightArm));
        if has(COLLAR) {
            self.take(parts, shoulder, side_of, COLLAR);
            self.take(parts, arm, side_of, ARM);
            if self.joint(arm).is_none() {
                self.take(parts, arm, side_of, SHOULDER);
            }
        } else if has(ARM) {
            self.take(parts, shoulder, side_of, SHOULDER);
            self.take(parts, arm, side_of, ARM);
        } else {
            self.take(parts, arm, side_of, SHOULDER);
        }
        self.take(parts, on(R::LeftForeArm, R::RightForeArm), side_of, FORE_ARM);
        self.take(parts, on(R::LeftHand, R::RightHand), side_of, HAND);

        let up_leg = on(R::LeftUpLeg, R::RightUpLeg);
        // A plain `leg` is the shin below a thigh, and the thigh above a shin.
        let has_thigh = self.take(parts, up_leg, side_of, UP_LEG);
        if has_thigh || has(LEG) {
            self.take(parts, on(R::LeftLeg, R::RightLeg), side_of, LEG);
        }
        let leg = if has_thigh { on(R::LeftLeg, R::RightLeg) } else { up_leg };
        if self.joint(leg).is_none() {
            self.take(parts, leg, side_of, &["leg"]);
        }
        self.take(parts, on(R::LeftFoot, R::RightFoot), side_of, FOOT);
        self.take(parts, on(R::LeftToeBase, R::RightToeBase), side_of, TOE);
    }
}

const HIPS: &[&str] = &["hips", "pelvis", "hip", "lowertorso", "root", "reference"];
const NECK: &[&str] = &["neck", "lowerneck", "necklower", "neck1", "upperneck"];
const HEAD: &[&str] = &["head"];
const BACK: &[&str] = &[
    "spine",
    "spine1",
    "spine2",
    "spine3",
    "spine4",
    "spine5",
    "lowerback",
    "upperback",
    "thorax",
    "chest",
    "upperchest",
    "chestlower",
    "chestupper",
    "abdomen",
    "abdomenlower",
    "abdomenupper",
    "abdomen2",
    "torso",
    "uppertorso",
    "waist",
    "back",
    "lumbar",
    "l5",
    "l3",
    "t12",
    "t8",
];
const COLLAR: &[&str] = &["collar", "clavicle", "collarbone", "clav"];
const SHOULDER: &[&str] = &["shoulder", "shldr"];
const ARM: &[&str] = &["arm", "upperarm", "uparm", "humerus"];
const FORE_ARM: &[&str] = &["forearm", "lowerarm", "lowarm", "elbow", "radius"];
const HAND: &[&str] = &["wrist", "hand"];
const UP_LEG: &[&str] = &["upleg", "upperleg", "thigh", "femur", "hip"];
const LEG: &[&str] = &["lowerleg", "lowleg", "calf", "shin", "knee", "tibia"];
const FOOT: &[&str] = &["ankle", "foot"];
const TOE: &[&str] = &["toebase", "toe", "toes", "ball", "toe0", "foot"];

#[cfg(test)]
mod tests {
    use super::*;

    /// Checks that the names play the roles written beside them and every other joint none.
    #[track_caller]
    fn check(names_and_roles: &str) {
        let lines: Vec<(&str, &str)> = names_and_roles
            .split(',')
            .map(|pair| pair.trim().split_once('=').unwrap_or((pair.trim(), "")))
            .collect();
        let roles = RoleMap::from_names(lines.iter().map(|(name, _)| *name));
        for (idx, (name, expected)) in lines.iter().enumerate() {
            let role = roles.role_of(JointIdx::from_idx(idx)).map_or("", JointRole::name);
            assert_eq!(&role, expected, "role of {name:?}");
        }
    }

    #[test]
    fn mixamo() {
        check(
            "mixamorig:Hips=Hips, mixamorig:Spine=Spine, mixamorig:Spine1=Spine1, \
             mixamorig:Spine2=Spine2, mixamorig:Neck=Neck, mixamorig:Head=Head, \
             mixamorig:HeadTop_End, mixamorig:LeftShoulder=LeftShoulder, \
             mixamorig:LeftArm=LeftArm, mixamorig:LeftForeArm=LeftForeArm, \
             mixamorig:LeftHand=LeftHand, mixamorig:LeftHandThumb1, mixamorig:LeftHandIndex1, \
             mixamorig:RightUpLeg=RightUpLeg, mixamorig:RightLeg=RightLeg, \
             mixamorig:RightFoot=RightFoot, mixamorig:RightToeBase=RightToeBase, \
             mixamorig:RightToe_End",
        );
        check("mixamorig_Hips=Hips, mixamorigLeftUpLeg=LeftUpLeg, mixamorig9:LeftLeg=LeftLeg");
    }

    #[test]
    fn cmu_bvh() {
        check(
            "Hips=Hips, LHipJoint, LeftUpLeg=LeftUpLeg, LeftLeg=LeftLeg, LeftFoot=LeftFoot, \
             LeftToeBase=LeftToeBase, RHipJoint, RightUpLeg=RightUpLeg, LowerBack, Spine=Spine, \
             Spine1=Spine1, Neck=Neck, Neck1, Head=Head, LeftShoulder=LeftShoulder, \
             LeftArm=LeftArm, LeftForeArm=LeftForeArm, LeftHand=LeftHand, LeftFingerBase, \
             LeftHandIndex1, LThumb",
        );
    }

    #[test]
    fn cmu_asf() {
        check(
            "root=Hips, lhipjoint, lfemur=LeftUpLeg, ltibia=LeftLeg, lfoot=LeftFoot, \
             ltoes=LeftToeBase, rhipjoint, rfemur=RightUpLeg, rtibia=RightLeg, rfoot=RightFoot, \
             rtoes=RightToeBase, lowerback=Spine, upperback=Spine1, thorax=Spine2, \
             lowerneck=Neck, upperneck, head=Head, lclavicle=LeftShoulder, lhumerus=LeftArm, \
             lradius=LeftForeArm, lwrist=LeftHand, lhand, lfingers, lthumb",
        );
    }

    #[test]
    fn lafan1() {
        check(
            "Hips=Hips, LeftUpLeg=LeftUpLeg, LeftLeg=LeftLeg, LeftFoot=LeftFoot, \
             LeftToe=LeftToeBase, Spine=Spine, Spine1=Spine1, Spine2=Spine2, Neck=Neck, \
             Head=Head, RightShoulder=RightShoulder, RightArm=RightArm, \
             RightForeArm=RightForeArm, RightHand=RightHand",
        );
    }

    #[test]
    fn human_ik() {
        check(
            "Reference, Character1_Hips=Hips, Character1_LeftUpLeg=LeftUpLeg, \
             Character1_LeftLeg=LeftLeg, Character1_LeftFoot=LeftFoot, \
             Character1_LeftToeBase=LeftToeBase, Character1_Spine=Spine, \
             Character1_LeftShoulder=LeftShoulder, Character1_LeftArm=LeftArm",
        );
    }

    #[test]
    fn unreal() {
        check(
            "root, pelvis=Hips, spine_01=Spine, spine_02=Spine1, spine_03=Spine2, neck_01=Neck, \
             head=Head, clavicle_l=LeftShoulder, upperarm_l=LeftArm, upperarm_twist_01_l, \
             lowerarm_l=LeftForeArm, lowerarm_twist_01_l, hand_l=LeftHand, index_01_l, \
             thigh_l=LeftUpLeg, thigh_twist_01_l, calf_l=LeftLeg, calf_twist_01_l, \
             foot_l=LeftFoot, ball_l=LeftToeBase, thigh_r=RightUpLeg, ik_foot_root, ik_foot_l, \
             ik_hand_r",
        );
    }

    #[test]
    fn vrm_and_unity() {
        check(
            "Root, J_Bip_C_Hips=Hips, J_Bip_C_Spine=Spine, J_Bip_C_Chest=Spine1, \
             J_Bip_C_UpperChest=Spine2, J_Bip_C_Neck=Neck, J_Bip_C_Head=Head, J_Adj_L_FaceEye, \
             J_Bip_L_Shoulder=LeftShoulder, J_Bip_L_UpperArm=LeftArm, \
             J_Bip_L_LowerArm=LeftForeArm, J_Bip_L_Hand=LeftHand, J_Bip_L_UpperLeg=LeftUpLeg, \
             J_Bip_L_LowerLeg=LeftLeg, J_Bip_L_Foot=LeftFoot, J_Bip_L_ToeBase=LeftToeBase",
        );
        check(
            "hips=Hips, spine=Spine, chest=Spine1, leftUpperLeg=LeftUpLeg, \
             leftLowerLeg=LeftLeg, leftFoot=LeftFoot, leftToes=LeftToeBase, \
             rightUpperArm=RightArm, rightLowerArm=RightForeArm, rightThumbMetacarpal",
        );
    }

    #[test]
    fn biped() {
        check(
            "Bip01, Bip01 Pelvis=Hips, Bip01 Spine=Spine, Bip01 Spine1=Spine1, Bip01 Neck=Neck, \
             Bip01 L Thigh=LeftUpLeg, Bip01 L Calf=LeftLeg, Bip01 L Foot=LeftFoot, \
             Bip01 L Toe0=LeftToeBase, Bip01 L Toe0Nub, Bip01 R Clavicle=RightShoulder, \
             Bip01 R UpperArm=RightArm, Bip01 R Forearm=RightForeArm, Bip01 R Hand=RightHand, \
             Bip01 R Finger0",
        );
        check("Bip001_Pelvis=Hips, Bip001_L_Thigh=LeftUpLeg");
    }

    #[test]
    fn blender() {
        check(
            "DEF-hips=Hips, DEF-thigh.L=LeftUpLeg, DEF-thigh.L.001, DEF-shin.L=LeftLeg, \
             DEF-foot.L=LeftFoot, DEF-toe.L=LeftToeBase, DEF-upper_arm.R=RightArm, \
             DEF-forearm.R=RightForeArm, DEF-hand.R=RightHand, DEF-shoulder.R=RightShoulder",
        );
        check("hips=Hips, leg.L=LeftUpLeg, UpLeg.R=RightUpLeg, Leg.R=RightLeg, Leg_R_end");
    }

    #[test]
    fn collar_bones_make_shoulders_arms_and_ankles_make_feet_toes() {
        check(
            "Hips=Hips, Chest=Spine, LeftCollar=LeftShoulder, LeftShoulder=LeftArm, \
             LeftElbow=LeftForeArm, LeftWrist=LeftHand, LeftHip=LeftUpLeg, LeftKnee=LeftLeg, \
             LeftAnkle=LeftFoot, LeftToe=LeftToeBase",
        );
        check(
            "Pelvis=Hips, L_Hip=LeftUpLeg, L_Knee=LeftLeg, L_Ankle=LeftFoot, \
             L_Foot=LeftToeBase, L_Collar=LeftShoulder, L_Shoulder=LeftArm, L_Elbow=LeftForeArm, \
             L_Wrist=LeftHand, L_Hand",
        );
        check("hip=Hips, lThigh=LeftUpLeg, lShin=LeftLeg, lCollar=LeftShoulder, lShldr=LeftArm");
    }

    #[test]
    fn no_human_no_roles() {
        check("tail_01, wing.L, wheel_fl, Cube, léft, 左足, _, 7");
    }

    #[test]
    fn opposites_are_mutual() {
        for &role in JointRole::ALL {
            assert_eq!(role.opposite().opposite(), role, "{role:?}");
        }
        assert_eq!(JointRole::LeftFoot.opposite(), JointRole::RightFoot);
        assert_eq!(JointRole::Head.opposite(), JointRole::Head);
    }
}
