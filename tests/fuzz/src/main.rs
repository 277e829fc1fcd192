//! `make fuzz`: libFuzzer on the target that `TARGET` names.
#![no_main]

use std::sync::LazyLock;

use attack::Target;
use libfuzzer_sys::fuzz_target;

static TARGET: LazyLock<&Target> = LazyLock::new(|| {
    let name = std::env::var("TARGET").unwrap_or_default();
    Target::named(&name).unwrap_or_else(|| panic!("TARGET={name} is no target"))
});

fuzz_target!(|bytes: &[u8]| {
    (TARGET.feed)(bytes);
});
