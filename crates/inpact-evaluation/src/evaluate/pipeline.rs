//! From kept rows to results: batches are evaluated while earlier ones are written.

use super::Evaluation;
use crate::nodes::{Batch, KeptRowsIter};
use crate::plan::Plan;
use crate::results::ResultBatch;
use crate::spread;
use std::io;

/// Batches with their results.
#[derive(Debug, Default)]
struct Window {
    batches: Vec<Batch>,
    results: Vec<ResultBatch>,
}

impl Evaluation<'_> {
    /// Evaluates all rows of a plan; `write` gets them in order, a batch at a time.
    ///
    /// # Errors
    /// Rows that cannot be read back; in the inner result, the first error of `write`, after which nothing more is written.
    pub fn run<E: Send>(
        &mut self,
        rows: &mut KeptRowsIter,
        plan: &Plan,
        mut write: impl FnMut(&Batch, &mut ResultBatch) -> Result<(), E> + Send,
    ) -> io::Result<Result<(), E>> {
        let (mut ready, mut next) = (Window::default(), Window::default());
        if spread::threads() == 1 {
            // One window, which is still in the cache when it is refilled.
            loop {
                ready.fill(self, rows, plan)?;
                let written = ready.write(&mut write);
                if written.is_err() || ready.batches.is_empty() {
                    return Ok(written);
                }
            }
        }
        loop {
            let (written, filled) = spread::join(|| ready.write(&mut write), || next.fill(self, rows, plan));
            if let Err(error) = written {
                return Ok(Err(error));
            }
            filled?;
            std::mem::swap(&mut ready, &mut next);
            if ready.batches.is_empty() {
                return Ok(Ok(()));
            }
        }
    }
}

impl Window {
    /// Writes the batches in order.
    fn write<E>(&mut self, write: &mut impl FnMut(&Batch, &mut ResultBatch) -> Result<(), E>) -> Result<(), E> {
        let mut each = self.batches.iter().zip(&mut self.results);
        each.try_for_each(|(batch, results)| write(batch, results))
    }

    /// Evaluates the next batches.
    fn fill(&mut self, evaluation: &mut Evaluation<'_>, rows: &mut KeptRowsIter, plan: &Plan) -> io::Result<()> {
        self.batches.clear();
        while self.batches.len() < evaluation.batches_at_a_time() {
            let Some(mut batch) = rows.next_batch()? else { break };
            plan.name_rows(&mut batch);
            self.batches.push(batch);
        }
        self.results.resize_with(self.batches.len(), ResultBatch::default);
        evaluation.evaluate_all(&self.batches, &mut self.results);
        Ok(())
    }
}
