//! How a tool ends: exit statuses and sentences.

use std::fmt;
use std::io;
use std::process::ExitCode;

use crate::message;

/// Exit statuses of every tool (docs/verdicts.md).
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Status {
    /// The run failed: unstable, particle lost, output could not be written, memory ran out.
    Failed = 1,
    /// Usage or case-file error.
    Usage = 2,
    /// Unreadable or corrupt data file, or one that does not fit into memory.
    Data = 3,
    /// Stopped early and resumable.
    Resumable = 75,
}

/// Why a tool ends without success: an exit status and one sentence; none where the reader of our standard output
/// went away, which is no error: the tool ends quietly.
#[derive(Debug)]
pub struct Failure(Option<(Status, String)>);

impl Failure {
    /// A failure with `status`; `message` is one sentence without the tool's name.
    pub fn new(status: Status, message: impl fmt::Display) -> Self {
        Self(Some((status, message.to_string())))
    }

    /// The run failed (exit 1).
    pub fn failed(message: impl fmt::Display) -> Self {
        Self::new(Status::Failed, message)
    }

    /// Usage or case-file error (exit 2).
    pub fn usage(message: impl fmt::Display) -> Self {
        Self::new(Status::Usage, message)
    }

    /// Unreadable, corrupt or too large data (exit 3).
    pub fn data(message: impl fmt::Display) -> Self {
        Self::new(Status::Data, message)
    }

    /// Of input that other arguments or another case would help (exit 2), or that is itself at fault (exit 3).
    pub fn of_input(is_usage: bool, message: impl fmt::Display) -> Self {
        match is_usage {
            true => Self::usage(message),
            false => Self::data(message),
        }
    }

    /// A failed write to `target`: a closed pipe is a quiet end, all else exit 1.
    pub fn write(target: impl fmt::Display, error: &io::Error) -> Self {
        match error.kind() {
            io::ErrorKind::BrokenPipe => Self(None),
            _ => Self::failed(format!("cannot write {target}: {error}")),
        }
    }

    /// Prints the sentence to standard error and gives the exit code.
    pub(crate) fn report(self, tool: &str) -> ExitCode {
        match self.0 {
            None => ExitCode::SUCCESS,
            Some((status, sentence)) => {
                message::say(format_args!("{tool}: {sentence}"));
                ExitCode::from(status as u8)
            }
        }
    }
}
