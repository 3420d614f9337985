//! Typed indices: what an index points into is part of its type.

use std::fmt;

macro_rules! define_index {
    ($(#[$doc:meta])* $name:ident) => {
        $(#[$doc])*
        #[derive(Clone, Copy, Debug, Default, PartialEq, Eq, PartialOrd, Ord, Hash)]
        pub struct $name(pub u32);

        impl $name {
            /// The index as an array index.
            #[inline]
            pub fn idx(self) -> usize {
                self.0 as usize
            }

            /// The typed index of array position `idx`.
            #[inline]
            pub fn from_idx(idx: usize) -> Self {
                debug_assert!(u32::try_from(idx).is_ok(), "index {idx} out of range");
                Self(idx as u32)
            }
        }

        impl fmt::Display for $name {
            fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
                self.0.fmt(f)
            }
        }
    };
}

define_index! {
    /// A clip of a library.
    ClipId
}
define_index! {
    /// A joint of a skeleton; parents have smaller indices than their children.
    JointIdx
}
