//! The band of a pressure: what two sizes of cells say of it.

use std::path::Path;

use particle_file::{ParticleFile, states_of_run};

use crate::{Error, Labelled};

/// By what factor the cells of the finer run are smaller, and a hair for the rounding of lengths written as text.
const RATIO: f64 = 2.0;
const HAIR: f64 = 1e-6;

/// Refuses a finer run whose cells are not half as large; of histories outside the folders of runs that is not known.
///
/// # Errors
/// [`Error::Request`] for other cells.
pub(crate) fn check(run: &Labelled, finer: &Labelled) -> Result<(), Error> {
    let (Some(cell), Some(half)) = (cell_m(&run.path), cell_m(&finer.path)) else {
        return Ok(());
    };
    match (cell / half / RATIO - 1.0).abs() <= HAIR {
        true => Ok(()),
        false => Err(Error::Request(format!(
            "'{}' has cells of {:.4} um and '{}' of {:.4} um: a finer run is the same run with cells half as large",
            run.path.display(),
            1e6 * cell,
            finer.path.display(),
            1e6 * half
        ))),
    }
}

/// Edge of the cells of the run whose folder a history lies in, m.
fn cell_m(history: &Path) -> Option<f64> {
    let states = states_of_run(history.parent()?).ok()?;
    let state = ParticleFile::open(states.first()?).ok()?;
    state.header().attribute("cell_m")?.parse().ok()
}

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
        let finite = [time, low, high].iter().all(|x| x.is_finite());
        finite.then_some(Reach {
            time,
            low,
            high,
            converged: high - low <= own.abs(),
        })
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
    use particle_file::{Draft, Header, Kind};

    use super::*;

    /// The run itself as its own finer one was once a band of no width.
    #[test]
    fn a_finer_run_has_cells_half_as_large() {
        let folder = tempfile::tempdir().unwrap();
        let run = |name: &str, cell: &str| {
            let path = folder.path().join(name);
            std::fs::create_dir(&path).unwrap();
            let mut header = Header::new(Kind::State, 1.0, 1, [0.0; 3], [1.0; 3]);
            header.set_attribute("cell_m", cell);
            let mut bytes = Vec::new();
            Draft::new(header).write_to(&mut bytes).unwrap();
            std::fs::write(path.join("final.mpts"), bytes).unwrap();
            let (label, path) = (name.to_owned(), path.join("history.csv"));
            Labelled { label, path }
        };
        let [coarse, fine] = [run("coarse", "2.9e-6"), run("fine", "1.4500000001e-6")];
        assert!(check(&coarse, &fine).is_ok());
        for other in [&coarse, &run("other", "2e-6")] {
            let said = check(&coarse, other).unwrap_err().to_string();
            assert!(said.contains("cells half as large"), "{said}");
        }
        let path = folder.path().join("history.csv");
        let elsewhere = Labelled { path, ..fine };
        assert!(check(&coarse, &elsewhere).is_ok());
    }

    /// Frictionless presses were once drawn as 0.63 beside a band of 1.78 +- 0.57, at the start below zero.
    #[test]
    fn a_band_holds_both_sizes_and_is_cut_at_zero_and_at_the_limit() {
        let way = [0.0, 1.0, 2.0, 3.0];
        let (coarse, fine) = ([0.2, 0.63, 2.4, 2.5], [0.1, 1.2, 2.5, 2.5]);
        let band = band([&way, &way], &way, [&coarse, &fine], 2.5);
        let ends: Vec<[f64; 2]> = band.iter().map(|at| [at.low, at.high]).collect();
        assert_eq!(ends[0], [0.0, 0.2]);
        assert!((ends[1][1] - 2.34).abs() < 1e-12, "{ends:?}");
        assert_eq!(ends[1][0], 0.63);
        assert_eq!(ends[2..], [[2.4, 2.5], [2.5, 2.5]]);
        let converged: Vec<bool> = band.iter().map(|at| at.converged).collect();
        assert_eq!(converged, [true, false, true, true]);
        let parts = parts(&band).into_iter().map(<[_]>::len);
        assert_eq!(parts.collect::<Vec<_>>(), [3, 2]);
    }
}
