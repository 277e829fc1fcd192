//! Plans and runs of small scenes by the library, and how runs keep, continue and replace the files in their folder.

mod bench;
mod bond;
mod checkpoint_format;
mod fall;
mod penetration;
mod periodic;
mod permissions;
mod plan;
mod press;
mod refused;
mod replaced;
mod resolved;
mod stopped;
