//! Random numbers: one stream per work item, so that threads cannot change the outcome.

use rand::SeedableRng;
use rand_pcg::Pcg64Mcg;

/// The stream of work item `item` in round `round` of the search seeded with `seed`.
pub(crate) fn stream(seed: u64, round: u64, item: u64) -> Pcg64Mcg {
    // SplitMix64's finaliser spreads neighbouring numbers over all bits.
    let mix = |mut z: u64| {
        z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        z ^ (z >> 31)
    };
    let golden = 0x9e37_79b9_7f4a_7c15u64;
    let state = mix(seed.wrapping_add(golden)) ^ mix(round.wrapping_mul(golden).wrapping_add(1));
    Pcg64Mcg::seed_from_u64(mix(state ^ mix(item.wrapping_add(golden << 1))))
}
