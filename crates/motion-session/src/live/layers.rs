//! What is changed by hand on a character's kept takes, and which takes that counts for.

use std::collections::BTreeMap;
use std::sync::Arc;

use motion_core::by_hand;
use motion_core::skeleton::Skeleton;

use super::lineage::Lineage;
use super::snapshot::HandLayer;
use crate::document::{ByHand, TakeId};
use crate::hand_layer::layer_on;

/// The layers of a character's kept takes.
///
/// A take without a layer of its own has that of the nearest take that it was improved from, so
/// that what is changed by hand stays while the take is refined.
#[derive(Clone, Debug, Default)]
pub(super) struct Layers {
    layers: BTreeMap<TakeId, Layer>,
    remarks: Vec<String>,
}

#[derive(Clone, Debug)]
struct Layer {
    authored: Arc<ByHand>,
    on_body: by_hand::ByHand,
}

impl Layers {
    /// These layers from now on, on this body.
    pub(super) fn set<'l>(
        &mut self,
        layers: impl Iterator<Item = (TakeId, &'l ByHand)>,
        skeleton: &Skeleton,
    ) {
        self.remarks.clear();
        self.layers.clear();
        for (take, layer) in layers {
            let (on_body, remarks) = layer_on(layer, skeleton);
            self.remarks.extend(remarks);
            self.layers.insert(take, Layer { authored: Arc::new(layer.clone()), on_body });
        }
        // A copy of a layer on a descendant has the same things to say.
        self.remarks.sort();
        self.remarks.dedup();
    }

    /// Sentences on edits that the body has no part for.
    pub(super) fn remarks(&self) -> &[String] {
        &self.remarks
    }

    /// The layer that counts for a take.
    pub(super) fn of(&self, take: TakeId, lineage: &Lineage) -> Option<HandLayer> {
        if self.layers.is_empty() {
            return None;
        }
        let from = lineage.nearest(take, |take| self.layers.contains_key(&take))?;
        Some(HandLayer { from, layer: Arc::clone(&self.layers.get(&from)?.authored) })
    }

    /// The layer of a kept take, as it is on the body.
    pub(super) fn on_body(&self, take: TakeId) -> Option<&by_hand::ByHand> {
        Some(&self.layers.get(&take)?.on_body)
    }
}
