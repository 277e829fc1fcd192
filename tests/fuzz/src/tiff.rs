//! `make fuzz ONLY=tiff`
#![no_main]

use attack::Target;
use libfuzzer_sys::fuzz_target;

fuzz_target!(|bytes: &[u8]| {
    Target::Tiff.feed(bytes);
});
