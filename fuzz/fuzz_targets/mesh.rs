//! Runs [`inpact_fuzz::mesh`] on whatever libFuzzer comes up with.

#![no_main]

libfuzzer_sys::fuzz_target!(|bytes: &[u8]| inpact_fuzz::mesh(bytes));
