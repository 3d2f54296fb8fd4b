//! Runs [`inpact_fuzz::read`] on whatever libFuzzer comes up with.

#![no_main]

libfuzzer_sys::fuzz_target!(|bytes: &[u8]| inpact_fuzz::read(bytes));
