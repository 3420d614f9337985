//! What a take's changes by hand mean for a body.

use glam::{DVec3, Vec3};
use motion_core::by_hand::{self, HandOffset, JointOffset, Stretch};
use motion_core::skeleton::Skeleton;

use crate::document::{ByHand, HandChange, HandEdit};

/// A layer on a body, with a sentence for each edit that the body has no part for.
pub fn layer_on(layer: &ByHand, skeleton: &Skeleton) -> (by_hand::ByHand, Vec<String>) {
    let mut on_body = by_hand::ByHand { retime: layer.retime().clone(), ..Default::default() };
    let mut remarks = Vec::new();
    for (id, edit) in layer.edits() {
        let HandEdit { change, from, to, ease_in, ease_out } = edit;
        let stretch = Stretch { from: *from, to: *to, ease_in: *ease_in, ease_out: *ease_out };
        match change {
            HandChange::Joint { joint, turn_deg } => match skeleton.find(joint) {
                Some(joint) => {
                    let turn_rad = vector(turn_deg.map(f64::to_radians));
                    on_body.joints.push(JointOffset { joint, turn_rad, stretch });
                }
                None => remarks.push(format!(
                    "the change by hand {id:?} turns {joint:?}, which this body does not have"
                )),
            },
            HandChange::Hand { limb, shift_m, space } => {
                if limb.is_on(skeleton) {
                    let (limb, shift_m, space) = (*limb, vector(*shift_m), *space);
                    on_body.hands.push(HandOffset { limb, shift_m, space, stretch });
                } else {
                    remarks.push(format!(
                        "the change by hand {id:?} moves {}, which on this body is no end of two bones",
                        limb.end_role().name()
                    ));
                }
            }
        }
    }
    (on_body, remarks)
}

fn vector(of: [f64; 3]) -> Vec3 {
    DVec3::from(of).as_vec3()
}
