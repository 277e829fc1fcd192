//! The voids of wood that adhesive cannot get to.

use bondline::{Placed, open_voids};

use crate::{Datum, Side, State, Wood};

/// Void voxels in each layer of each piece of wood that no open path connects to the bond line. They
/// go where the wood goes, so that those of the first state of a run are those of all.
#[derive(Clone, Debug, PartialEq)]
pub struct Sealed(Vec<Vec<u64>>);

impl Sealed {
    /// Those of `state`: of adherends apart by the layers they show each other, of wood in one piece by
    /// the layer that `datum` is in.
    pub fn of(state: &State, datum: &Datum) -> Self {
        let n = state.normal.index();
        let layers = |wood: Placed| wood.bits.dims()[n];
        let at = |wood: Placed| {
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
            let open = open_voids(wood.bits, state.normal, layer);
            let open = open.view().counts_along(n).into_iter();
            open.zip(wood.bits.counts_along(n))
                .map(|(open, wood)| area as u64 - open - wood)
                .collect()
        });
        Self(sealed.collect())
    }

    /// In the order of [`State::wood_blocks`], layer by layer.
    pub(crate) fn layers(&self) -> impl Iterator<Item = &[u64]> {
        self.0.iter().map(Vec::as_slice)
    }
}
