//! A share of a build that one of several machines does.

/// Share `nth` of `n`, counted from 0.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Shard {
    nth: u32,
    n: u32,
}

impl Shard {
    /// All of it.
    pub const WHOLE: Self = Self { nth: 0, n: 1 };

    /// Share `nth` (from 0) of `n`; `None` where there is no such share.
    pub fn new(nth: u32, n: u32) -> Option<Self> {
        (nth < n).then_some(Self { nth, n })
    }

    /// Which share, from 0.
    pub fn nth(self) -> u32 {
        self.nth
    }

    /// Of how many.
    pub fn n(self) -> u32 {
        self.n
    }

    /// Whether it has the item `at` of a list: every n-th, so that shares are alike.
    #[inline]
    pub(crate) fn has(self, at: usize) -> bool {
        at % self.n as usize == self.nth as usize
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_item_is_in_one_share() {
        let shards: Vec<Shard> = (0..3).filter_map(|nth| Shard::new(nth, 3)).collect();
        for at in 0..20 {
            assert_eq!(shards.iter().filter(|shard| shard.has(at)).count(), 1, "{at}");
        }
        assert_eq!(Shard::new(3, 3), None);
        assert!(Shard::WHOLE.has(7));
    }
}
