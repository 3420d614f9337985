//! Which takes were improved from which.

use std::collections::{BTreeMap, BTreeSet, VecDeque};

use crate::document::TakeId;

/// Takes that are remembered. Far more than a session makes; beyond it the whole is forgotten but
/// for what is told anew.
const MAX_TAKES: usize = 100_000;

/// Parents of takes. A take may be come to from several others.
#[derive(Clone, Debug, Default)]
pub(crate) struct Lineage {
    parents: BTreeMap<TakeId, Vec<TakeId>>,
}

impl Lineage {
    /// `child` was improved from `parent`.
    pub(crate) fn note(&mut self, child: TakeId, parent: TakeId) {
        if child == parent {
            return;
        }
        if self.parents.len() >= MAX_TAKES {
            self.parents.clear();
        }
        let parents = self.parents.entry(child).or_default();
        if !parents.contains(&parent) {
            parents.push(parent);
        }
    }

    /// The take that `child` was last improved from.
    pub(crate) fn parent(&self, child: TakeId) -> Option<TakeId> {
        self.parents.get(&child)?.last().copied()
    }

    /// Whether `take` is `ancestor` or was made of it by improvements.
    pub(crate) fn descends(&self, take: TakeId, ancestor: TakeId) -> bool {
        let mut seen = BTreeSet::from([take]);
        let mut open = vec![take];
        while let Some(take) = open.pop() {
            if take == ancestor {
                return true;
            }
            let parents = self.parents.get(&take).into_iter().flatten();
            open.extend(parents.filter(|parent| seen.insert(**parent)));
        }
        false
    }

    /// The nearest of `take` and its ancestors that `is_it` says yes to; of equally near ones the
    /// one that it was last improved from.
    pub(crate) fn nearest(&self, take: TakeId, is_it: impl Fn(TakeId) -> bool) -> Option<TakeId> {
        let mut seen = BTreeSet::from([take]);
        let mut open = VecDeque::from([take]);
        while let Some(take) = open.pop_front() {
            if is_it(take) {
                return Some(take);
            }
            let parents = self.parents.get(&take).into_iter().flatten().rev();
            open.extend(parents.filter(|parent| seen.insert(**parent)));
        }
        None
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn descent_goes_over_any_number_of_steps_and_ends_in_circles() {
        let [a, b, c, d] = [1, 2, 3, 4].map(TakeId);
        let mut lineage = Lineage::default();
        for (child, parent) in [(b, a), (c, b), (b, c), (c, d), (a, a)] {
            lineage.note(child, parent);
        }
        assert!(lineage.descends(c, a) && lineage.descends(c, d) && lineage.descends(a, a));
        assert!(!lineage.descends(a, c) && !lineage.descends(d, a));
        assert_eq!(lineage.nearest(c, |take| take == a || take == d), Some(d), "one step away");
        assert_eq!(lineage.nearest(c, |take| take == c || take == d), Some(c), "itself first");
        assert_eq!(lineage.nearest(a, |take| take == d), None);
        assert_eq!((lineage.parent(c), lineage.parent(a)), (Some(d), None));
    }
}
