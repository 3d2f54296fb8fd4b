//! Prints what a result file holds, a line a value: `frame,time,field,column,row,value`.
//! `cargo run -p inpact-results --example columns -- FILE`

use inpact_results::{Frame, Results, Rows};
use std::io::{self, BufWriter, Write};
use std::process::ExitCode;

fn frame(out: &mut impl Write, at: usize, frame: &Frame) -> io::Result<()> {
    let time = frame.total_time.or(frame.step_time).map_or(String::new(), |time| format!("{time:?}"));
    for field in &frame.fields {
        for column in &field.columns {
            for (row, value) in column.values.iter().enumerate() {
                let label = match &field.rows {
                    Rows::Nodes(labels) | Rows::Elements(labels) => labels[row].to_string(),
                    Rows::FacePoints { elements, faces } => format!("{}.S{}", elements[row], faces[row]),
                    Rows::Whole => String::new(),
                };
                writeln!(out, "{at},{time},{},{},{label},{value:?}", field.name, column.name)?;
            }
        }
    }
    Ok(())
}

fn all(results: &Results) -> io::Result<()> {
    let mut out = BufWriter::new(io::stdout().lock());
    for (at, of) in results.frames.iter().enumerate() {
        frame(&mut out, at, of)?;
    }
    out.flush()
}

#[expect(clippy::print_stderr, reason = "a program tells its problems so")]
fn main() -> ExitCode {
    let Some(path) = std::env::args_os().nth(1) else {
        eprintln!("expected a file");
        return ExitCode::from(2);
    };
    let outcome = std::fs::read(path).and_then(|bytes| match inpact_results::read(&bytes) {
        Ok(results) => all(&results).map(|()| None),
        Err(error) => {
            let message = error.to_string();
            error.into_read().as_ref().map_or(Ok(()), all).map(|()| Some(message))
        }
    });
    match outcome {
        Ok(None) => ExitCode::SUCCESS,
        Ok(Some(message)) => {
            eprintln!("{message}");
            ExitCode::from(1)
        }
        Err(error) => {
            eprintln!("{error}");
            ExitCode::from(2)
        }
    }
}
