//! Runs [`inpact_fuzz::scan_and_print`] on whatever libFuzzer comes up with.

#![no_main]

libfuzzer_sys::fuzz_target!(|bytes: &[u8]| inpact_fuzz::scan_and_print(bytes));
