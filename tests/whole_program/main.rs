//! Runs the program as a user would: exit codes, standard streams, every format, every sample deck.

mod check;
mod configuration;
mod decks;
mod dialects;
mod eval;
mod eval_laws;
mod eval_modes;
mod eval_tables;
mod eval_user;
mod eval_wrong;
mod fix;
mod fmt;
mod formats;
mod includes;
mod json;
mod plan;
mod program;
mod solve;
mod solve_ccx;
mod solve_nonlinear;
mod solve_published;
mod solve_transient;
mod solve_wrong;
mod tradeoff;
mod tradeoff_scene;
mod write;
