//! Evaluates the interface laws of a deck on node data: conductance and current, heat, pore fluid flow.
//!
//! From the inside out: [`numbers`] are floating-point building blocks, [`table`] the nested piecewise-linear functions of the manual's tables and the ways to evaluate them,
//! [`law`] the interface laws as functions of plain inputs and their integrals over time.
//! None of these knows a file or the parser's model.
//!
//! Around them: [`nodes`] reads node tables, [`plan`] puts a deck's model and a node table together, [`Evaluation`] runs a plan over batches of rows,
//! [`results`] writes the output.
//! No file is opened here: streams in, streams out.
//!
//! ```
//! use inpact_evaluation::Evaluation;
//! use inpact_evaluation::nodes::{Batch, Findings, NodeReader};
//! use inpact_evaluation::plan::{self, Choices};
//! use inpact_evaluation::results::{Output, ResultBatch};
//! use inpact_parser::{deck::scan, grammar::Grammar, model};
//!
//! let deck = b"*SURFACE INTERACTION, NAME=JOINT\n*GAP ELECTRICAL CONDUCTANCE\n4000., 0.\n0., 2.\n";
//! let nodes = "node,clearance,epot_s,epot_m\n1,0.,3.,2.\n2,1.,3.,2.\n";
//! let (model, _) = model::read(&scan("joint.inp", deck, Grammar::builtin()), Grammar::builtin());
//!
//! // Survey the columns, plan the laws they suffice for, and evaluate these.
//! let (choices, mut findings) = (Choices::default(), Findings::new("nodes.csv"));
//! let first = NodeReader::open(Box::new(nodes.as_bytes()), &mut findings)?;
//! let survey = plan::survey(first, &model, &choices, &mut findings)?.expect("a table without errors");
//! let plan = plan::make(&model, &survey, &choices);
//! let mut rows = NodeReader::open(Box::new(nodes.as_bytes()), &mut findings)?;
//! rows.select(&plan.selection);
//! let mut evaluation = Evaluation::new(&model, &plan, &choices);
//! let (mut batch, mut results) = (Batch::default(), ResultBatch::default());
//! while rows.read_batch(&mut batch, &mut findings)? {
//!     plan.name_rows(&mut batch);
//!     evaluation.evaluate(&batch, &mut results);
//!     let current = plan.outputs.iter().position(|output| *output == Output::Ecd).expect("a current");
//!     assert_eq!([0, 1].map(|row| results.numbers[current].get(row)), [Some(4000.0), Some(2000.0)]);
//! }
//! # Ok::<(), std::io::Error>(())
//! ```

#[cfg(feature = "columnar")]
pub mod arrow;

// The inner ones first.
pub mod numbers;

mod accuracy;
mod error;
mod evaluator;
mod kernel;
pub mod table;

mod history;
pub mod law;

pub mod nodes;
pub mod results;

pub mod plan;

mod rows;

mod evaluate;
mod spread;

pub use accuracy::{Accuracy, Tolerance, Wanted};
pub use error::{Error, ErrorKind, TableFault};
pub use evaluate::{Coordinates, Evaluation, TableReads, TabulatedQuantity};
pub use history::HistoryStart;
pub use rows::{AxisTally, InteractionTally, RemarkedRows, Tally, Totals, UserFaultInRow};
