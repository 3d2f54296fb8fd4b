//! The plan as readable text.

use super::{
    AxisPlan, Bulk, CharacteristicLength, ColumnPlan, ColumnRole, CurrentHeat, ElectricalPlan, FormPlan, GovernedBy,
    InteractionPlan, Plan, PorePlan, Rate, SlipRateSource, TablePlan, ThermalPlan,
};
use crate::accuracy::{Tolerance, Wanted};
use crate::nodes::Column;
use crate::results::{number_text as number, rounded_up};
use crate::table::Tail;
use inpact_diagnostics::column_width;
use inpact_parser::grammar::Dialect;
use std::fmt::{self, Formatter};

impl fmt::Display for Plan {
    fn fmt(&self, formatter: &mut Formatter<'_>) -> fmt::Result {
        let governed_by = match self.governed_by {
            GovernedBy::Chosen(_) => "the interaction chosen governs every row",
            GovernedBy::TheOnlyOne(_) => "the only interaction of the deck governs every row",
            GovernedBy::Column => "column `interaction` says which interaction governs a row",
        };
        writeln!(formatter, "{}; {governed_by}", count(self.rows, "row"))?;
        for interaction in &self.interactions {
            writeln!(formatter)?;
            write_interaction(interaction, formatter)?;
        }
        if !self.unused.is_empty() {
            let names: Vec<&str> = self.unused.iter().map(inpact_parser::model::Name::written).collect();
            writeln!(formatter, "\nnot used, no row names them: {}", names.join(", "))?;
        }
        writeln!(formatter, "\ncolumns of the node table")?;
        let width = column_width(self.columns.iter().map(|column| column.header.as_str()));
        for column in &self.columns {
            write_column(column, width, formatter)?;
        }
        let keys = self.keys().iter().map(ToString::to_string);
        let outputs: Vec<String> = keys.chain(self.outputs.iter().map(ToString::to_string)).collect();
        let outputs = if outputs.is_empty() { "none".to_owned() } else { outputs.join(" ") };
        writeln!(formatter, "\ncolumns of the result\n  {outputs}\n")?;
        write!(formatter, "{}", self.outline())
    }
}

fn write_interaction(plan: &InteractionPlan, formatter: &mut Formatter<'_>) -> fmt::Result {
    write!(formatter, "{}: {}, {} closed, {} open", plan.name, count(plan.rows, "row"), plan.closed, plan.open)?;
    if let Some(histories) = plan.histories {
        write!(formatter, "; {} with a history", count(histories, "node"))?;
    }
    writeln!(formatter)?;
    if let Some(law) = &plan.electrical {
        write_electrical(law, formatter)?;
    }
    if let Some(law) = &plan.thermal {
        write_thermal(law, formatter)?;
    }
    if let Some(law) = &plan.pore {
        write_pore(law, formatter)?;
    }
    if !plan.outputs.is_empty() {
        let outputs: Vec<String> = plan.outputs.iter().map(ToString::to_string).collect();
        writeln!(formatter, "  gives {}", outputs.join(" "))?;
    }
    for left_out in &plan.left_out {
        writeln!(formatter, "  without {}: {}", left_out.what, left_out.reason)?;
    }
    for note in &plan.notes {
        writeln!(formatter, "  note: {note}")?;
    }
    Ok(())
}

fn write_electrical(law: &ElectricalPlan, formatter: &mut Formatter<'_>) -> fmt::Result {
    writeln!(formatter, "  electrical law, {}", law.regime)?;
    for table in &law.tables {
        write_table("conductance", table, formatter)?;
    }
    if let Some(user) = &law.user {
        let names = &user.names;
        let [interaction, slave, master] =
            [names.interaction, names.slave, names.master].map(|name| name.text().into_owned());
        writeln!(
            formatter,
            "    conductance by user subroutine GAPELECTR, without contact pressure (it has no such argument)"
        )?;
        writeln!(
            formatter,
            "      NPRED = {}, CINAME = `{interaction}`, SLNAME = `{slave}`, MSNAME = `{master}`",
            user.field_variables.len()
        )?;
    }
    if let Some(heat) = law.heat {
        let (fraction, weight) = (number(heat.fraction), number(heat.slave_weight));
        writeln!(formatter, "    heat: fraction {fraction}, slave weight {weight}")?;
    }
    Ok(())
}

fn write_thermal(law: &ThermalPlan, formatter: &mut Formatter<'_>) -> fmt::Result {
    writeln!(formatter, "  thermal law")?;
    if let Some(conduction) = &law.conduction {
        let is_calculix = conduction.dialect == Dialect::Calculix;
        if is_calculix {
            writeln!(
                formatter,
                "    conduction as in CalculiX: closed only, between two curves over the pressures both have"
            )?;
        }
        for table in &conduction.tables {
            write_table("thermal conductance", table, formatter)?;
        }
    }
    if let Some(radiation) = &law.radiation {
        let (coefficient, zero) = (number(radiation.coefficient), number(radiation.absolute_zero));
        writeln!(formatter, "    radiation: {coefficient} per fourth power of temperature above {zero}")?;
        write_table("view factor", &radiation.table, formatter)?;
    }
    match law.friction.map(|friction| friction.slip_rate) {
        Some(SlipRateSource::Column) => writeln!(formatter, "    friction: `shear` × `slip_rate`")?,
        Some(SlipRateSource::Given(speed)) => {
            writeln!(formatter, "    friction: `shear` × {}, the speed of the deck", number(speed))?;
        }
        None => {}
    }
    let generates = law.friction.is_some() || law.current == CurrentHeat::Generated;
    if let Some(heat) = law.heat.filter(|_| generates) {
        let (fraction, weight) = (number(heat.fraction), number(heat.slave_weight));
        writeln!(formatter, "    heat: fraction {fraction}, slave weight {weight}")?;
    }
    Ok(())
}

fn write_pore(law: &PorePlan, formatter: &mut Formatter<'_>) -> fmt::Result {
    writeln!(formatter, "  pore fluid law, {}", law.regime)?;
    match &law.table {
        Some(table) => write_table("permeability", table, formatter)?,
        None => writeln!(formatter, "    infinite permeability: equal pore pressures within the cutoff")?,
    }
    let length = match law.characteristic_length {
        CharacteristicLength::Given(length) => number(length),
        CharacteristicLength::Column => "`char_length`".to_owned(),
        CharacteristicLength::Unknown => "the characteristic element length, which is not known".to_owned(),
        CharacteristicLength::NotNeeded => "the characteristic element length, which is not needed".to_owned(),
    };
    let cutoff = |cutoff: Option<f64>| cutoff.map_or_else(|| length.clone(), number);
    writeln!(formatter, "    cutoff of flow across: {}", cutoff(law.cutoffs.flow_across))?;
    if law.rate == Rate::NotNeeded {
        return writeln!(formatter, "    no gap filling in steady state");
    }
    writeln!(formatter, "    cutoff of gap filling: {}", cutoff(law.cutoffs.gap_fill))?;
    let rate = match law.rate {
        Rate::Column => "rate of the clearance from `clearance_rate`",
        Rate::History => "rate of the clearance from each node's history",
        Rate::Unknown | Rate::NotNeeded => "the clearance is taken as unchanging",
    };
    let shares = match law.bulk {
        Bulk::Columns => "shared as `perm_s` to `perm_m`",
        Bulk::Halves => "half to either side",
    };
    writeln!(formatter, "    gap filling: {rate}; {shares}")
}

fn write_table(what: &str, table: &TablePlan, formatter: &mut Formatter<'_>) -> fmt::Result {
    let tail = match table.tail {
        Tail::Constant => "",
        Tail::Zero => ", zero beyond the last",
    };
    writeln!(formatter, "    {what} against {}: {}{tail}", table.against, count(table.rows as u64, "row"))?;
    for axis in &table.axes {
        let AxisPlan { along, least, greatest, points, matters, .. } = *axis;
        let fold = match axis.fold {
            Some(at) => format!(": folded at {}, the value of every row", number(at)),
            None if axis.is_idle => ": makes no difference to what is left of the table".to_owned(),
            None => match table.not_folded.iter().find(|(refused, _)| *refused == along) {
                Some((_, refusal)) => format!(": one value in every row, yet not folded, as {refusal}"),
                None => String::new(),
            },
        };
        let along = along.to_string();
        let range = match (matters, points) {
            (false, 1) => format!("{} in every row: left out", number(least)),
            (false, _) => format!("{} to {}, one value a group: left out", number(least), number(greatest)),
            (true, 1) => format!("{} alone", number(least)),
            (true, _) => format!("{} to {}, {points} values", number(least), number(greatest)),
        };
        writeln!(formatter, "      {along:<10} {range}{fold}")?;
    }
    if table.axes.iter().any(|axis| axis.fold.is_some()) {
        writeln!(formatter, "      {} left of it", count(table.folded_rows as u64, "row"))?;
    }
    if let Some(form) = &table.form {
        write_form(form, formatter)?;
    }
    Ok(())
}

fn write_form(form: &FormPlan, formatter: &mut Formatter<'_>) -> fmt::Result {
    writeln!(formatter, "      accuracy: {form}")?;
    form.refused.iter().try_for_each(|(method, why)| writeln!(formatter, "        not {method}: {why}"))
}

impl fmt::Display for FormPlan {
    /// The method, the bounds of its error, the measure of the tolerance first, and the tolerance where it is missed.
    fn fmt(&self, formatter: &mut Formatter<'_>) -> fmt::Result {
        const OF_LARGEST: &str = "of the largest value";
        const OF_ITSELF: &str = "of the value itself";
        write!(formatter, "{}", self.method)?;
        let is_pointwise = matches!(self.wanted, Wanted::Within(Tolerance::Pointwise(_)));
        if let Some(bound) = self.bound {
            let mut bounds = [(bound.relative_to_largest, OF_LARGEST), (bound.pointwise, OF_ITSELF)];
            bounds.rotate_left(usize::from(is_pointwise));
            let finite = bounds.iter().filter(|(bound, _)| bound.is_finite());
            let said: Vec<String> =
                finite.map(|(bound, measure)| format!("{} {measure}", rounded_up(*bound))).collect();
            if !said.is_empty() {
                write!(formatter, ", error at most {}", said.join(" and "))?;
            }
        }
        if let Some(missed) = self.missed {
            let measure = if is_pointwise { OF_ITSELF } else { OF_LARGEST };
            write!(formatter, ": above the tolerance of {missed:e} {measure}, which no form keeps")?;
        }
        Ok(())
    }
}

fn write_column(column: &ColumnPlan, width: usize, formatter: &mut Formatter<'_>) -> fmt::Result {
    let header = &column.header;
    let alias = match &column.column {
        Some(meaning) if !meaning.to_string().eq_ignore_ascii_case(header) => format!(" as `{meaning}`"),
        _ => String::new(),
    };
    let range = match column.range {
        Some((least, greatest)) if least == greatest => format!(", {} throughout", number(least)),
        Some((least, greatest)) => format!(", {} to {}", number(least), number(greatest)),
        None => String::new(),
    };
    match &column.role {
        ColumnRole::Key => writeln!(formatter, "  {header:<width$}  passed through{alias}"),
        ColumnRole::KeyAndRead => writeln!(formatter, "  {header:<width$}  passed through and read{alias}{range}"),
        ColumnRole::Read => writeln!(formatter, "  {header:<width$}  read{alias}{range}"),
        ColumnRole::NotRead(reason) => {
            let near = Column::near(header).map_or_else(String::new, |near| format!("; did you mean `{near}`?"));
            writeln!(formatter, "  {header:<width$}  left out{alias}: {reason}{near}")
        }
    }
}

/// `1 row`, `2 rows`.
fn count(number: u64, word: &str) -> String {
    format!("{number} {word}{}", if number == 1 { "" } else { "s" })
}
