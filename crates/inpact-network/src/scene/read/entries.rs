//! Reads nodes, links and interfaces of a scene file into the scene.

use super::{CheckedCondition, Reader, put_condition, start};
use crate::scene::course::Course;
use crate::scene::file::{self, Condition, InterfaceEntry, LinkEntry, NodeEntry};
use crate::scene::rules::{MALFORMED_SCENE, MALFORMED_TIME};
use crate::scene::usable::{self, Given};
use crate::scene::values::Number;
use crate::scene::{Field, Scene, SceneInterface, SceneLink};
use inpact_parser::model::{MAX_FIELD_VARIABLES, Name};
use toml::Spanned;

impl Reader<'_> {
    pub(super) fn take_node(&mut self, entry: NodeEntry, scene: &mut Scene) {
        let (at, line) = (start(&entry.name), self.line_of(&entry.name));
        let name = entry.name.into_inner();
        if let Err(refusal) = usable::node_name(&name, || "`name`".to_owned()) {
            self.lacks_nodes = true;
            return self.refuse(at, refusal);
        }
        let number = match self.define_at(&name, (0, line), scene) {
            Ok(number) => number,
            Err(refusal) => return self.refuse(at, refusal),
        };
        scene.node_lines.insert(number, line);
        self.take_part(entry.set, entry.surface, number, scene);
        let conditions = [entry.potential, entry.temperature, entry.pore_pressure];
        for (field, condition) in Field::ALL.into_iter().zip(conditions) {
            let Some(condition) = condition else { continue };
            let at = start(&condition);
            if let Some(condition) = self.checked(field, condition.into_inner(), at, &name) {
                put_condition(scene, field, number, condition);
            }
        }
    }

    /// A condition whose numbers can be used.
    pub(super) fn checked(
        &mut self,
        field: Field,
        condition: Condition,
        at: usize,
        node: &str,
    ) -> Option<CheckedCondition> {
        // A field that is mentioned is carried, even without a condition.
        let is_named_only = condition == Condition::default();
        let Condition { fixed, source, capacity, initial } = condition;
        let given = Given {
            fixed: fixed.is_some(),
            source: source.is_some(),
            capacity: capacity.is_some(),
            initial: initial.is_some(),
        };
        if let Err(refusal) = usable::condition(field, given, node) {
            self.refuse(at, refusal);
            return None;
        }
        let label = format!("`{}` of `{node}`", field.key());
        let capacity = self.value("capacity", capacity.as_ref(), || format!("`capacity` of {label}"));
        let initial = self.value("initial", initial.as_ref(), || format!("`initial` of {label}"));
        let fixed = self.course("fixed", fixed, &label);
        let source = self.course("source", source, &label);
        let source = if is_named_only { Some(Course::constant(0.0)) } else { source };
        Some(CheckedCondition { fixed, source, capacity, initial })
    }

    /// The time course of a key; reports an unusable one.
    pub(super) fn course(&mut self, key: &str, course: Option<Spanned<file::Course>>, label: &str) -> Option<Course> {
        let course = course?;
        let span = course.span();
        let at = span.start;
        let what = format!("`{key}` of {label}");
        let points = match course.into_inner() {
            file::Course::Constant(value) => {
                let written = self.text.get(span).unwrap_or_default();
                let refused = usable::number(key, value, written, || what).map_err(|refusal| self.refuse(at, refusal));
                return refused.is_ok().then(|| Course::constant(value));
            }
            file::Course::Points(points) => points,
        };
        let pairs = points.iter().zip(points.iter().skip(1));
        let late = pairs.map(|(before, after)| (before[0], after[0])).find(|(before, after)| after <= before);
        let time = points.iter().map(|point| point[0]).find(|time| !time.is_finite());
        let message = if points.is_empty() {
            format!("{what} has no points")
        } else if let Some(time) = time {
            format!("a time of {what} is {time:?}, which is not finite")
        } else if let Some((before, after)) = late {
            format!("the times of {what} do not ascend: {after:?} follows {before:?}")
        } else if self.is_steady {
            let help = "give a number, or write procedure = \"transient\"";
            self.report(&MALFORMED_TIME, at, format!("{what} follows time, and a steady state has none"), help);
            return None;
        } else {
            let unusable = points.iter().find_map(|&[time, value]| {
                usable::number(key, value, &format!("{value:?}"), || format!("{what} at time {time:?}")).err()
            });
            return match unusable {
                Some(refusal) => {
                    self.refuse(at, refusal);
                    None
                }
                None => Some(Course::through(points)),
            };
        };
        let help = "give a number, or points of time and value whose times ascend, such as [[0.0, 20.0], [1.0, 80.0]]";
        self.report(&MALFORMED_TIME, at, message, help);
        None
    }

    pub(super) fn take_link(&mut self, entry: LinkEntry, at: usize, default: f64, scene: &mut Scene) {
        let (at_nodes, written) = (start(&entry.nodes), self.text.get(entry.nodes.span()).unwrap_or_default());
        let names = entry.nodes.into_inner();
        let numbers = [0, 1].map(|end| {
            // A name with an escape is not found verbatim; then the place is that of the list.
            let place = ['"', '\''].iter().find_map(|quote| written.find(&format!("{quote}{}{quote}", names[end])));
            self.number(&names[end], at_nodes + place.unwrap_or(0), "a name in `nodes`", scene)
        });
        let label = format!("the link of `{}` and `{}`", names[0], names[1]);
        if let Err(refusal) = usable::joined([&names[0], &names[1]], "the link") {
            return self.refuse(at_nodes, refusal);
        }
        let given = [&entry.electrical, &entry.thermal, &entry.hydraulic];
        if let Err(refusal) = usable::conducting(given.iter().any(|conductance| conductance.is_some()), &label) {
            self.refuse(at, refusal);
        }
        let conductances = Field::ALL.map(|field| {
            let key = field.conductance_key();
            let conductance = self.value(key, given[field.index()].as_ref(), || format!("`{key}` of {label}"));
            conductance.unwrap_or(0.0)
        });
        let key = "joule_heat_fraction";
        let fraction = self.value(key, entry.joule_heat_fraction.as_ref(), || format!("`{key}` of {label}"));
        if let [Some(first), Some(second)] = numbers {
            let joule_heat_fraction = fraction.unwrap_or(default);
            scene.links.push(SceneLink { nodes: [first, second], conductances, joule_heat_fraction });
        }
    }

    pub(super) fn take_interface(&mut self, entry: InterfaceEntry, at: usize, scene: &mut Scene) {
        let ends = [(&entry.slave, "`slave`"), (&entry.master, "`master`")];
        let numbers = ends.map(|(name, what)| self.number(name.as_ref(), start(name), what, scene));
        let [slave, master] = [entry.slave.as_ref(), entry.master.as_ref()];
        let label = format!("the interface of `{slave}` and `{master}`");
        if entry.fv.len() > MAX_FIELD_VARIABLES {
            let message = format!("`fv` of {label} has {} numbers", entry.fv.len());
            let help = format!("a deck has {MAX_FIELD_VARIABLES} field variables at most");
            self.report(&MALFORMED_SCENE, at, message, &help);
        }
        let mut field_variables = Vec::new();
        for (number, position) in entry.fv.iter().zip(1..) {
            field_variables.extend(self.value("fv", Some(number), || format!("`fv{position}` of {label}")));
        }
        let clearance = self.course("clearance", entry.clearance, &label);
        let pressure = self.course("pressure", entry.pressure, &label);
        let mut value = |key: &str, number: Option<&Number>| self.value(key, number, || format!("`{key}` of {label}"));
        let interface = SceneInterface {
            interaction: entry.interaction.map(|name| Name::new(name.as_ref())),
            slave: 0,
            master: 0,
            area: value("area", Some(&entry.area)).unwrap_or_default(),
            clearance,
            pressure,
            closed: entry.closed,
            field_variables,
            temperature: value("temperature", entry.temperature.as_ref()),
            mass_flow: value("mass_flow", entry.mass_flow.as_ref()),
            shear: value("shear", entry.shear.as_ref()),
            slip_rate: value("slip_rate", entry.slip_rate.as_ref()),
            clearance_rate: value("clearance_rate", entry.clearance_rate.as_ref()),
            characteristic_length: value("char_length", entry.char_length.as_ref()),
            bulk_permeabilities: [value("perm_s", entry.perm_s.as_ref()), value("perm_m", entry.perm_m.as_ref())],
            place: (self.line(at), None),
        };
        if let Err(refusal) = usable::joined([slave, master], "the interface") {
            self.refuse(at, refusal);
        } else if let [Some(slave), Some(master)] = numbers {
            scene.interfaces.push(SceneInterface { slave, master, ..interface });
        }
    }
}
