//! A conductance by a user's routine with its places in a batch.

use crate::law::user::{UserLaw, UserNames};
use crate::nodes::{Column, Part, Selection, coordinates};
use crate::plan::{Source, UserPlan};

/// The routine, and where a row has what it is called with.
#[derive(Debug, Clone)]
pub(crate) struct CompiledUser {
    pub(crate) law: UserLaw,
    pub(crate) names: UserNames,
    pub(crate) clearance: usize,
    pub(crate) temperatures: Source<usize>,
    pub(crate) field_variables: Vec<Source<usize>>,
    pub(crate) time: Option<usize>,
    pub(crate) step_time: Option<usize>,
    pub(crate) step: Option<usize>,
    pub(crate) increment: Option<usize>,
    /// Slave and master; where there is none the coordinate is 0.
    pub(crate) coordinates: [[Option<usize>; 3]; 2],
    /// Among the labels.
    pub(crate) node: Option<usize>,
}

impl CompiledUser {
    pub(super) fn new(plan: &UserPlan, selection: &Selection, law: &UserLaw) -> Option<Self> {
        let place = |column: Column| selection.number(column);
        // The plan reads every column it names.
        let source = |source: &Source<Column>| source.map(|column| place(column).unwrap_or_default());
        let planned = |column: Column| place(column).filter(|_| plan.others.contains(&column));
        Some(Self {
            law: law.clone(),
            names: plan.names.clone(),
            clearance: place(Column::Clearance)?,
            temperatures: source(&plan.temperatures),
            field_variables: plan.field_variables.iter().map(source).collect(),
            time: planned(Column::Time),
            step_time: planned(Column::StepTime),
            step: planned(Column::Step),
            increment: planned(Column::Increment),
            coordinates: [Part::Slave, Part::Master].map(|part| coordinates(part).map(planned)),
            node: selection.label(Column::Node),
        })
    }
}
