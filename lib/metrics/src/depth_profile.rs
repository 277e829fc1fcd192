//! Adhesive against depth.

use bondline::Placed;

use crate::{Adhesive, Datum, Error, Sealed, Side, State, Wood};

/// Adhesive in the layers of one voxel at a distance from the bond line.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct DepthLayer {
    /// Middle of the layer, m; negative in the bottom adherend.
    pub depth_m: f64,
    /// Volume of adhesive over that of the layer.
    pub adhesive_fraction: f64,
    /// Volume of adhesive over that of the layer outside wood (Hass et al.); NaN where all
    /// is wood.
    pub filled_void_fraction: f64,
    /// Volume of adhesive over that of the layer outside wood and its sealed voids: the filled share of
    /// its open lumens; NaN where there are none.
    pub filled_open_fraction: f64,
}

/// The adhesive against depth, from the far side of the bottom to that of the top adherend, in wood with
/// these `sealed` voids.
///
/// Layers are one voxel thick and begin at the reference; a voxel or material point is spread
/// evenly over one voxel along the normal, so that a reference between voxel faces and an
/// adherend between them need no rounding. With [`crate::Reference::Adherend`] what lies
/// between the two bond surfaces is in no layer.
pub fn depth_profile(
    state: &State,
    datum: &Datum,
    sealed: &Sealed,
) -> Result<Vec<DepthLayer>, Error> {
    if matches!(datum, Datum::Tilted(_)) {
        return Err(Error::Usage(
            "--profile counts layers, which a fitted, tilted plane does not have; use --reference mid, adherend or plane=LEN".into(),
        ));
    }
    let n = state.normal.index();
    let [low, high] = extent(state);
    let voxel = state.voxel_m;
    let mut layers = Layers::new(datum, low, high, voxel);
    layers.add_span(low, high, 1.0, |l| &mut l.thickness);
    let mut add_block = |block: Placed, counts: &[u64], what: fn(&mut Layer) -> &mut f64| {
        let area = block.voxel_m * block.voxel_m / state.area_m2();
        for (layer, &count) in counts.iter().enumerate() {
            let at = block.origin_m[n] + layer as f64 * block.voxel_m;
            layers.add_span(at, at + block.voxel_m, count as f64 * area, what);
        }
    };
    for (wood, closed) in state.wood_blocks().zip(sealed.layers()) {
        add_block(wood, &wood.bits.counts_along(n), |l| &mut l.wood);
        add_block(wood, closed, |l| &mut l.sealed);
    }
    match state.adhesive {
        Adhesive::Voxels(adhesive) => {
            add_block(adhesive, &adhesive.bits.counts_along(n), |l| {
                &mut l.adhesive
            });
        }
        Adhesive::Points { position, volume } => {
            for (p, &v) in position.iter().zip(volume) {
                let at = f64::from(p[n]) - 0.5 * voxel;
                let fraction = f64::from(v) / state.area_m2() / voxel;
                layers.add_span(at, at + voxel, fraction, |l| &mut l.adhesive);
            }
        }
    }
    Ok(layers.finish())
}

/// From the low face of the bottom to the high face of the top adherend, m.
fn extent(state: &State) -> [f64; 2] {
    let n = state.normal.index();
    match state.wood {
        Wood::None => [state.box_min_m[n], state.box_max_m[n]],
        Wood::Whole(wood) => [wood.origin_m[n], wood.max_m()[n]],
        Wood::Parted { bottom, top } => [bottom.origin_m[n], top.max_m()[n]],
    }
}

/// Thicknesses (m) that specimen, wood, its sealed voids and adhesive would have in a layer if spread over the
/// whole bond area.
#[derive(Clone, Copy, Default)]
struct Layer {
    thickness: f64,
    wood: f64,
    sealed: f64,
    adhesive: f64,
}

struct Layers<'a> {
    datum: &'a Datum,
    voxel: f64,
    bottom: Vec<Layer>,
    top: Vec<Layer>,
}

impl<'a> Layers<'a> {
    fn new(datum: &'a Datum, low: f64, high: f64, voxel: f64) -> Self {
        let count = |thickness: f64| (thickness / voxel - 1e-6).ceil().max(0.0) as usize;
        let [bottom, top] = [
            count(datum.plane_m(Side::Bottom) - low),
            count(high - datum.plane_m(Side::Top)),
        ];
        Self {
            datum,
            voxel,
            bottom: vec![Layer::default(); bottom],
            top: vec![Layer::default(); top],
        }
    }

    /// Spreads `fraction` of the bond area over `from` to `to` (m along the normal).
    fn add_span(
        &mut self,
        from: f64,
        to: f64,
        fraction: f64,
        what: impl Fn(&mut Layer) -> &mut f64,
    ) {
        let bottom = self.datum.plane_m(Side::Bottom);
        let top = self.datum.plane_m(Side::Top);
        let spans = [
            (&mut self.bottom, bottom - to, bottom - from),
            (&mut self.top, from - top, to - top),
        ];
        for (layers, near, far) in spans {
            let first = (near / self.voxel).floor().max(0.0) as usize;
            let last = (far / self.voxel).ceil().max(0.0) as usize;
            for layer in first..last.min(layers.len()) {
                let [low, high] = [layer, layer + 1].map(|l| l as f64 * self.voxel);
                let overlap = far.min(high) - near.max(low);
                *what(&mut layers[layer]) += fraction * overlap.max(0.0);
            }
        }
    }

    fn finish(self) -> Vec<DepthLayer> {
        let voxel = self.voxel;
        let share = |adhesive: f64, room: f64| match room {
            room if room > 1e-9 * voxel => adhesive / room,
            _ => f64::NAN,
        };
        let layer = |sign: f64| {
            move |(index, layer): (usize, &Layer)| DepthLayer {
                depth_m: sign * (index as f64 + 0.5) * voxel,
                adhesive_fraction: layer.adhesive / layer.thickness,
                filled_void_fraction: share(layer.adhesive, layer.thickness - layer.wood),
                filled_open_fraction: share(
                    layer.adhesive,
                    layer.thickness - layer.wood - layer.sealed,
                ),
            }
        };
        let bottom = self.bottom.iter().enumerate().rev().map(layer(-1.0));
        bottom
            .chain(self.top.iter().enumerate().map(layer(1.0)))
            .collect()
    }
}
