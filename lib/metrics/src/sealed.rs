//! Sealed voids of wood, which adhesive cannot reach.

use bondline::{PlacedVoxels, open_voids};

use crate::{Datum, Side, State, Wood};

/// Number of sealed void voxels, without an open path to the bond line, in each layer of each piece of wood. They move with
/// the wood, so one count serves all states of a run.
#[derive(Clone, Debug, PartialEq)]
pub struct Sealed(Vec<Vec<u64>>);

impl Sealed {
    /// The sealed voids of `state`. Open voids are those connected to the bond layers of parted adherends, or to the layer of
    /// `datum` in wood of one piece.
    pub fn of(state: &State, datum: &Datum) -> Self {
        let n = state.normal.index();
        let layers = |wood: PlacedVoxels| wood.bits.dims()[n];
        let at = |wood: PlacedVoxels| {
            let level = (datum.plane_m(Side::Total) - wood.origin_m[n]) / wood.voxel_m;
            (level.max(0.0) as usize).min(layers(wood).saturating_sub(1))
        };
        let from = match state.wood {
            Wood::None => Vec::new(),
            Wood::Whole(wood) => vec![(wood, at(wood))],
            Wood::Parted { bottom, top } => {
                vec![(bottom, layers(bottom).saturating_sub(1)), (top, 0)]
            }
        };
        let sealed = from.into_iter().map(|(wood, layer)| {
            if layers(wood) == 0 {
                return Vec::new();
            }
            let area = wood.bits.dims().iter().product::<usize>() / layers(wood);
            let open = open_voids(wood.bits, state.normal, layer, [false; 3]);
            let open = open.view().counts_along(n).into_iter();
            open.zip(wood.bits.counts_along(n))
                .map(|(open, wood)| area as u64 - open - wood)
                .collect()
        });
        Self(sealed.collect())
    }

    /// Counts by layer, for each of [`State::wood_blocks`].
    pub(crate) fn layers(&self) -> impl Iterator<Item = &[u64]> {
        self.0.iter().map(Vec::as_slice)
    }
}
