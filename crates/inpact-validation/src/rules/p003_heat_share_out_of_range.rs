//! P003: heat that is shared by a fraction outside 0 to 1.

use crate::heat::items;
use crate::quantity::number;
use crate::rule::{Context, Report, declare_rule};

declare_rule! {
    /// The second item of *GAP HEAT GENERATION lies outside of 0 to 1.
    ///
    /// It is the fraction of the heat that goes into the first (slave) surface; the rest goes into the other.
    ///
    /// ## Why
    /// With more than the whole heat on one side, the other side would be cooled by it.
    ///
    /// ## What to do
    /// Give a fraction: 0.5 shares the heat equally, 1 sends all of it into the slave surface, 0 into the master surface.
    ///
    /// ```inp,expect
    /// *SURFACE INTERACTION, NAME=BRAKE
    /// *FRICTION
    /// 0.3,
    /// *GAP HEAT GENERATION
    /// 1., 50.
    /// ```
    ///
    /// ```inp
    /// *SURFACE INTERACTION, NAME=BRAKE
    /// *FRICTION
    /// 0.3,
    /// *GAP HEAT GENERATION
    /// 1., 0.5
    /// ```
    "P003", "heat-share-out-of-range", Error, fix: None, source: "K-35, Q-13"
}

fn check(context: &Context<'_>, report: &mut Report<'_>) {
    for (place, share) in items(context, 1) {
        // A share that is no number has a finding of its own (S006).
        if share.is_nan() || (0.0..=1.0).contains(&share) {
            continue;
        }
        let found = report.at(place, format!("heat share {} lies outside of 0 to 1", number(share)));
        found.label("the fraction that goes into the slave surface");
        found.note("what one side gets above the whole heat would be taken from the other side");
        if share > 1.0 && share <= 100.0 {
            found.help(format!("give a fraction; {} percent is {}", number(share), number(share / 100.0)));
        } else {
            found.help("give a fraction from 0 to 1");
        }
    }
}
