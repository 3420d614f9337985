//! Shares of joints in a point of the skin, while they are being worked out.

/// Joints with their shares, which sum to 1.
#[derive(Clone, Debug, Default)]
pub(super) struct Weights(Vec<(usize, f32)>);

impl Weights {
    /// Gives a joint a share more.
    pub(super) fn add(&mut self, joint: usize, share: f32) {
        if share > 0.0 {
            match self.0.iter_mut().find(|entry| entry.0 == joint) {
                Some(entry) => entry.1 += share,
                None => self.0.push((joint, share)),
            }
        }
    }

    /// Gives a joint this share of everything, taken from all alike.
    pub(super) fn take(&mut self, joint: usize, share: f32) {
        let share = share.clamp(0.0, 1.0);
        if share > 0.0 {
            for entry in &mut self.0 {
                entry.1 *= 1.0 - share;
            }
            self.add(joint, share);
        }
    }

    /// Gives `to` this share of what `from` has.
    pub(super) fn pass_on(&mut self, from: usize, to: usize, share: f32) {
        if from == to {
            return;
        }
        if let Some(entry) = self.0.iter_mut().find(|entry| entry.0 == from) {
            let passed = entry.1 * share.clamp(0.0, 1.0);
            entry.1 -= passed;
            self.add(to, passed);
        }
    }

    /// What the joints have together.
    pub(super) fn of(&self, joints: &[usize]) -> f32 {
        self.0.iter().filter(|(joint, _)| joints.contains(joint)).map(|(_, share)| share).sum()
    }

    /// The four greatest shares, summing to 1; joint 0 alone where there are none.
    pub(super) fn four(mut self) -> ([u16; 4], [f32; 4]) {
        self.0.sort_by(|a, b| b.1.total_cmp(&a.1).then(a.0.cmp(&b.0)));
        self.0.truncate(4);
        self.0.retain(|entry| entry.1 > 4e-3);
        let sum: f32 = self.0.iter().map(|entry| entry.1).sum();
        let (mut joints, mut weights) = ([0_u16; 4], [0.0_f32; 4]);
        if sum <= 0.0 || !sum.is_finite() {
            weights[0] = 1.0;
            return (joints, weights);
        }
        for (i, (joint, share)) in self.0.into_iter().enumerate() {
            joints[i] = u16::try_from(joint).unwrap_or(0);
            weights[i] = share / sum;
        }
        (joints, weights)
    }
}
