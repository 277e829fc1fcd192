//! Thickness and place of the adhesive slab.

use crate::Error;

/// Thickness, in whole cells, of a slab with the volume of `adhesive` voxels over `area` columns.
pub(crate) fn cells(
    adhesive: f64,
    area: u64,
    voxels_per_cell: usize,
    tolerance: f64,
    cell_m: f64,
) -> Result<u64, Error> {
    let layers = adhesive / area as f64;
    let rounded = |per_cell: usize| {
        let exact = layers / per_cell as f64;
        (exact.round(), exact.round() / exact - 1.0)
    };
    let fits = |(cells, rounding): (f64, f64)| cells >= 1.0 && rounding.abs() <= tolerance;
    let exact_cells = layers / voxels_per_cell as f64;
    let (cells, rounding) = rounded(voxels_per_cell);
    if !fits((cells, rounding)) {
        let um = 1e6 * cell_m;
        let fewer = (1..voxels_per_cell).rev().find(|n| fits(rounded(*n)));
        let more = (cells >= 1.0).then(|| (1e3 * rounding.abs()).ceil() / 10.0);
        let thinner = exact_cells.floor().max(1.0);
        let ways = (fewer.map(|n| format!("--voxels-per-cell {n}")).into_iter())
            .chain(more.map(|percent| format!("--tolerance {percent}%")))
            .chain([format!(
                "for undamaged wood --slab '{:.3} um' or '{:.3} um'",
                thinner * um,
                (thinner + 1.0) * um
            )]);
        return Err(Error::new(format!(
            "the adhesive would be a slab of {exact_cells:.4} cells of {um:.3} um; rounding to {cells} changes its volume by {:+.2} %, more than the tolerance of {:.2} %: give {}",
            100.0 * rounding,
            100.0 * tolerance,
            ways.collect::<Vec<_>>().join(", or ")
        )));
    }
    Ok(cells as u64)
}

/// Low face (m) of a slab of thickness `slab_m`. The slab lies in the middle of the opening at the bond plane, or further to
/// one side if the wood, `bottom` and `top` (m) away from the plane, leaves no room there.
pub(crate) fn low_face(
    plane_m: f64,
    gap_m: f64,
    slab_m: f64,
    [bottom, top]: [f64; 2],
    voxel_m: f64,
) -> Result<f64, Error> {
    let least_m = slab_m - bottom - top;
    if gap_m < least_m - 1e-9 * voxel_m || gap_m < 0.0 {
        return Err(Error::new(format!(
            "a gap of {:.3} um leaves no room for the adhesive slab of {:.3} um between the adherends: at least {:.3} um is needed",
            1e6 * gap_m,
            1e6 * slab_m,
            1e6 * least_m.max(0.0)
        )));
    }
    let lowest = plane_m - bottom;
    let highest = (plane_m + gap_m + top - slab_m).max(lowest);
    Ok((plane_m + 0.5 * (gap_m - slab_m)).clamp(lowest, highest))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_papers_slabs_are_19_and_27_cells() {
        // Paper section 3: 55.1 um for PF and 78.3 um for PVA-PF, cells of 2.9 um.
        let area = 393 * 400;
        for (thickness_um, expected) in [(55.1, 19), (78.3, 27), (54.4, 19), (77.0, 27)] {
            let adhesive = thickness_um / 1.45 * area as f64;
            assert_eq!(cells(adhesive, area, 2, 0.05, 2.9e-6), Ok(expected));
        }
    }

    #[test]
    fn rounding_beyond_the_tolerance_is_refused() {
        assert_eq!(cells(1060.0, 100, 2, 0.06, 2.0), Ok(5)); // 5.3 cells, -5.66 %
        let said = |adhesive, tolerance| {
            let error = cells(adhesive, 100, 2, tolerance, 2e-6).unwrap_err();
            error.to_string()
        };
        let ways = "--voxels-per-cell 1, or --tolerance 5.7%, or for undamaged wood --slab '10.000 um' or '12.000 um'";
        assert!(said(1060.0, 0.05).ends_with(ways));
        // No cell at all.
        assert!(
            said(90.0, 1.0).ends_with("1, or for undamaged wood --slab '2.000 um' or '4.000 um'")
        );
    }

    #[test]
    fn the_slab_stays_clear_of_the_wood() {
        // Plane at 10, slab 6 thick, wood 2 below and 1 above the plane.
        let low = |gap| low_face(10.0, gap, 6.0, [2.0, 1.0], 1.0);
        assert_eq!(low(6.0), Ok(10.0));
        assert_eq!(low(3.0), Ok(8.0), "the tightest fit touches both adherends");
        assert_eq!(low(10.0), Ok(12.0));
        assert!(low(2.9).unwrap_err().to_string().contains("no room"));
    }
}
