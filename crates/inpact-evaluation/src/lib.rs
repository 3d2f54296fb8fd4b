//! Evaluates the interface laws of a deck on node data: conductance and current, heat, pore fluid flow.
//!
//! From the inside out: [`numbers`] are floating-point building blocks, [`table`] the nested piecewise-linear functions of the manual's tables,
//! [`accuracy`] how exactly they are evaluated, [`evaluator`] a table with what was chosen for it,
//! [`law`] the interface laws as functions of plain inputs, [`history`] their integrals over time.
//! [`kernel`] evaluates tables over whole columns, vectorised, with the bits of the functions above.
//! None of these knows a file or the parser's model.
//!
//! Around them: [`nodes`] reads node tables, [`plan`] puts a deck's model and a node table together,
//! [`evaluate`] runs a plan over batches of rows, [`results`] writes what comes out.
//! No file is opened here: streams in, streams out.

pub mod numbers;

pub mod table;

pub mod evaluator;

pub mod accuracy;

pub mod law;

pub mod kernel;

pub mod history;

pub mod nodes;

pub mod results;

pub mod plan;

pub mod evaluate;

mod spread;
