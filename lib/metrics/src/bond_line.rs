//! State of the bond line, beside penetration: wetted wood area, filled lumens, and whether the bond line is filled.

use bondline::PlacedVoxels;
use particle_file::{BitGrid, BitsRef};
use voxels::VolumeFractions;

use crate::{
    Adhesive, Datum, DepthLayer, Error, Reference, Sealed, Side, State, Wood, depth_profile,
};

/// Voxels of wood on each side that count to the bond line.
const VOXELS_BESIDE: f64 = 2.0;
/// Filled fraction of the bond line below which it is starved.
const STARVED: f64 = 0.5;
/// Filled fraction of open lumens from which a layer counts to the half-filled depth.
const HALF_FULL: f64 = 0.5;
/// Fraction of the adhesive lost through open sides above which the bond line is squeezed out.
const SQUEEZED_OUT: f64 = 0.05;

/// How well adhesive fills the bond line.
#[derive(Clone, Copy, Debug, PartialEq, Eq, strum::Display)]
#[strum(serialize_all = "kebab-case")]
pub enum Filling {
    /// Adhesive fills at least half of the void there.
    Filled,
    /// Adhesive fills less than half: the rest is in the wood.
    Starved,
    /// More than a twentieth of the adhesive has left through open sides.
    SqueezedOut,
}

/// The bond line of a state.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct BondLine {
    /// Distance between the bond surfaces of the adherends, m. Rough surfaces keep a distance when the bond is closed, as in
    /// the specimen.
    pub surfaces_m: f64,
    /// Filled fraction of the void: mean over the layers between the bond surfaces and two voxels into each adherend.
    pub filled: f64,
    /// The class of that fraction.
    pub filling: Filling,
    /// Area of voxel faces between wood and adhesive on bottom, top and both, m2. The steps of a slanted or round wall count
    /// 4/pi of its area on average.
    pub wetted_m2: [f64; 3],
    /// Depth (m) from midway between the bond surfaces to which every layer of open lumens is at least half full: bottom, top,
    /// and the smaller of the two.
    pub half_filled_m: [f64; 3],
}

/// Measures the bond line of `state`. `lost_fraction` is the fraction of the adhesive that left through open sides; it cannot be
/// derived from the volume, because walls take water and pressure compresses the liquid.
pub fn bond_line(state: &State, lost_fraction: f64, sealed: &Sealed) -> Result<BondLine, Error> {
    let surfaces = Datum::find(Reference::Adherend, state)?;
    let surfaces_m = surfaces.plane_m(Side::Top) - surfaces.plane_m(Side::Bottom);
    let middle = Datum::find(Reference::Mid, state)?;
    let reach = 0.5 * surfaces_m + VOXELS_BESIDE * state.voxel_m;
    let layers = depth_profile(state, &middle, sealed)?;
    let fractions: Vec<f64> = (layers.iter())
        .filter(|layer| layer.depth_m.abs() < reach && layer.filled_void_fraction.is_finite())
        .map(|layer| layer.filled_void_fraction)
        .collect();
    let filled = fractions.iter().sum::<f64>() / fractions.len() as f64;
    let filling = if lost_fraction > SQUEEZED_OUT {
        Filling::SqueezedOut
    } else if filled < STARVED {
        Filling::Starved
    } else {
        Filling::Filled
    };
    let [bottom, top] = wetted_areas(state, &middle);
    Ok(BondLine {
        surfaces_m,
        filled,
        filling,
        wetted_m2: [bottom, top, bottom + top],
        half_filled_m: half_filled_depths(&layers, state.voxel_m),
    })
}

/// Depth (m) to which the layers from the bond line on are at least half full: bottom, top, and the smaller of the two.
/// Layers without open lumens are skipped.
fn half_filled_depths(layers: &[DepthLayer], voxel_m: f64) -> [f64; 3] {
    let reach = |layers: &mut dyn Iterator<Item = &DepthLayer>| {
        let open = layers.filter(|layer| layer.filled_open_fraction.is_finite());
        let full = open.take_while(|layer| layer.filled_open_fraction >= HALF_FULL);
        full.last().map_or(0.0, |l| l.depth_m.abs() + 0.5 * voxel_m)
    };
    let top = layers.partition_point(|layer| layer.depth_m < 0.0);
    let bottom = reach(&mut layers[..top].iter().rev());
    let top = reach(&mut layers[top..].iter());
    [bottom, top, bottom.min(top)]
}

/// Area of the faces between wood and adhesive on the bottom and the top side, m2.
fn wetted_areas(state: &State, middle: &Datum) -> [f64; 2] {
    let mut areas = [0.0; 2];
    let mut add = |side, area| match side {
        Side::Bottom => areas[0] += area,
        _ => areas[1] += area,
    };
    match (state.wood, state.adhesive) {
        (Wood::Parted { bottom, top }, Adhesive::Points { position, volume }) => {
            for (side, wood) in [(Side::Bottom, bottom), (Side::Top, top)] {
                let lattice = AdherendLattice::new(state, wood, side);
                let liquid = lattice.liquid(position, volume);
                let faces = lattice.faces(liquid.view());
                add(side, faces.len() as f64 * wood.voxel_m.powi(2));
            }
        }
        (Wood::Whole(wood), Adhesive::Voxels(adhesive)) => {
            let lattice = AdherendLattice {
                wood,
                shift: [0; 3],
                dims: wood.bits.dims(),
            };
            for index in lattice.faces(adhesive.bits) {
                let (side, _) = middle.depth(wood.centre_m(index), wood.voxel_m);
                add(side, wood.voxel_m.powi(2));
            }
        }
        _ => {}
    }
    areas
}

/// The voxels of an adherend, with one more layer at its bond surface.
struct AdherendLattice<'a> {
    wood: PlacedVoxels<'a>,
    /// Offset of the wood in the lattice, voxels.
    shift: [usize; 3],
    dims: [usize; 3],
}

impl<'a> AdherendLattice<'a> {
    fn new(state: &State, wood: PlacedVoxels<'a>, side: Side) -> Self {
        let n = state.normal.index();
        let (mut shift, mut dims) = ([0; 3], wood.bits.dims());
        dims[n] += 1;
        shift[n] = usize::from(side == Side::Top);
        Self { wood, shift, dims }
    }

    fn is_wood(&self, index: [usize; 3]) -> bool {
        let dims = self.wood.bits.dims();
        let own: [usize; 3] = std::array::from_fn(|a| index[a].wrapping_sub(self.shift[a]));
        (0..3).all(|a| own[a] < dims[a]) && self.wood.bits.get(own[0], own[1], own[2])
    }

    fn open(&self) -> BitGrid {
        let [shift, dims] = [self.shift, self.wood.bits.dims()];
        if shift[0] > 0 {
            return BitGrid::from_fn(self.dims, |x, y, z| !self.is_wood([x, y, z]));
        }
        BitGrid::from_rows(self.dims, |y, z, row| {
            row.fill(u64::MAX);
            let [y, z] = [y.wrapping_sub(shift[1]), z.wrapping_sub(shift[2])];
            if y < dims[1] && z < dims[2] {
                for (open, wood) in row.iter_mut().zip(self.wood.bits.row(y, z)) {
                    *open = !wood;
                }
            }
        })
    }

    fn liquid(&self, position: &[[f32; 3]], volume: &[f32]) -> BitGrid {
        let edge = self.wood.voxel_m;
        let open = self.open();
        let mut fractions = VolumeFractions::new(open);
        for (p, &v) in position.iter().zip(volume) {
            let place: [f64; 3] = std::array::from_fn(|a| {
                (f64::from(p[a]) - self.wood.origin_m[a]) / edge + self.shift[a] as f64
            });
            if (0..3).all(|a| (0.0..=self.dims[a] as f64).contains(&place[a])) {
                fractions.add(place, f64::from(v) / edge.powi(3));
            }
        }
        fractions.fullest()
    }

    /// The wood voxel at each face between wood and `liquid`.
    fn faces(&self, liquid: BitsRef) -> Vec<[usize; 3]> {
        let mut found = Vec::new();
        liquid.for_each(|index| {
            if self.is_wood(index) {
                return;
            }
            for a in 0..3 {
                for next in [index[a].wrapping_sub(1), index[a] + 1] {
                    let mut beside = index;
                    beside[a] = next;
                    if next < self.dims[a] && self.is_wood(beside) {
                        found.push(std::array::from_fn(|a| beside[a] - self.shift[a]));
                    }
                }
            }
        });
        found
    }
}
