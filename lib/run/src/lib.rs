//! From a case file to a run folder: reading and resolving the case, the time loop, and what
//! a run writes (`history.csv`, snapshots, checkpoint, `final.mpts`, `summary.json`).

mod answers;
pub mod case;
mod changes;
mod checkpoint;
mod chords;
mod conclude;
mod courant;
mod crowding;
mod depth;
mod drive;
mod earlier_run;
mod ends;
mod expected_error;
mod explain;
mod files;
mod folder;
mod history;
mod invariants;
mod left_out;
mod load;
mod mark;
mod request;
mod resolve;
mod resolved;
mod schemes;
mod snapshot;
mod summary;
mod verdict;

pub use answers::{Answers, FilledByDepth, Sides};
pub use changes::changed_case;
pub use courant::Courant;
pub use earlier_run::Mode;
pub use ends::{Ahead, End};
pub use expected_error::{ExpectedError, QuantityError};
pub use invariants::Invariants;
pub use left_out::LeftOut;
pub use request::{Request, RunFailure};
pub use summary::{PressedStage, Stage, Summary};
pub use verdict::Verdict;
