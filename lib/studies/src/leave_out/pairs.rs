//! CPU times of two programs, run in turn.

use std::process::Command;

/// CPU seconds of both, run next to each other.
pub(super) struct Pairs(Vec<[f64; 2]>);

/// Runs both, A B B A A B ..., `count` times each after one run of each that does not count.
///
/// # Errors
/// What a run said.
pub(super) fn measure(commands: [Command; 2], count: usize) -> Result<Pairs, String> {
    for command in &commands {
        cpu_seconds(command)?;
    }
    let mut pairs = Vec::with_capacity(count);
    for i in 0..count {
        let order = if i % 2 == 0 { [0, 1] } else { [1, 0] };
        let mut pair = [0.0; 2];
        for which in order {
            pair[which] = cpu_seconds(&commands[which])?;
        }
        pairs.push(pair);
    }
    Ok(Pairs(pairs))
}

/// User and system time (s) of a run, to the millisecond as bash reports it.
pub(super) fn cpu_seconds(command: &Command) -> Result<f64, String> {
    let program = command.get_program();
    let output = Command::new("bash")
        .args(["-c", "TIMEFORMAT='%3U %3S'; time \"$@\"", "time"])
        .arg(program)
        .args(command.get_args())
        .output()
        .map_err(|e| format!("bash cannot be started: {e}"))?;
    let said = String::from_utf8_lossy(&output.stderr);
    let times: Vec<f64> = (said.lines().last().unwrap_or("").split(' '))
        .filter_map(|word| word.parse().ok())
        .collect();
    match times.as_slice() {
        [user, system] if output.status.success() => Ok(user + system),
        _ => Err(format!("{}: {said}", program.display())),
    }
}

impl Pairs {
    /// Lower quartile, median and upper quartile of first over second, pair by pair.
    pub(super) fn quartiles(&self) -> [f64; 3] {
        let ratios = self.0.iter().map(|[a, b]| a / b).collect();
        quantiles(ratios, [0.25, 0.5, 0.75])
    }

    /// Median CPU time of each, s.
    pub(super) fn seconds(&self) -> [f64; 2] {
        [0, 1].map(|which| {
            let list = self.0.iter().map(|pair| pair[which]).collect();
            quantiles(list, [0.5])[0]
        })
    }
}

/// Quantiles, linear between the entries; NaN of none.
fn quantiles<const N: usize>(mut list: Vec<f64>, parts: [f64; N]) -> [f64; N] {
    list.sort_by(f64::total_cmp);
    parts.map(|part| {
        let Some(last) = list.len().checked_sub(1) else {
            return f64::NAN;
        };
        let at = part * last as f64;
        let low = at.floor() as usize;
        list[low] + (at - low as f64) * (list[(low + 1).min(last)] - list[low])
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn quartiles_of_ratios() {
        let pairs = [[1.0, 2.0], [4.0, 2.0], [3.0, 3.0], [2.0, 1.6], [3.0, 4.0]];
        let pairs = Pairs(pairs.into());
        assert_eq!(pairs.quartiles(), [0.75, 1.0, 1.25]);
        assert_eq!(pairs.seconds(), [3.0, 2.0]);
    }
}
