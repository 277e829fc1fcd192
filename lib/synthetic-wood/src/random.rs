//! Streams of random numbers.

use rand::SeedableRng;
use rand_chacha::ChaCha8Rng;

use super::recipe::Plan;

/// What a stream of random numbers decides; one stream each, so that a change in one feature
/// leaves the others of the same seed as they are.
#[derive(Clone, Copy)]
pub(crate) enum Feature {
    Cut,
    Face,
    Vessels,
    Rays,
    Fibres,
}

/// The generator for `feature` of the adherend `side` (0 bottom, 1 top). The adhesives'
/// specimens and those of each species are different pieces of wood. ChaCha8 by name, because `StdRng` may change
/// between releases and specimens are kept.
pub(crate) fn stream(plan: &Plan, side: usize, feature: Feature) -> ChaCha8Rng {
    let mut generator = ChaCha8Rng::seed_from_u64(plan.seed);
    let wood = match plan.adhesive {
        Some(adhesive) => 2 * adhesive as u64 + side as u64,
        None => 4 + plan.species as u64,
    };
    generator.set_stream(16 * wood + feature as u64);
    generator
}
