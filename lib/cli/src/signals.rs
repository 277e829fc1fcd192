use std::sync::Arc;
use std::sync::OnceLock;
use std::sync::atomic::{AtomicBool, Ordering};

use signal_hook::consts::{SIGINT, SIGTERM};

use crate::Failure;

static FLAG: OnceLock<Arc<AtomicBool>> = OnceLock::new();

/// From now on SIGINT and SIGTERM only set the flag that [`interrupted`] reads; a second
/// SIGINT, a user's second Ctrl-C, ends the process at once. Not so a second SIGTERM: GNU
/// `timeout` and batch systems send one to the process and one to its group.
///
/// # Errors
/// Exit 1 when the system refuses the handler.
pub fn catch_interrupts() -> Result<(), Failure> {
    let flag = FLAG.get_or_init(|| Arc::new(AtomicBool::new(false)));
    let caught = signal_hook::flag::register_conditional_shutdown(SIGINT, 75, Arc::clone(flag))
        .and_then(|_| signal_hook::flag::register(SIGINT, Arc::clone(flag)))
        .and_then(|_| signal_hook::flag::register(SIGTERM, Arc::clone(flag)));
    caught
        .map(|_| ())
        .map_err(|e| Failure::failed(format!("cannot catch interrupts: {e}")))
}

/// Whether the user asked the run to stop.
pub fn interrupted() -> bool {
    FLAG.get().is_some_and(|flag| flag.load(Ordering::Relaxed))
}
