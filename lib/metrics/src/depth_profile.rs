//! Adhesive against depth.

use bondline::PlacedVoxels;

use crate::{Adhesive, Datum, Error, Sealed, Side, State, Wood};

/// Adhesive in a layer one voxel thick.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct DepthLayer {
    /// Middle of the layer, m; negative in the bottom adherend.
    pub depth_m: f64,
    /// Volume of adhesive over that of the layer.
    pub adhesive_fraction: f64,
    /// Volume of adhesive over that of the void in the layer (Hass et al.); NaN without void.
    pub filled_void_fraction: f64,
    /// Filled fraction of the open lumens: volume of adhesive over that of the void without sealed voids; NaN without open
    /// lumens.
    pub filled_open_fraction: f64,
}

/// The adhesive against depth, from the outer face of the bottom adherend to that of the top one.
///
/// Layers are one voxel thick and begin at the reference. The volume of a voxel is spread evenly over its height. That of a
/// material point is spread over the height it has on the area of a voxel, at most one voxel; points in a partly closed
/// row thus fill its layer. So neither the reference nor the adherends need to lie on voxel faces. With
/// [`crate::Reference::Adherend`], adhesive between the two bond surfaces is in no layer.
pub fn depth_profile(
    state: &State,
    datum: &Datum,
    sealed: &Sealed,
) -> Result<Vec<DepthLayer>, Error> {
    if matches!(datum, Datum::Tilted(_)) {
        return Err(Error::Usage(
            "--profile counts layers, which a tilted, fitted plane does not have; use --reference mid, adherend or plane=LEN".into(),
        ));
    }
    let (n, voxel) = (state.normal.index(), state.voxel_m);
    let [low, high] = extent(state);
    let zeros = [Side::Bottom, Side::Top].map(|side| datum.plane_m(side));
    // Layers on both sides, counted from the bond line outwards.
    let mut sides = [zeros[0] - low, high - zeros[1]].map(|thickness| {
        let count = (thickness / voxel - 1e-6).ceil().max(0.0);
        vec![Layer::default(); count as usize]
    });
    // Spreads a fraction of the bond area over a span (m along the normal).
    let mut add = |[from, to]: [f64; 2], fraction: f64, what: fn(&mut Layer) -> &mut f64| {
        let spans = [
            [zeros[0] - to, zeros[0] - from],
            [from - zeros[1], to - zeros[1]],
        ];
        for (layers, [near, far]) in sides.iter_mut().zip(spans) {
            let first = (near / voxel).floor().max(0.0) as usize;
            let last = (far / voxel).ceil().max(0.0) as usize;
            for layer in first..last.min(layers.len()) {
                let [low, high] = [layer, layer + 1].map(|l| l as f64 * voxel);
                let overlap = far.min(high) - near.max(low);
                *what(&mut layers[layer]) += fraction * overlap.max(0.0);
            }
        }
    };
    add([low, high], 1.0, |l| &mut l.thickness);
    let mut add_block = |block: PlacedVoxels, counts: &[u64], what: fn(&mut Layer) -> &mut f64| {
        let area = block.voxel_m * block.voxel_m / state.area_m2();
        for (layer, &count) in counts.iter().enumerate() {
            let at = block.origin_m[n] + layer as f64 * block.voxel_m;
            add([at, at + block.voxel_m], count as f64 * area, what);
        }
    };
    for (wood, closed) in state.wood_blocks().zip(sealed.layers()) {
        add_block(wood, &wood.bits.counts_along(n), |l| &mut l.wood);
        add_block(wood, closed, |l| &mut l.sealed);
    }
    match state.adhesive {
        Adhesive::Voxels(block) => {
            add_block(block, &block.bits.counts_along(n), |l| &mut l.adhesive);
        }
        Adhesive::Points { position, volume } => {
            for (p, &v) in position.iter().zip(volume) {
                let height = (f64::from(v) / (voxel * voxel)).min(voxel);
                let at = f64::from(p[n]) - 0.5 * height;
                let fraction = f64::from(v) / state.area_m2() / height;
                add([at, at + height], fraction, |l| &mut l.adhesive);
            }
        }
    }
    let [bottom, top] = &sides;
    let at = |index: usize, layer: &Layer, sign: f64| {
        let depth_m = sign * (index as f64 + 0.5) * voxel;
        layer.at(depth_m, voxel)
    };
    let below = bottom
        .iter()
        .enumerate()
        .rev()
        .map(|(i, layer)| at(i, layer, -1.0));
    let above = top.iter().enumerate().map(|(i, layer)| at(i, layer, 1.0));
    Ok(below.chain(above).collect())
}

/// Low face of the bottom adherend and high face of the top one, m.
fn extent(state: &State) -> [f64; 2] {
    let n = state.normal.index();
    match state.wood {
        Wood::None => [state.box_min_m[n], state.box_max_m[n]],
        Wood::Whole(wood) => [wood.origin_m[n], wood.max_m()[n]],
        Wood::Parted { bottom, top } => [bottom.origin_m[n], top.max_m()[n]],
    }
}

/// Volumes of specimen, wood, sealed voids and adhesive in a layer, over the bond area (m).
#[derive(Clone, Copy, Default)]
struct Layer {
    thickness: f64,
    wood: f64,
    sealed: f64,
    adhesive: f64,
}

impl Layer {
    fn at(&self, depth_m: f64, voxel: f64) -> DepthLayer {
        let of_room = |room: f64| match room > 1e-9 * voxel {
            true => self.adhesive / room,
            false => f64::NAN,
        };
        let void = self.thickness - self.wood;
        DepthLayer {
            depth_m,
            adhesive_fraction: self.adhesive / self.thickness,
            filled_void_fraction: of_room(void),
            filled_open_fraction: of_room(void - self.sealed),
        }
    }
}
