//! From a case file to a run folder: reading and resolving the case, the time loop, and the files of a run
//! (`history.csv`, snapshots, checkpoint, `final.mpts`, `summary.json`).

mod bond_measures;
mod case;
mod changed_keys;
mod checkpoint;
mod chords;
mod clock;
mod courant;
mod crowded_liquid;
mod earlier_run;
mod end_conditions;
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
mod moved_bodies;
mod omissions;
mod on_terminal;
mod request;
mod resolve;
mod resolved;
mod schemes;
mod snapshot;
mod summary;
mod time_loop;
mod verdict;

pub use bond_measures::{BondMeasures, BySide, FilledByDepth};
pub use case::REFERENCE;
pub use changed_keys::{changed_case, value_at};
pub use courant::Courant;
pub use earlier_run::Mode;
pub use end_conditions::{End, PossibleEnd};
pub use expected_error::{ExpectedError, QuantityError};
pub use failure::RunFailure;
pub use invariants::Invariants;
pub use omissions::Remark;
pub use request::Request;
pub use summary::{PressedStage, Summary};
pub use verdict::Verdict;
