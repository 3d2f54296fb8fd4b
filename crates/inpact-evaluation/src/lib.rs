//! Evaluates the interface laws of a deck on node data: conductance and current, heat, pore fluid flow.
//!
//! From the inside out: [`numbers`] are floating-point building blocks, [`table`] the nested piecewise-linear functions of the manual's tables,
//! [`law`] the interface laws as functions of plain inputs, [`history`] their integrals over time.
//! None of these knows a file or the parser's model.

pub mod numbers;

pub mod table;

pub mod law;

pub mod history;
