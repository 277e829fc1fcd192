//! Facts of the operating system on this process: how much memory it will still give it, and which files it may
//! replace.
//!
//! Nothing is known on systems without `/proc`: there every size is tried.

mod control_group;
mod memory;
mod process;
mod replaced;
mod shortage;

pub use memory::available_bytes;
pub use process::{cpu_seconds, give_back_large_arrays, ignores, peak_memory_bytes};
pub use replaced::replaced_permissions;
pub use shortage::{Shortage, bytes, shortage};
