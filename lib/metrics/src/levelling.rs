//! Levelling of a tilted specimen.

use bondline::Specimen;
use particle_file::{BitGrid, BitsRef};
use units::Axis;

use crate::{State, Tilt, fit};

/// A specimen turned so that its bond plane is level.
pub struct LevelledSpecimen {
    /// Tilt of its bond plane before.
    pub tilt: Tilt,
    /// The wood in the new box.
    pub wood: BitGrid,
    /// The adhesive there.
    pub adhesive: BitGrid,
}

/// Turns `specimen` about its middle until the plane of [`crate::Reference::Fit`] is level across `normal`. Each new voxel
/// takes the material at its centre; the new box is small enough to lie within the specimen.
///
/// # Errors
/// A sentence: no bond line, a plane that is not known well enough, or a specimen too thin to be turned so far.
pub fn level(specimen: &Specimen, normal: Axis) -> Result<LevelledSpecimen, String> {
    let wood = specimen.wood();
    let line =
        bondline::find_bond_line(specimen, normal).map_err(|error| error.what().to_owned())?;
    let middle = wood.origin_m[normal.index()] + line.middle() * wood.voxel_m;
    let plane = fit::plane(&State::of_specimen(specimen, normal), middle)?;
    if let Some(doubt) = &plane.doubt {
        return Err(doubt.clone());
    }
    let turn = turn_to(normal, plane.up());
    let tilt = plane.tilt();
    let old = wood.bits.dims();
    let new = std::array::from_fn(|i| {
        let cut: f64 = (0..3)
            .filter(|&j| j != i)
            .map(|j| turn[i][j].abs() * old[j] as f64)
            .sum();
        // Allow for rounding if the plane is level already.
        (old[i] as f64 - cut + 1e-6).max(0.0) as usize
    });
    if new.contains(&0) {
        return Err(format!(
            "its bond plane is {tilt}, and levelling leaves nothing of its {} x {} x {} voxels",
            old[0], old[1], old[2]
        ));
    }
    let turned = |bits: BitsRef| {
        BitGrid::from_fn(new, |x, y, z| {
            let index = [x, y, z];
            let from: [f64; 3] =
                std::array::from_fn(|j| index[j] as f64 + 0.5 - 0.5 * new[j] as f64);
            let [x, y, z] = std::array::from_fn(|i| {
                let place: f64 = (0..3).map(|j| turn[i][j] * from[j]).sum();
                ((place + 0.5 * old[i] as f64) as usize).min(old[i] - 1)
            });
            bits.get(x, y, z)
        })
    };
    Ok(LevelledSpecimen {
        tilt,
        wood: turned(wood.bits),
        adhesive: turned(specimen.adhesive().bits),
    })
}

/// The rotation about a line in the level plane that takes the unit vector n of `normal` to `up` = u:
/// 1 - (n + u)(n + u)'/(1 + n.u) + 2 u n'.
fn turn_to(normal: Axis, up: [f64; 3]) -> [[f64; 3]; 3] {
    let n = normal.index();
    let unit = |i: usize| f64::from(u8::from(i == n));
    let along = 1.0 + up[n];
    std::array::from_fn(|i| {
        std::array::from_fn(|j| {
            let same = f64::from(u8::from(i == j));
            let sum = [i, j].map(|a| unit(a) + up[a]);
            same - sum[0] * sum[1] / along + 2.0 * up[i] * unit(j)
        })
    })
}
