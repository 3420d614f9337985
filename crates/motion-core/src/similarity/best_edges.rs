//! The edges that a frame may keep: at most a given number, local minima first, then by cost.

/// A kept edge as one number, so that less is better: local minima before others, then by cost,
/// then by row.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(super) struct Key(u64);

impl Key {
    /// Behind every edge.
    const NONE: Self = Self(u64::MAX);
    const NO_MINIMUM: u64 = 1 << 63;

    /// The key of an edge to `row`; `cost` is not negative.
    pub(super) fn new(is_minimum: bool, cost: f32, row: u32) -> Self {
        let class = if is_minimum { 0 } else { Self::NO_MINIMUM };
        Self(class | (u64::from(cost.to_bits()) << 32) | u64::from(row))
    }

    pub(super) fn is_minimum(self) -> bool {
        self.0 & Self::NO_MINIMUM == 0
    }

    pub(super) fn cost(self) -> f32 {
        f32::from_bits((self.0 >> 32) as u32 & 0x7FFF_FFFF)
    }

    pub(super) fn row(self) -> u32 {
        self.0 as u32
    }
}

/// The best edges of each of a run of rows.
#[derive(Clone, Debug)]
pub(super) struct BestEdges {
    n_kept: usize,
    /// `n_kept` a row, best first.
    keys: Vec<Key>,
}

impl BestEdges {
    /// No edges yet, `n_kept` at most for each of `n_rows` rows.
    pub(super) fn new(n_rows: usize, n_kept: usize) -> Self {
        Self { n_kept, keys: vec![Key::NONE; n_rows * n_kept] }
    }

    /// The edges of the `nth` row, best first.
    pub(super) fn of(&self, nth: usize) -> &[Key] {
        let keys = &self.keys[nth * self.n_kept..(nth + 1) * self.n_kept];
        &keys[..keys.partition_point(|&key| key != Key::NONE)]
    }

    /// Keeps `key` for the `nth` row if it is among the best. It must not be there yet.
    pub(super) fn offer(&mut self, nth: usize, key: Key) {
        let keys = &mut self.keys[nth * self.n_kept..(nth + 1) * self.n_kept];
        let Some(&worst) = keys.last() else { return };
        if key < worst {
            let at = keys.partition_point(|&other| other < key);
            keys.copy_within(at..keys.len() - 1, at + 1);
            keys[at] = key;
        }
    }

    /// Costs above which the `nth` row can keep no more: of local minima, and of other edges.
    /// `tau` while there is room.
    pub(super) fn limits(&self, nth: usize, tau: f32) -> Limits {
        let keys = &self.keys[nth * self.n_kept..(nth + 1) * self.n_kept];
        match keys.last() {
            None => Limits { minima: f32::NEG_INFINITY, others: f32::NEG_INFINITY },
            Some(&Key::NONE) => Limits { minima: tau, others: tau },
            Some(worst) if worst.is_minimum() => {
                Limits { minima: worst.cost(), others: f32::NEG_INFINITY }
            }
            Some(worst) => Limits { minima: tau, others: worst.cost() },
        }
    }
}

/// See [`BestEdges::limits`].
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Limits {
    pub(super) minima: f32,
    pub(super) others: f32,
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;

    proptest! {
        #[test]
        fn what_is_kept_is_the_head_of_the_sorted_list(
            offered in prop::collection::btree_map(0u32..500, (any::<bool>(), 0f32..9.0), 0..60)
        ) {
            let mut best = BestEdges::new(2, 8);
            let mut all: Vec<Key> =
                offered.iter().map(|(&row, &(minimum, cost))| Key::new(minimum, cost, row)).collect();
            for &key in &all {
                best.offer(1, key);
            }
            all.sort_unstable();
            all.truncate(8);
            prop_assert_eq!(best.of(1), &all[..]);
            prop_assert_eq!(best.of(0), &[] as &[Key], "rows do not mix");
        }
    }

    #[test]
    fn a_key_holds_what_it_was_made_of() {
        let key = Key::new(false, 0.25, 77);
        assert_eq!((key.is_minimum(), key.cost(), key.row()), (false, 0.25, 77));
        assert!(Key::new(true, 9.0, 5) < key, "a local minimum goes first whatever it costs");
    }

    #[test]
    fn limits_say_what_can_still_come_in() {
        let mut best = BestEdges::new(1, 2);
        assert_eq!(best.limits(0, 5.0), Limits { minima: 5.0, others: 5.0 });
        best.offer(0, Key::new(false, 3.0, 1));
        best.offer(0, Key::new(true, 4.0, 2));
        assert_eq!(best.limits(0, 5.0), Limits { minima: 5.0, others: 3.0 });
        best.offer(0, Key::new(true, 4.5, 3));
        assert_eq!(best.limits(0, 5.0), Limits { minima: 4.5, others: f32::NEG_INFINITY });
    }
}
