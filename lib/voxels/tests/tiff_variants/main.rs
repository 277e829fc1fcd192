//! Every TIFF variant of docs/tiff.md, made here, gives the stored labels exactly.

#[path = "../common/mod.rs"]
mod common;
mod descriptions;
mod layouts;
mod samples;
mod sets;

use common::*;

fn check(what: &str, bytes: &[u8], labels: [&str; 3]) {
    let (_folder, path) = stored("a.tif", bytes);
    assert_test_volume(what, &path, labels);
}
