//! Weighted and effective penetration.

use crate::quantile::quantiles;
use crate::{Datum, Reference, State};

/// One side of the bond line, or both.
#[derive(Clone, Copy, Debug, PartialEq, Eq, strum::Display)]
#[strum(serialize_all = "lowercase")]
pub enum Side {
    /// Low-coordinate side.
    Bottom,
    /// High-coordinate side.
    Top,
    /// Both together.
    Total,
}

impl Side {
    /// All sides in the order of the table.
    pub const ALL: [Side; 3] = [Side::Bottom, Side::Top, Side::Total];

    /// The side of a point at `height` (m) above the plane between the sides; both for a point on it.
    pub(crate) fn of(height: f64, voxel_m: f64) -> Side {
        /// Rounding of single-precision positions, voxels.
        const ROUNDING: f64 = 1e-3;
        if height.abs() <= ROUNDING * voxel_m {
            Side::Total
        } else if height < 0.0 {
            Side::Bottom
        } else {
            Side::Top
        }
    }

    /// Fraction of a volume on `side` that counts to this side: half if it lies on the plane between the sides.
    pub(crate) fn share(self, side: Side) -> f64 {
        match (self, side) {
            (Side::Total, _) => 1.0,
            (_, Side::Total) => 0.5,
            _ => f64::from(u8::from(self == side)),
        }
    }
}

/// Penetration into one side of a bond line.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Penetration {
    /// Which side.
    pub side: Side,
    /// Coordinate along the normal from which depths are measured, m.
    pub plane_m: f64,
    /// Weighted penetration WP = sqrt(sum V Y^2 / sum V), m (paper Eq. 6; Paris & Kamke 2015).
    /// NaN without adhesive, like the depths.
    pub wp_m: f64,
    /// WP of a slab of the same total volume that has not penetrated, t / sqrt(12), m.
    pub slab_wp_m: f64,
    /// Effective penetration EP: volume over bond area (of the tilted plane, if depths are measured from one), m.
    pub ep_m: f64,
    /// Depth of the deepest voxel or material point, m.
    pub max_depth_m: f64,
    /// Depth above which 95 % of the volume lies, m.
    pub p95_depth_m: f64,
    /// Depth above which 99 % of the volume lies, m.
    pub p99_depth_m: f64,
    /// Volume of adhesive, m3.
    pub volume_m3: f64,
    /// Number of adhesive voxels; in a run, of material points.
    pub voxels: u64,
    /// Volume of the adhesive beyond the bond surface of the adherend over that of all adhesive, of both sides. NaN where
    /// there are no such surfaces.
    pub entered_share: f64,
    /// Mean depth of that adhesive below the surface, weighted by volume, m. NaN if none has entered.
    pub mean_depth_m: f64,
}

/// Penetration of the bottom, the top and in total.
///
/// Voxels count at their centres; a centre on the plane between the sides counts half to each. The square of the total WP
/// is the volume-weighted mean of the squares of the sides.
pub fn penetration(state: &State, datum: &Datum) -> [Penetration; 3] {
    // Millions of voxels or points are visited again rather than listed.
    let each = |visit: &mut dyn FnMut(Side, f64, f64)| {
        state.for_each_parcel(|point, volume| {
            let (side, depth) = datum.depth(point, state.voxel_m);
            visit(side, depth, volume);
        });
    };
    let mut sums = [SideSum::NONE; 3];
    each(&mut |on, depth, volume| {
        for (sum, side) in sums.iter_mut().zip(Side::ALL) {
            sum.add(side.share(on), depth, volume);
        }
    });
    let entered = entered(state);
    let area = state.area_m2() * datum.slant();
    let [.., total] = sums;
    std::array::from_fn(|i| {
        let (side, sum) = (Side::ALL[i], sums[i]);
        let depths = |visit: &mut dyn FnMut(f64, f64)| {
            each(&mut |on, depth, volume| {
                let share = side.share(on);
                if share > 0.0 {
                    visit(depth, share * volume);
                }
            });
        };
        let [p95_depth_m, p99_depth_m] = quantiles(sum.deepest, sum.volume, depths, [0.95, 0.99]);
        Penetration {
            side,
            plane_m: datum.plane_m(side),
            wp_m: (sum.squares / sum.volume).sqrt(),
            slab_wp_m: total.volume / area / 12_f64.sqrt(),
            ep_m: sum.volume / area,
            max_depth_m: sum.deepest,
            p95_depth_m,
            p99_depth_m,
            volume_m3: sum.volume,
            voxels: sum.voxels.round() as u64,
            entered_share: entered[i][0] / total.volume,
            mean_depth_m: entered[i][1] / entered[i][0],
        }
    })
}

/// Volume (m3) of the adhesive beyond the bond surface of each side and of both, and its integral of depth below the surface
/// (m4). NaN where no surfaces are found.
fn entered(state: &State) -> [[f64; 2]; 3] {
    let Ok(surfaces) = Datum::find(Reference::Adherend, state) else {
        return [[f64::NAN; 2]; 3];
    };
    let mut sums = [[0.0; 2]; 3];
    state.for_each_parcel(|point, volume| {
        let (on, depth) = surfaces.depth(point, state.voxel_m);
        if depth > 0.0 {
            for (sum, side) in sums.iter_mut().zip(Side::ALL) {
                sum[0] += side.share(on) * volume;
                sum[1] += side.share(on) * volume * depth;
            }
        }
    });
    sums
}

/// Sums over the voxels or points of a side.
#[derive(Clone, Copy)]
struct SideSum {
    volume: f64,
    squares: f64,
    voxels: f64,
    /// NaN without parcels.
    deepest: f64,
}

impl SideSum {
    const NONE: Self = Self {
        volume: 0.0,
        squares: 0.0,
        voxels: 0.0,
        deepest: f64::NAN,
    };

    fn add(&mut self, share: f64, depth: f64, volume: f64) {
        if share == 0.0 {
            return;
        }
        let volume = share * volume;
        self.volume += volume;
        self.squares += volume * depth * depth;
        self.voxels += share;
        self.deepest = self.deepest.max(depth);
    }
}
