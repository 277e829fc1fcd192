//! Plans and runs of small scenes by the library, and what runs keep, continue and replace in their
//! folder.

mod answers;
mod bench;
mod bond;
mod checkpoint_format;
mod fall;
mod periodic;
mod permissions;
mod plan;
mod press;
mod refused;
mod replaced;
mod resolved;
mod stopped;
