//! Whole-program tests of inpact; see the files beside this one.
