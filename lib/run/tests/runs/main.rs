//! Plans and runs of small scenes by the library, and what runs keep, continue and replace in their
//! folder.

mod bench;
mod fall;
mod plan;
mod replaced;
mod stopped;
