//! From a case file to a run folder: reading and resolving the case, the time loop, and what
//! a run writes (`history.csv`, snapshots, checkpoint, `final.mpts`, `summary.json`).

mod bond_measures;
mod case;
mod changes;
mod checkpoint;
mod chords;
mod clock;
mod courant;
mod crowded_liquid;
mod depth;
mod earlier_run;
mod ends;
mod expected_error;
mod explain;
mod failure;
mod files;
mod folder;
mod folder_mark;
mod forecast;
mod history;
mod invariants;
mod last_state;
mod left_out;
mod on_terminal;
mod request;
mod resolve;
mod resolved;
mod schemes;
mod snapshot;
mod summary;
mod time_loop;
mod verdict;

pub use bond_measures::{Answers, FilledByDepth, Sides};
pub use case::REFERENCE;
pub use changes::{changed_case, value_at};
pub use courant::Courant;
pub use earlier_run::Mode;
pub use ends::{Ahead, End};
pub use expected_error::{ExpectedError, QuantityError};
pub use failure::RunFailure;
pub use invariants::Invariants;
pub use left_out::Remark;
pub use request::Request;
pub use summary::{PressedStage, Summary};
pub use verdict::Verdict;
