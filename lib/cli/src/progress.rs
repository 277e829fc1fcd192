//! How far long work has come.

use std::io::IsTerminal;
use std::time::{Duration, Instant};

use indicatif::{ProgressBar, ProgressStyle};

use crate::message;

/// Progress of long work: a bar with the remaining time on a terminal, else a plain line on
/// standard error every 30 s.
pub struct Progress {
    bar: Option<ProgressBar>,
    what: String,
    started: Instant,
    last_line: Instant,
}

const LINE_EVERY: Duration = Duration::from_secs(30);
const RESOLUTION: u64 = 10_000;

impl Progress {
    /// Progress of `what`, e.g. "closing the bond line".
    pub fn new(what: &str) -> Self {
        let on_terminal = std::io::stderr().is_terminal() && !message::quiet();
        let bar = on_terminal.then(|| {
            let style =
                ProgressStyle::with_template("{prefix} [{wide_bar}] {percent}% {msg} ETA {eta}")
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
        }
    }

    /// Reports that `fraction` (0 to 1) is done; `state` is a few words on where the work is.
    pub fn update(&mut self, fraction: f64, state: impl FnOnce() -> String) {
        let fraction = fraction.clamp(0.0, 1.0);
        if let Some(bar) = &self.bar {
            bar.set_position((fraction * RESOLUTION as f64) as u64);
            bar.set_message(state());
        } else if self.last_line.elapsed() >= LINE_EVERY && !message::quiet() {
            self.last_line = Instant::now();
            let elapsed = self.started.elapsed().as_secs_f64();
            let left = if fraction > 0.0 {
                format!("{:.0} s left", elapsed * (1.0 - fraction) / fraction)
            } else {
                "time left unknown".to_owned()
            };
            message::say(format_args!(
                "{}: {:.1} %, {}, {left}",
                self.what,
                100.0 * fraction,
                state()
            ));
        }
    }

    /// Removes the bar.
    pub fn finish(self) {
        if let Some(bar) = self.bar {
            bar.finish_and_clear();
        }
    }
}
