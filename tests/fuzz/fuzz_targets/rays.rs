//! See `gsdf_tests::fuzzed::rays`.
#![no_main]

libfuzzer_sys::fuzz_target!(|bytes: &[u8]| {
    let _tally = gsdf_tests::fuzzed::rays(bytes);
});
