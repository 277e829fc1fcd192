//! How far long work has come, and how long it may yet take.

use std::cmp::Ordering;
use std::collections::VecDeque;
use std::io::IsTerminal;
use std::time::{Duration, Instant};

use indicatif::{ProgressBar, ProgressStyle};

use crate::message;

/// Progress of long work: a bar on a terminal, else a plain line on standard error every 30 s.
pub struct Progress {
    bar: Option<ProgressBar>,
    what: String,
    started: Instant,
    last_line: Instant,
    pace: Pace,
}

const LINE_EVERY: Duration = Duration::from_secs(30);
const RESOLUTION: u64 = 10_000;

impl Progress {
    /// Progress of `what`, e.g. "closing the bond line".
    pub fn new(what: &str) -> Self {
        let on_terminal = std::io::stderr().is_terminal() && !message::quiet();
        let bar = on_terminal.then(|| {
            let style = ProgressStyle::with_template("{prefix} [{wide_bar}]\n{wide_msg}")
                .unwrap_or_else(|_| ProgressStyle::default_bar());
            ProgressBar::new(RESOLUTION)
                .with_style(style)
                .with_prefix(message::harmless(what).into_owned())
        });
        let now = Instant::now();
        Self {
            bar,
            what: what.to_owned(),
            started: now,
            last_line: now,
            pace: Pace::default(),
        }
    }

    /// Reports how far the work is: of each end that it may come to what is said of it, in which `{}` stands for the time
    /// left at the present pace, and the part of the way there that is done (0 to 1). Of several the last one comes at
    /// the latest. `state` is a few words on where the work is.
    pub fn update(&mut self, ends: &[(&str, f64)], state: impl FnOnce() -> String) {
        let done: Vec<f64> = ends.iter().map(|(_, done)| done.clamp(0.0, 1.0)).collect();
        let now_s = self.started.elapsed().as_secs_f64();
        self.pace.observe(now_s, &done);
        let said = |pace: &Pace| format!("{}: {}", state(), said(ends, &pace.left_s(now_s, &done)));
        if let Some(bar) = &self.bar {
            let most = done.iter().copied().fold(0.0, f64::max);
            bar.set_position((most * RESOLUTION as f64) as u64);
            bar.set_message(said(&self.pace));
        } else if self.last_line.elapsed() >= LINE_EVERY && !message::quiet() {
            self.last_line = Instant::now();
            message::say(format_args!("{}: {}", self.what, said(&self.pace)));
        }
    }

    /// Removes the bar.
    pub fn finish(self) {
        if let Some(bar) = self.bar {
            bar.finish_and_clear();
        }
    }
}

/// The pace of the last minutes: work that goes on from a checkpoint, or slows down, has no other.
#[derive(Default)]
struct Pace {
    /// Times (s) and what was done by then of the way to each end.
    samples: VecDeque<(f64, Vec<f64>)>,
}

impl Pace {
    const APART: f64 = 5.0;
    const KEPT: usize = 24;

    fn observe(&mut self, now_s: f64, done: &[f64]) {
        if (self.samples.back()).is_none_or(|(last_s, _)| now_s - last_s >= Self::APART) {
            self.samples.push_back((now_s, done.to_owned()));
        }
        if self.samples.len() > Self::KEPT {
            self.samples.pop_front();
        }
    }

    /// Time left to each end, s; infinite to one that does not come nearer. Not a number unless the paces of both halves of
    /// the samples agree within a factor of two.
    fn left_s(&self, now_s: f64, done: &[f64]) -> Vec<f64> {
        let left = |end: usize| {
            let (first, middle) = (
                self.samples.front()?,
                self.samples.get(self.samples.len() / 2)?,
            );
            let [to, half, from] = [
                (now_s, done),
                (middle.0, &middle.1[..]),
                (first.0, &first.1[..]),
            ];
            let pace = |a: (f64, &[f64]), b: (f64, &[f64])| (b.1[end] - a.1[end]) / (b.0 - a.0);
            let (early, late) = (pace(from, half), pace(half, to));
            let left_s = match pace(from, to) {
                pace if pace > 0.0 => (1.0 - done[end]) / pace,
                _ => f64::INFINITY,
            };
            (late <= 2.0 * early && early <= 2.0 * late).then_some(left_s)
        };
        let ends = 0..done.len();
        ends.map(|end| left(end).unwrap_or(f64::NAN)).collect()
    }
}

/// What is said of the ends that come before the last, and of that.
fn said(ends: &[(&str, f64)], left_s: &[f64]) -> String {
    let latest = left_s.last().copied().unwrap_or(f64::NAN);
    let said: Vec<String> = (ends.iter().zip(left_s))
        .filter(|(_, left)| left.partial_cmp(&&latest) != Some(Ordering::Greater))
        .map(|((what, done), left)| {
            let what = match left.is_nan() {
                true => what.split(", {}").next().unwrap_or_default().to_owned(),
                false => what.replace("{}", &duration(*left)),
            };
            format!("{:.1} % {what}", 100.0 * done)
        })
        .collect();
    said.join("; ")
}

/// A time (s) to the digits that are worth telling.
pub fn duration(s: f64) -> String {
    const MINUTE: f64 = 60.0;
    const HOUR: f64 = 3600.0;
    const DAY: f64 = 24.0 * HOUR;
    match s {
        s if s < 10.0 => format!("{s:.1} s"),
        s if s < 2.0 * MINUTE => format!("{s:.0} s"),
        s if s < 2.0 * HOUR => format!("{:.0} min", s / MINUTE),
        s if s < 2.0 * DAY => format!("{:.1} h", s / HOUR),
        s if s.is_finite() => format!("{:.1} days", s / DAY),
        _ => "an unknown time".into(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const CLOSING: &str = "closed, {} left at least";
    const LIMIT: &str = "of the time limit, {} left at most";

    /// A clamp that closes all the slower the nearer it is (the 288, 232 and 171 s left of a run at minutes 8, 17 and 25) and
    /// has closed after 50 minutes of at most 100: the end lies between what is said at any time.
    #[test]
    fn the_end_of_a_closing_that_slows_down_lies_between_the_times_said() {
        const END: f64 = 3000.0;
        let mut pace = Pace::default();
        for s in 0..3000 {
            let now_s = f64::from(s);
            let done = [(1.0 - (1.0 - now_s / END).powi(3)), now_s / (2.0 * END)];
            pace.observe(now_s, &done);
            let left = pace.left_s(now_s, &done);
            let end = END - now_s;
            // Nothing is said before a second sample, nor near the end of a closing that slows down ever more.
            let said = left.iter().filter(|left| !left.is_nan()).count();
            assert!(said == 2 || !(10..=2850).contains(&s), "{now_s}: {left:?}");
            let within = !(left[0] > end || left[1] < end);
            assert!(within, "{now_s}: {left:?}");
        }
    }

    #[test]
    fn a_closing_that_stalls_leaves_the_time_limit() {
        let ends = [(CLOSING, 0.25), (LIMIT, 0.5)];
        let limit = "50.0 % of the time limit, 3.0 h left at most";
        let both = format!("25.0 % closed, 3 min left at least; {limit}");
        assert_eq!(said(&ends, &[180.0, 3.0 * 3600.0]), both);
        for stalled in [4.0 * 3600.0, f64::INFINITY] {
            assert_eq!(said(&ends, &[stalled, 3.0 * 3600.0]), limit);
        }
        let text = said(&ends, &[f64::NAN; 2]);
        assert_eq!(text, "25.0 % closed; 50.0 % of the time limit");
    }

    /// Of work that goes on; the pace of steps that grow as the run goes on would make days of the minute that is left.
    #[test]
    fn time_is_told_by_an_even_pace_alone() {
        let [mut even, mut faster] = [Pace::default(), Pace::default()];
        for s in 1..400 {
            let now_s = f64::from(s);
            let left = |pace: &mut Pace, done: f64| {
                pace.observe(now_s, &[done]);
                pace.left_s(now_s, &[done])[0]
            };
            let even = left(&mut even, 0.5 + 1e-3 * now_s);
            assert!(
                s <= 6 || (even - (500.0 - now_s)).abs() < 1e-6,
                "{s}: {even}"
            );
            assert!(
                s >= 60 || left(&mut faster, f64::from(s - 60).exp2()).is_nan(),
                "{s}"
            );
        }
        assert_eq!(even.samples.len(), Pace::KEPT);
    }
}
