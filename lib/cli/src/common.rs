//! The options and the start of every tool.

use std::io::{self, Write};
use std::process::ExitCode;

use clap::error::ErrorKind;
use clap::{CommandFactory, Parser, ValueEnum};
use clap_complete::Shell;

use crate::{Failure, Output};
use crate::{message, signals};

/// Options every tool has.
#[derive(clap::Args, Clone, Debug)]
#[command(next_help_heading = "Common options")]
pub struct Common {
    /// Print errors and warnings only
    #[arg(short, long, global = true, conflicts_with = "verbose")]
    quiet: bool,
    /// Print details
    #[arg(short, long, global = true)]
    verbose: bool,
    /// Worker threads [default: RAYON_NUM_THREADS, then SLURM_CPUS_PER_TASK, then all cores]
    #[arg(long, global = true, value_name = "N", value_parser = clap::value_parser!(u16).range(1..=4096))]
    threads: Option<u16>,
    /// Print the man page or a shell completion script and exit
    #[arg(
        long,
        global = true,
        value_name = "WHAT",
        exclusive = true,
        ignore_case = true
    )]
    #[arg(value_parser = ["man", "bash", "zsh", "fish", "elvish", "powershell"])]
    generate: Option<String>,
}

/// Parses the command line, sets up messages and threads, runs the tool, maps its end to
/// an exit code.
pub fn main<A: Parser + CommandFactory>(
    common: fn(&A) -> &Common,
    run: fn(A) -> Result<(), Failure>,
) -> ExitCode {
    let mut command = with_exit_status(A::command());
    let tool = command.get_name().to_owned();
    if let Some(what) = requested_generation(&command) {
        return match generate(command, &what) {
            Ok(()) => ExitCode::SUCCESS,
            Err(failure) => failure.report(&tool),
        };
    }
    let parsed = command.try_get_matches_from_mut(std::env::args_os());
    let parsed = parsed.and_then(|matches| {
        A::from_arg_matches(&matches).map_err(|error| error.format(&mut command))
    });
    let arguments = match parsed {
        Ok(arguments) => arguments,
        Err(error) => return usage(&error, &tool),
    };
    signals::catch_file_limit();
    signals::catch_abort();
    let ended = setup(common(&arguments)).and_then(|()| run(arguments));
    match ended {
        Ok(()) => ExitCode::SUCCESS,
        Err(failure) => failure.report(&tool),
    }
}

/// Adds the exit status to the help of a command whose help does not have it.
fn with_exit_status(command: clap::Command) -> clap::Command {
    let own = command
        .get_after_help()
        .map_or(String::new(), |help| help.to_string());
    match own.contains("Exit status:") {
        true => command,
        false => command.after_help(format!("{own}\n\n{EXIT_STATUS}").trim_start().to_owned()),
    }
}

const EXIT_STATUS: &str = "Exit status: 0 ok; 1 cannot write; 2 usage; 3 unreadable or damaged data, or too little memory (docs/verdicts.md).";

/// `--generate WHAT` must work without the tool's required arguments, so it is looked for
/// before the real parse; a wrong WHAT is left to that parse to refuse.
fn requested_generation(command: &clap::Command) -> Option<String> {
    let words = std::env::args_os().map(|word| word.to_string_lossy().into_owned());
    let mut words = (words.skip(1)).skip_while(|word| command.find_subcommand(word).is_some());
    let what = match words.next()?.as_str() {
        "--generate" => words.next()?,
        word => word.strip_prefix("--generate=")?.to_owned(),
    };
    let known = what.eq_ignore_ascii_case(MAN) || Shell::from_str(&what, true).is_ok();
    known.then_some(what)
}

const MAN: &str = "man";

fn generate(command: clap::Command, what: &str) -> Result<(), Failure> {
    let shell = Shell::from_str(what, true);
    // Pages refer to pages; of `help` there is none.
    let mut command = command.disable_help_subcommand(shell.is_err());
    let name = command.get_name().to_owned();
    let mut text = Vec::new();
    match shell {
        Ok(shell) => clap_complete::generate(shell, &mut command, name, &mut text),
        Err(_) => {
            command.build();
            man_pages(&command, &mut text).map_err(|e| Failure::write("the man page", &e))?;
        }
    }
    Output::Stdout.write(|out| out.write_all(&text))
}

/// The page of a command, and behind it those of its subcommands, to which it refers.
fn man_pages(command: &clap::Command, out: &mut Vec<u8>) -> io::Result<()> {
    clap_mangen::Man::new(command.clone()).render(out)?;
    for subcommand in command.get_subcommands() {
        man_pages(subcommand, out)?;
    }
    Ok(())
}

fn usage(error: &clap::Error, tool: &str) -> ExitCode {
    match error.kind() {
        ErrorKind::DisplayHelp | ErrorKind::DisplayVersion => {
            match error.print().and_then(|()| io::stdout().flush()) {
                Ok(()) => ExitCode::SUCCESS,
                Err(error) => Failure::write(Output::Stdout, &error).report(tool),
            }
        }
        _ => {
            // It quotes the command line as it was given.
            message::say(error.render().to_string().trim_end());
            ExitCode::from(crate::Status::Usage as u8)
        }
    }
}

/// More threads than this per core slow a run down by orders of magnitude: every parallel
/// section waits for the last of them.
const THREADS_PER_CORE: usize = 4;

fn setup(common: &Common) -> Result<(), Failure> {
    message::set_level(match (common.quiet, common.verbose) {
        (true, _) => -1,
        (_, true) => 1,
        _ => 0,
    });
    let from_environment = |name| {
        let number = std::env::var(name).ok()?.parse::<usize>();
        number.ok().filter(|&n| n > 0)
    };
    let threads = common
        .threads
        .map(usize::from)
        .or_else(|| from_environment("RAYON_NUM_THREADS"))
        .or_else(|| from_environment("SLURM_CPUS_PER_TASK"))
        .unwrap_or(0); // rayon: all cores
    let cores = std::thread::available_parallelism().map_or(1, usize::from);
    let most = THREADS_PER_CORE * cores;
    if threads > most {
        message::warn(format!(
            "{threads} threads are too many for {cores} cores; {most} are used"
        ));
    }
    // The main thread is one of them: many small steps would otherwise wait for the pool's threads
    // to wake (a film of 96 points ran ten times longer).
    rayon::ThreadPoolBuilder::new()
        .num_threads(threads.min(most))
        .use_current_thread()
        .build_global()
        .map_err(|e| Failure::failed(format!("cannot start the worker threads: {e}")))
}
