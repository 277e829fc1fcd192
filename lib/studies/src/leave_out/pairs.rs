//! CPU times of two builds, run in turn.

use std::path::Path;
use std::process::Command;

/// CPU seconds of the full build and of the one without the feature, run next to each other.
#[derive(Clone, Debug)]
pub struct Pairs(pub Vec<[f64; 2]>);

/// Runs both builds of `mpm-run` on `case` in `folder`, A B B A A B ..., `count` times each after
/// one run of each that does not count.
///
/// # Errors
/// What a run said.
pub fn measure(
    programs: [&Path; 2],
    case: &Path,
    folder: &Path,
    count: usize,
) -> Result<Pairs, String> {
    for program in programs {
        cpu_seconds(program, case, folder)?;
    }
    let mut pairs = Vec::with_capacity(count);
    for i in 0..count {
        let order = if i % 2 == 0 { [0, 1] } else { [1, 0] };
        let mut pair = [0.0; 2];
        for which in order {
            pair[which] = cpu_seconds(programs[which], case, folder)?;
        }
        pairs.push(pair);
    }
    Ok(Pairs(pairs))
}

/// User and system time (s) of a run on one thread, to the millisecond as bash reports it; what
/// `mpm-run` itself knows is in hundredths.
fn cpu_seconds(program: &Path, case: &Path, folder: &Path) -> Result<f64, String> {
    let output = Command::new("bash")
        .args(["-c", "TIMEFORMAT='%3U %3S'; time \"$@\"", "time"])
        .arg(program)
        .arg(case)
        .args(["--threads", "1", "--quiet", "--overwrite", "-o"])
        .arg(folder)
        .output()
        .map_err(|e| format!("bash cannot be started: {e}"))?;
    let said = String::from_utf8_lossy(&output.stderr);
    let times: Vec<f64> = (said.lines().last().unwrap_or("").split(' '))
        .filter_map(|word| word.parse().ok())
        .collect();
    match times.as_slice() {
        [user, system] if output.status.success() => Ok(user + system),
        _ => Err(format!("{} {}: {said}", program.display(), case.display())),
    }
}

impl Pairs {
    /// Ratio full over without, pair by pair, in rising order.
    pub fn ratios(&self) -> Vec<f64> {
        let mut list: Vec<f64> = self.0.iter().map(|[full, less]| full / less).collect();
        list.sort_by(f64::total_cmp);
        list
    }

    /// Lower quartile, median and upper quartile of the ratios.
    pub fn quartiles(&self) -> [f64; 3] {
        let list = self.ratios();
        [0.25, 0.5, 0.75].map(|part| quantile(&list, part))
    }

    /// Ratio of the fastest runs of each.
    pub fn of_fastest(&self) -> f64 {
        let least = |which: usize| {
            self.0
                .iter()
                .map(|pair| pair[which])
                .fold(f64::INFINITY, f64::min)
        };
        least(0) / least(1)
    }

    /// Median CPU time of the full build, s.
    pub fn seconds(&self) -> f64 {
        let mut list: Vec<f64> = self.0.iter().map(|pair| pair[0]).collect();
        list.sort_by(f64::total_cmp);
        quantile(&list, 0.5)
    }
}

/// Quantile of a list in rising order, linear between its entries; NaN of none.
fn quantile(list: &[f64], part: f64) -> f64 {
    let Some(last) = list.len().checked_sub(1) else {
        return f64::NAN;
    };
    let at = part * last as f64;
    let low = at.floor() as usize;
    let high = (low + 1).min(last);
    list[low] + (at - low as f64) * (list[high] - list[low])
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn quartiles_and_fastest() {
        let pairs = Pairs(vec![
            [1.0, 2.0],
            [4.0, 2.0],
            [3.0, 3.0],
            [2.0, 1.6],
            [3.0, 4.0],
        ]);
        assert_eq!(pairs.quartiles(), [0.75, 1.0, 1.25]);
        assert_eq!(pairs.of_fastest(), 1.0 / 1.6);
        assert_eq!(pairs.seconds(), 3.0);
    }
}
