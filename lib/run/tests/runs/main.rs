//! Runs of a small scene by the library, and what they keep, continue and replace in their folder.

mod bench;
mod replaced;
mod stopped;
