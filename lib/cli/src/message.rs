//! The one place that writes for people to the terminal. No message is worth a run: a standard
//! error that fails (a full disk, a closed terminal) is passed over in silence.

use std::borrow::Cow;
use std::fmt::Display;
use std::io::{self, Write};
use std::sync::atomic::{AtomicI8, Ordering};

use crate::{Failure, Output};

/// -1 quiet, 0 normal, 1 and more verbose. A statement about the process, set once.
static LEVEL: AtomicI8 = AtomicI8::new(0);

pub(crate) fn set_level(level: i8) {
    LEVEL.store(level, Ordering::Relaxed);
}

pub(crate) fn quiet() -> bool {
    LEVEL.load(Ordering::Relaxed) < 0
}

/// A line on standard error whatever the level.
pub(crate) fn say(message: impl Display) {
    let line = format!("{}\n", harmless(&message.to_string()));
    let _ = io::stderr().lock().write_all(line.as_bytes());
}

/// A line on standard error unless `--quiet`.
pub fn note(message: impl Display) {
    if !quiet() {
        say(message);
    }
}

/// A line on standard error with `--verbose`.
pub fn detail(message: impl Display) {
    if LEVEL.load(Ordering::Relaxed) > 0 {
        say(message);
    }
}

/// A warning on standard error, also with `--quiet`.
pub fn warn(message: impl Display) {
    say(format_args!("warning: {message}"));
}

/// Text for people on standard output, made harmless as messages are; data go through
/// [`Output::write`], which changes nothing.
pub fn print(text: &str) -> Result<(), Failure> {
    Output::Stdout.write(|out| out.write_all(harmless(text).as_bytes()))
}

/// `text` with every control character but tab and the end of a line, and every mark that reorders
/// text, written as an escape (`\u{1b}`): names come from files, and must not steer the terminal.
pub fn harmless(text: &str) -> Cow<'_, str> {
    let steers = |c: char| {
        (c.is_control() && !matches!(c, '\n' | '\t'))
            || matches!(c, '\u{202a}'..='\u{202e}' | '\u{2066}'..='\u{2069}')
    };
    if !text.contains(steers) {
        return text.into();
    }
    let mut plain = String::with_capacity(text.len() + 16);
    text.chars().for_each(|c| match steers(c) {
        true => plain.extend(c.escape_unicode()),
        false => plain.push(c),
    });
    plain.into()
}

/// A name as a cell of a CSV table. One that a spreadsheet would take for a formula, because it
/// begins with `=`, `+`, `-` or `@`, stands behind an apostrophe, and so does one that begins
/// with an apostrophe: without the first apostrophe it is the name again. `-` alone, standard
/// input, is no formula. Control characters are written as in messages.
pub fn cell(name: &str) -> Cow<'_, str> {
    match name != "-" && name.starts_with(['=', '+', '-', '@', '\'', '\t']) {
        true => format!("'{}", harmless(name)).into(),
        false => harmless(name),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn no_name_is_a_formula_and_every_name_comes_back() {
        for name in ["=1+1", "+a", "-a", "@a", "'a", "a=b", "µ", ""] {
            let cell = cell(name);
            assert_eq!(cell.strip_prefix('\'').unwrap_or(&cell), name);
            assert!(!cell.starts_with(['=', '+', '-', '@']));
        }
        assert_eq!(cell("-"), "-");
    }

    #[test]
    fn what_steers_a_terminal_is_written_as_an_escape() {
        assert_eq!(harmless("µ 'a b'\nc"), "µ 'a b'\nc");
        let steers = "\x1b[2Jx\r\u{202e}\x07\u{9b}";
        assert_eq!(harmless(steers), r"\u{1b}[2Jx\u{d}\u{202e}\u{7}\u{9b}");
    }
}
