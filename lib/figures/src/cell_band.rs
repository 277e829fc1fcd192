//! The band of a pressure: what two sizes of cells say of it.

/// What two sizes of cells say of the pressure at a time.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Reach {
    pub(crate) time: f64,
    /// Pa
    pub(crate) low: f64,
    pub(crate) high: f64,
    /// Whether that is no wider than the pressure of the run.
    pub(crate) converged: bool,
}

/// What a run in cells half as large says of the pressure of another: the pressures in both sizes, and in cells of no
/// size by first order +- the difference, as in `wp-metrics --finer`, which reaches from the finer to a pressure `beyond`
/// it that is cut at zero and at the limit. Both are taken at equal travel of their clamps (`ways`), while that goes on,
/// and stand at the times of the coarser run.
pub(crate) fn band(
    ways: [&[f64]; 2],
    times: &[f64],
    pressures: [&[f64]; 2],
    limit: f64,
) -> Vec<Reach> {
    let mut places = [onwards(ways[0]), onwards(ways[1])].concat();
    places.sort_by(f64::total_cmp);
    places.dedup();
    let reach = |place: f64| {
        let time = at(place, ways[0], times)?;
        let own = at(place, ways[0], pressures[0])?;
        let fine = at(place, ways[1], pressures[1])?;
        let beyond = (3.0 * fine - 2.0 * own).max(0.0).min(limit);
        let low = own.min(fine).min(beyond);
        let high = own.max(fine).max(beyond);
        let reach = Reach {
            time,
            low,
            high,
            converged: high - low <= own.abs(),
        };
        let numbers = [time, low, high];
        numbers.iter().all(|x| x.is_finite()).then_some(reach)
    };
    places.into_iter().filter_map(reach).collect()
}

/// The places of a way at which it goes on.
fn onwards(way: &[f64]) -> Vec<f64> {
    let mut farthest = f64::NEG_INFINITY;
    let mut places = way.to_vec();
    places.retain(|&s| {
        let goes_on = s > farthest;
        farthest = farthest.max(s);
        goes_on
    });
    places
}

/// A band in parts that have converged throughout, or not; one begins where the other ends.
pub(crate) fn parts(band: &[Reach]) -> Vec<&[Reach]> {
    let mut parts = Vec::new();
    let mut first = 0;
    for i in 1..band.len() {
        let settled = |i: usize| band[i - 1].converged && band[i].converged;
        if i + 1 == band.len() || settled(i) != settled(i + 1) {
            parts.push(&band[first..=i]);
            first = i;
        }
    }
    parts
}

/// `y` where `x` first comes to a value between its first row and its last.
fn at(value: f64, x: &[f64], y: &[f64]) -> Option<f64> {
    let after = x.iter().position(|&x| x >= value)?;
    if x[after] == value {
        return Some(y[after]);
    }
    let before = after.checked_sub(1)?;
    let part = (value - x[before]) / (x[after] - x[before]);
    Some(y[before] + part * (y[after] - y[before]))
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Frictionless presses were once drawn as 0.63 beside a band of 1.78 +- 0.57, at the start below zero.
    #[test]
    fn a_band_holds_both_sizes_and_is_cut_at_zero_and_at_the_limit() {
        let way = [0.0, 1.0, 2.0, 3.0];
        let (coarse, fine) = ([0.2, 0.63, 2.4, 2.5], [0.1, 1.2, 2.5, 2.5]);
        let band = band([&way, &way], &way, [&coarse, &fine], 2.5);
        let ends: Vec<[f64; 2]> = band.iter().map(|at| [at.low, at.high]).collect();
        assert_eq!(ends[0], [0.0, 0.2]);
        assert!(
            ends[1][0] == 0.63 && (ends[1][1] - 2.34).abs() < 1e-12,
            "{ends:?}"
        );
        assert_eq!(ends[2..], [[2.4, 2.5], [2.5, 2.5]]);
        let converged: Vec<bool> = band.iter().map(|at| at.converged).collect();
        assert_eq!(converged, [true, false, true, true]);
        let parts = parts(&band);
        assert_eq!(
            parts.iter().map(|part| part.len()).collect::<Vec<_>>(),
            [3, 2]
        );
    }
}
