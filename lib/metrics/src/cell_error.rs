//! Discretisation error, from the same run with smaller cells.

use crate::Penetration;

/// A result extrapolated to zero cell size.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Extrapolated {
    /// Extrapolated value.
    pub value: f64,
    /// Error bound: the difference between the results of the two cell sizes.
    pub error: f64,
}

/// Penetration of one side extrapolated to zero cell size, m.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CellError {
    /// Weighted penetration.
    pub wp_m: Extrapolated,
    /// Effective penetration.
    pub ep_m: Extrapolated,
}

/// Least ratio of the two cell sizes; below it the difference does not bound the remaining error.
pub const LEAST_RATIO: f64 = 2.0;

/// Richardson extrapolation from results with cells of two sizes, the coarse ones `ratio` times larger.
///
/// Two sizes do not show the order of convergence. It is taken as 1; at a ratio of 2, value +- error then reaches from the
/// finer result to twice the difference beyond it. This is half of Roache's grid convergence index for two sizes, whose
/// safety factor of 3 reaches to both sides (J. Fluids Eng. 116, 1994, 405-413). The bound holds for orders above 0.6.
/// For ratios of 2 or more the value is no further from the finer result than that is from the coarser.
pub fn extrapolated(coarse: f64, fine: f64, ratio: f64) -> Extrapolated {
    Extrapolated {
        value: fine + (fine - coarse) / (ratio - 1.0),
        error: (fine - coarse).abs(),
    }
}

/// Extrapolates bottom, top and total from a coarse state and one with cells `ratio` times smaller. The error of a side is at
/// least the mean of both sides: agreement of the two cell sizes on one side alone is chance. The error of the total WP is at
/// least that of the mean of two sides with independent errors: their cancellation in the total is chance too.
pub fn cell_error(
    coarse: &[Penetration; 3],
    fine: &[Penetration; 3],
    ratio: f64,
) -> [CellError; 3] {
    let mut found = std::array::from_fn(|side| {
        let (coarse, fine) = (&coarse[side], &fine[side]);
        CellError {
            wp_m: extrapolated(coarse.wp_m, fine.wp_m, ratio),
            ep_m: extrapolated(coarse.ep_m, fine.ep_m, ratio),
        }
    });
    let [bottom, top, total] = &mut found;
    for [bottom, top] in [
        [&mut bottom.wp_m, &mut top.wp_m],
        [&mut bottom.ep_m, &mut top.ep_m],
    ] {
        let mean = 0.5 * (bottom.error + top.error);
        (bottom.error, top.error) = (bottom.error.max(mean), top.error.max(mean));
    }
    let both = 0.5 * bottom.wp_m.error.hypot(top.wp_m.error);
    total.wp_m.error = total.wp_m.error.max(both);
    found
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Side;

    fn of_wp(wp_m: f64) -> Penetration {
        Penetration {
            side: Side::Total,
            plane_m: 0.0,
            wp_m,
            slab_wp_m: 0.0,
            ep_m: 0.0,
            max_depth_m: 0.0,
            p95_depth_m: 0.0,
            p99_depth_m: 0.0,
            volume_m3: 0.0,
            voxels: 0,
            entered_share: 0.0,
            mean_depth_m: 0.0,
        }
    }

    /// Errors of 0.4 and -0.4 um on the sides cancel in the total, whose error is still 0.28. Errors of 0.4 and 0 make at least
    /// 0.2 on both sides, and half of their diagonal in the total. A side without adhesive does not count.
    #[test]
    fn errors_that_cancel_or_vanish_by_chance_are_told() {
        for (coarse, wanted) in [
            ([6.4, 7.6, 7.0], [0.4, 0.4, 0.4 / 2_f64.sqrt()]),
            ([6.4, 8.4, 7.4], [0.4, 0.4, 0.4]),
            ([6.4, 8.0, 7.2], [0.4, 0.2, 0.5 * 0.4_f64.hypot(0.2)]),
            ([6.4, f64::NAN, 7.2], [0.4, f64::NAN, 0.2]),
        ] {
            let found = cell_error(&coarse.map(of_wp), &[6.0, 8.0, 7.0].map(of_wp), 2.0);
            for (found, wanted) in found.map(|side| side.wp_m.error).into_iter().zip(wanted) {
                let same = (found - wanted).abs() < 1e-12 || wanted.is_nan() && found.is_nan();
                assert!(same, "{found} {wanted}");
            }
        }
    }

    /// f(h) = 7 + h^p, known at h = 2 and 1.
    #[test]
    fn the_error_holds_from_order_0_6_on() {
        for order in [0.6, 0.73, 1.0, 1.5, 2.0, 4.0] {
            let found = extrapolated(7.0 + 2_f64.powf(order), 8.0, 2.0);
            let off = (found.value - 7.0).abs();
            println!("order {order}: off by {off:.3}, said {:.3}", found.error);
            assert!(off <= found.error, "{order}: {off} of {}", found.error);
        }
        assert_eq!(extrapolated(9.0, 8.0, 2.0).value, 7.0);
        assert_eq!(extrapolated(9.0, 8.0, 3.0).value, 7.5);
        // Lower orders cannot be detected with two sizes.
        let slow = extrapolated(7.0 + 2_f64.powf(0.4), 8.0, 2.0);
        assert!((slow.value - 7.0).abs() > slow.error);
    }
}
