//! Signals that end a run at its next step.

use std::io;
use std::sync::Arc;
use std::sync::OnceLock;
use std::sync::atomic::{AtomicBool, Ordering};
use std::time::Duration;

use signal_hook::consts::{SIGABRT, SIGHUP, SIGINT, SIGTERM, SIGUSR1, SIGUSR2, SIGXCPU, SIGXFSZ};
use signal_hook::iterator::Signals;

use crate::{Failure, Status, message};

static FLAG: OnceLock<Arc<AtomicBool>> = OnceLock::new();

/// Time between a signal and the end of a process that does not end by itself: an answer
/// within 5 s is promised.
const GRACE: Duration = Duration::from_secs(4);

/// Signals that batch systems and a closed terminal send before the end. Of them those that the process was begun to
/// ignore, as by `nohup`, stay ignored.
const WARNINGS: [i32; 4] = [SIGHUP, SIGUSR1, SIGUSR2, SIGXCPU];

/// From now on SIGINT, SIGTERM and the [`WARNINGS`] set the flag that [`interrupted`] reads. A process that has
/// not ended [`GRACE`] later, because it is in the middle of something long, is ended with exit
/// 75; what it writes must be whole or absent at any moment. A second SIGINT, a user's second
/// Ctrl-C, ends it at once. Not so a second of the others: GNU `timeout` and batch systems send one
/// to the process and one to its group.
///
/// Before this call, as in tools that never make it, a signal ends the process at once.
pub fn catch_interrupts() -> Result<(), Failure> {
    let warnings = WARNINGS
        .into_iter()
        .filter(|&signal| !machine::ignores(signal));
    let signals: Vec<i32> = [SIGINT, SIGTERM].into_iter().chain(warnings).collect();
    catch(&signals).map_err(|e| Failure::failed(format!("cannot catch interrupts: {e}")))
}

fn catch(signals: &[i32]) -> io::Result<()> {
    let flag = FLAG.get_or_init(|| Arc::new(AtomicBool::new(false)));
    let end_now = i32::from(Status::Resumable as u8);
    signal_hook::flag::register_conditional_shutdown(SIGINT, end_now, Arc::clone(flag))?;
    for &signal in signals {
        signal_hook::flag::register(signal, Arc::clone(flag))?;
    }
    let signals = Signals::new(signals)?;
    let thread = std::thread::Builder::new().name("signals".into());
    thread.spawn(move || end_after_grace(signals)).map(|_| ())
}

/// From now on a write beyond the limit on the size of files fails as one to a full disk does, with a
/// sentence and nothing left behind, where the signal would end the process in the middle of it.
pub(crate) fn catch_file_limit() {
    // Where the system refuses the handler, the signal does what it did.
    let _ = signal_hook::flag::register(SIGXFSZ, Arc::new(AtomicBool::new(false)));
}

/// From now on an allocation that fails, which has said so and aborts, ends the process with exit 1 and no
/// core file. What is known to be large is refused before it is begun (`machine::shortage`); this is
/// for what is not foreseen.
pub(crate) fn catch_abort() {
    let always = Arc::new(AtomicBool::new(true));
    let failed = i32::from(Status::Failed as u8);
    // Where the system refuses the handler, the signal does what it did.
    let _ = signal_hook::flag::register_conditional_shutdown(SIGABRT, failed, always);
}

fn end_after_grace(mut signals: Signals) {
    if signals.forever().next().is_none() {
        return;
    }
    std::thread::sleep(GRACE);
    message::say(format_args!(
        "stopped early, in the middle of a step that takes longer than {} s; continue with \
         --resume from the last checkpoint, or from the start where there is none yet",
        GRACE.as_secs()
    ));
    std::process::exit(i32::from(Status::Resumable as u8));
}

/// Whether the user asked the run to stop.
pub fn interrupted() -> bool {
    FLAG.get().is_some_and(|flag| flag.load(Ordering::Relaxed))
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::process::Command;
    use std::time::Instant;

    const CHILD: &str = "BONDLINE_TEST_LONG_STEP";

    #[test]
    fn a_long_step_does_not_outlive_the_grace() {
        if std::env::var_os(CHILD).is_some() {
            catch_interrupts().unwrap();
            Command::new("kill")
                .arg(std::process::id().to_string())
                .status()
                .unwrap();
            std::thread::sleep(Duration::from_secs(60));
            std::process::exit(0);
        }
        let begun = Instant::now();
        let name = "signals::tests::a_long_step_does_not_outlive_the_grace";
        let ended = Command::new(std::env::current_exe().unwrap())
            .args([name, "--exact", "--nocapture"])
            .env(CHILD, "yes")
            .output()
            .unwrap();
        assert_eq!(ended.status.code(), Some(75));
        let said = String::from_utf8_lossy(&ended.stderr);
        assert!(said.contains("continue with --resume"), "{said}");
        assert!(begun.elapsed() < Duration::from_secs(30));
    }
}
