//! Weighted and effective penetration.

use std::fmt;

use rayon::prelude::*;

use crate::quantile::by_value;
use crate::{Adhesive, Datum, State, Weighted};

/// One side of the bond line, or both.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
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

    /// The side of a signed height above the bond line.
    pub fn of(height: f64) -> Side {
        if height < 0.0 {
            Side::Bottom
        } else {
            Side::Top
        }
    }

    /// Whether this includes `side`.
    pub fn includes(self, side: Side) -> bool {
        self == Side::Total || self == side
    }
}

impl fmt::Display for Side {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Side::Bottom => "bottom",
            Side::Top => "top",
            Side::Total => "total",
        })
    }
}

/// How far adhesive went into one side of a bond line.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Penetration {
    /// Which side.
    pub side: Side,
    /// What depths are measured from, m along the normal.
    pub plane_m: f64,
    /// Weighted penetration WP = sqrt(sum V Y^2 / sum V), m (paper Eq. 6; Paris & Kamke 2015).
    /// NaN without adhesive, as the depths are.
    pub wp_m: f64,
    /// WP of a slab of the same total volume that has not penetrated, t / sqrt(12), m.
    pub slab_wp_m: f64,
    /// Effective penetration EP: volume over bond area, m.
    pub ep_m: f64,
    /// Depth of the deepest voxel or material point, m.
    pub max_depth_m: f64,
    /// Depth that 95 % of the volume does not exceed, m.
    pub p95_depth_m: f64,
    /// Depth that 99 % of the volume does not exceed, m.
    pub p99_depth_m: f64,
    /// Volume of adhesive, m3.
    pub volume_m3: f64,
    /// Voxels of adhesive; in a run its material points, each of which began as one voxel.
    pub voxels: u64,
}

/// Penetration of the bottom, the top and in total.
///
/// Voxels count at their centres. The square of the total WP is the volume-weighted mean of
/// the squares of the sides.
pub fn penetration(state: &State, datum: &Datum) -> [Penetration; 3] {
    let samples = samples(state, datum);
    let area = state.area_m2();
    let total: f64 = samples.iter().map(|s| s.volume).sum();
    let pair = |s: &Sample| ((s.depth, s.volume), s.side);
    let mut sorted: Vec<((f64, f64), Side)> = samples.iter().map(pair).collect();
    sorted.par_sort_unstable_by(|a, b| by_value(&a.0, &b.0));
    Side::ALL.map(|side| {
        let of_side = || samples.iter().filter(|s| side.includes(s.side));
        // The sum of nothing is -0.
        let volume = of_side().map(|s| s.volume).sum::<f64>() + 0.0;
        let squares: f64 = of_side().map(|s| s.volume * s.depth * s.depth).sum();
        let depths = sorted.iter().filter(|(_, s)| side.includes(*s));
        let depths = Weighted::of_sorted(depths.map(|(pair, _)| *pair).collect());
        let [p95_depth_m, p99_depth_m] = depths.quantiles([0.95, 0.99]);
        Penetration {
            side,
            plane_m: datum.plane_m(side),
            wp_m: (squares / volume).sqrt(),
            slab_wp_m: total / area / 12_f64.sqrt(),
            ep_m: volume / area,
            max_depth_m: depths.max(),
            p95_depth_m,
            p99_depth_m,
            volume_m3: volume,
            voxels: of_side().map(|s| s.voxels).sum(),
        }
    })
}

/// Adhesive at one depth.
struct Sample {
    side: Side,
    depth: f64,
    volume: f64,
    voxels: u64,
}

fn samples(state: &State, datum: &Datum) -> Vec<Sample> {
    let sample = |(side, depth), volume, voxels| Sample {
        side,
        depth,
        volume,
        voxels,
    };
    let mut samples = Vec::new();
    match (state.adhesive, datum) {
        // All voxels of a layer have the same depth.
        (Adhesive::Voxels(voxels), Datum::Level { normal, .. }) => {
            let n = normal.index();
            let volume = voxels.voxel_m.powi(3);
            for (layer, count) in voxels.bits.counts_along(n).into_iter().enumerate() {
                let centre = voxels.origin_m[n] + (layer as f64 + 0.5) * voxels.voxel_m;
                if count > 0 {
                    let depth = datum.depth_of_level(centre);
                    samples.push(sample(depth, count as f64 * volume, count));
                }
            }
        }
        _ => state.for_each_parcel(|point, volume| {
            samples.push(sample(datum.depth(point), volume, 1));
        }),
    }
    samples
}
