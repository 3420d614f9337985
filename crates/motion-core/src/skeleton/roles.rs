//! What part of the body a joint is, recognised from its name.

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
    /// Roles recognised from joint names.
    pub fn from_names<'a>(names: impl IntoIterator<Item = &'a str>) -> Self {
        let mut roles = Self::default();
        for (idx, name) in names.into_iter().enumerate() {
            if let Some(role) = JointRole::from_name(name) {
                roles.set(role, JointIdx::from_idx(idx));
            }
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

    /// The role of `joint`, if it has one.
    pub fn role_of(&self, joint: JointIdx) -> Option<JointRole> {
        JointRole::ALL.iter().copied().find(|&role| self.joint(role) == Some(joint))
    }
}
