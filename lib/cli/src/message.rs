use std::fmt::Display;
use std::sync::atomic::{AtomicI8, Ordering};

/// -1 quiet, 0 normal, 1 and more verbose. A statement about the process, set once.
static LEVEL: AtomicI8 = AtomicI8::new(0);

pub(crate) fn set_level(level: i8) {
    LEVEL.store(level, Ordering::Relaxed);
}

pub(crate) fn quiet() -> bool {
    LEVEL.load(Ordering::Relaxed) < 0
}

/// A line on standard error unless `--quiet`.
pub fn note(message: impl Display) {
    if !quiet() {
        eprintln!("{message}");
    }
}

/// A line on standard error with `--verbose`.
pub fn detail(message: impl Display) {
    if LEVEL.load(Ordering::Relaxed) > 0 {
        eprintln!("{message}");
    }
}

/// A warning on standard error, also with `--quiet`.
pub fn warn(message: impl Display) {
    eprintln!("warning: {message}");
}
