//! The files of `grammar/`: every one loads strictly and fits together with the others.

use inpact_parser::grammar::{Definition, Dimension, Grammar, Release, RowShape};
use std::collections::HashSet;
use std::fs;
use std::path::{Path, PathBuf};

fn folder() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("grammar")
}

/// Every keyword file, by name.
fn definitions() -> Vec<Definition> {
    let files = fs::read_dir(folder().join("keywords")).unwrap();
    let mut paths: Vec<PathBuf> = files.map(|file| file.unwrap().path()).collect();
    paths.sort();
    let parse = |path: &PathBuf| {
        let text = fs::read_to_string(path).unwrap();
        Definition::parse(&text).unwrap_or_else(|error| panic!("{}: {error}", path.display()))
    };
    paths.iter().map(parse).collect()
}

/// Runs a check on every definition and names all that fail.
fn check(what: &str, holds: impl Fn(&Definition) -> bool) {
    let definitions = definitions();
    let failing: Vec<&str> =
        definitions.iter().filter(|definition| !holds(definition)).map(|definition| definition.name.as_str()).collect();
    assert!(failing.is_empty(), "{what}: {failing:?}");
}

#[test]
fn every_file_is_compiled_in_and_loads() {
    let grammar = Grammar::builtin();
    let definitions = definitions();
    assert!(definitions.len() > 50);
    for definition in &definitions {
        let id = grammar.id_of(&definition.name).unwrap();
        let compiled = grammar.keyword(id);
        assert_eq!(compiled.name, definition.name);
        assert_eq!(compiled.definition(), Some(definition), "{}", definition.name);
    }
    let defined = grammar.keywords().filter(|(_, keyword)| keyword.definition().is_some()).count();
    assert_eq!(defined, definitions.len());
}

/// The list is that of a newer release; *BOND (2.1) is in the manual of 6.14 and no longer in it.
#[test]
fn every_defined_keyword_is_a_keyword_of_abaqus() {
    let list = fs::read_to_string(folder().join("names/abaqus.txt")).unwrap();
    let names: HashSet<&str> = list.lines().chain(["BOND"]).collect();
    check("not in the list of names", |definition| names.contains(definition.name.as_str()));
}

#[test]
fn the_lists_of_names_are_sorted_names() {
    for file in ["names/abaqus.txt", "names/calculix.txt"] {
        let list = fs::read_to_string(folder().join(file)).unwrap();
        let names: Vec<&str> = list.lines().collect();
        assert!(names.len() > 100, "{file}");
        assert!(names.is_sorted_by(|a, b| a < b), "{file}");
        let is_letter = |letter: char| letter.is_ascii_uppercase() || letter.is_ascii_digit() || " -".contains(letter);
        assert!(names.iter().all(|name| name.chars().all(is_letter) && name.len() < 64), "{file}");
        assert!(names.iter().all(|name| !name.contains("  ") && name.trim() == *name), "{file}");
    }
}

#[test]
fn parents_are_keywords() {
    let grammar = Grammar::builtin();
    check("an unknown parent", |definition| {
        definition
            .parents
            .iter()
            .all(|parent| grammar.id_of(parent).is_some_and(|id| grammar.keyword(id).name == *parent))
    });
}

#[test]
fn every_name_in_a_definition_is_in_full() {
    let is_canonical = |name: &String| *name == name.to_uppercase() && name.trim() == name && !name.contains("  ");
    check("a parameter or choice is not upper case with single blanks", |definition| {
        let choices = definition.parameters.iter().flat_map(|parameter| &parameter.choices);
        definition.parameters.iter().map(|parameter| &parameter.name).chain(choices).all(is_canonical)
    });
}

#[test]
fn defaults_and_bounds_agree() {
    check("a default that is no legal value", |definition| {
        definition.parameters.iter().all(|parameter| {
            let Some(default) = &parameter.default else { return true };
            let is_choice = parameter.choices.is_empty() || parameter.choices.contains(default);
            let number = default.parse::<f64>();
            let at_least = parameter.minimum.is_none_or(|least| number.as_ref().is_ok_and(|value| *value >= least));
            let at_most = parameter.maximum.is_none_or(|most| number.as_ref().is_ok_and(|value| *value <= most));
            is_choice && at_least && at_most
        })
    });
}

#[test]
fn releases_follow_each_other() {
    check("gone before it came", |definition| {
        let of_parameters = definition.parameters.iter().map(|parameter| (parameter.since, parameter.until));
        of_parameters
            .chain([(definition.since, definition.until)])
            .all(|(since, until)| since.zip(until).is_none_or(|(since, until)| since <= until))
    });
}

#[test]
fn examples_begin_with_a_keyword_and_use_their_own() {
    let grammar = Grammar::builtin();
    check("the example does not use the keyword", |definition| {
        let keyword_lines = definition.example.lines().filter_map(|line| line.strip_prefix('*'));
        let mut names = keyword_lines.map(|line| line.split(',').next().unwrap_or(line));
        let uses = names.any(|name| {
            let found = grammar.keyword_named(name.as_bytes()).found();
            found.is_some_and(|id| grammar.keyword(id).name == definition.name)
        });
        uses && definition.example.starts_with('*')
    });
}

#[test]
fn the_interface_keywords_are_complete() {
    let grammar = Grammar::builtin();
    for name in [
        "SURFACE INTERACTION",
        "GAP ELECTRICAL CONDUCTANCE",
        "CONTACT PERMEABILITY",
        "GAP CONDUCTANCE",
        "GAP HEAT GENERATION",
        "GAP RADIATION",
    ] {
        let definition = grammar.keyword(grammar.id_of(name).unwrap()).definition().unwrap();
        assert!(definition.parameters_complete, "{name}");
        assert!(definition.data.shape.is_numbers(), "{name}");
    }
}

/// Semantics 2.1: the sub-options of an interaction, and what is none although its name fits.
#[test]
fn the_sub_options_of_an_interaction_are_known() {
    let grammar = Grammar::builtin();
    let options = grammar.keywords().filter(|(id, _)| grammar.is_interaction_option(*id));
    let options: Vec<&str> = options.map(|(_, keyword)| keyword.name.as_str()).collect();
    assert_eq!(
        options,
        [
            "BLOCKAGE",
            "BOND",
            "COHESIVE BEHAVIOR",
            "CONTACT DAMPING",
            "CONTACT PERMEABILITY",
            "DAMAGE EVOLUTION",
            "DAMAGE INITIATION",
            "DAMAGE STABILIZATION",
            "FRACTURE CRITERION",
            "FRICTION",
            "GAP CONDUCTANCE",
            "GAP CONVECTION",
            "GAP DIFFUSIVITY",
            "GAP ELECTRICAL CONDUCTANCE",
            "GAP HEAT GENERATION",
            "GAP RADIATION",
            "SURFACE BEHAVIOR",
        ]
    );
}

/// The units that the manual states, J and F written out.
#[test]
fn dimensions_are_those_of_the_manual() {
    let grammar = Grammar::builtin();
    let expected = [
        ("GAP ELECTRICAL CONDUCTANCE", "conductance", "C T^-1 L^-2 φ^-1"),
        ("GAP ELECTRICAL CONDUCTANCE", "pressure", "M L^-1 T^-2"),
        ("GAP CONDUCTANCE", "conductance", "M T^-3 θ^-1"),
        ("CONTACT PERMEABILITY", "permeability", "L^2 T M^-1"),
        ("GAP HEAT GENERATION", "fraction", "1"),
    ];
    for (keyword, column, dimension) in expected {
        let definition = grammar.keyword(grammar.id_of(keyword).unwrap()).definition().unwrap();
        let column = definition.data.columns.iter().find(|candidate| candidate.name == column).unwrap();
        assert_eq!(column.dimension, Some(dimension.parse::<Dimension>().unwrap()), "{keyword}");
    }
}

#[test]
fn a_table_is_ignored_beside_user() {
    for definition in definitions() {
        if definition.data.shape == RowShape::Table && definition.parameter("USER").is_some() {
            assert_eq!(definition.data.ignored_with, ["USER"], "{}", definition.name);
            assert!(definition.layout(|name| name == "USER", 0).is_none(), "{}", definition.name);
        }
    }
}

/// Semantics 2.8.
#[test]
fn the_version_matrix_holds() {
    let grammar = Grammar::builtin();
    let definition = |name: &str| grammar.keyword(grammar.id_of(name).unwrap()).definition().unwrap();
    let since = |keyword: &str, parameter: &str| definition(keyword).parameter(parameter).unwrap().since;
    assert_eq!(definition("CONTACT PERMEABILITY").since, Some(Release::R6_11));
    assert_eq!(since("CONTACT PERMEABILITY", "CONSTRAINT METHOD"), Some(Release::R2017));
    assert_eq!(since("GAP ELECTRICAL CONDUCTANCE", "TYPE"), Some(Release::R2024));
    assert_eq!(definition("GAP DIFFUSIVITY").since, Some(Release::R2024));
}

/// House style 7: what is misspelt or contradicts itself is refused.
#[test]
fn wrong_definitions_are_refused() {
    let right = r#"
name = "GAP ELECTRICAL CONDUCTANCE"
summary = "x"
levels = ["model"]
parents = []
products = ["standard"]
source = "x"
example = "*GAP ELECTRICAL CONDUCTANCE"
[[parameters]]
name = "USER"
kind = "flag"
description = "x"
source = "x"
[data]
shape = "table"
ignored_with = ["USER"]
[[data.columns]]
name = "conductance"
kind = "float"
dimension = "1"
description = "x"
source = "x"
"#;
    assert!(Definition::parse(right).is_ok());
    let refused = |from: &str, to: &str, reason: &str| {
        let wrong = right.replacen(from, to, 1);
        assert_ne!(wrong, right, "{from}");
        let error = Definition::parse(&wrong).unwrap_err().to_string();
        assert!(error.contains(reason), "{from} -> {to}: {error}");
    };
    refused("dimension = \"1\"", "dimensione = \"1\"", "unknown field `dimensione`");
    refused("dimension = \"1\"\n", "", "numbers have a dimension");
    refused("dimension = \"1\"", "dimension = \"J\"", "`J` is no dimension");
    refused("summary = \"x\"\n", "", "missing field `summary`");
    refused("summary = \"x\"", "summary = \"x.\"", "without a full stop");
    refused("levels = [\"model\"]", "levels = [\"modell\"]", "unknown variant `modell`");
    refused("levels = [\"model\"]", "levels = [\"model\"]\nsince = \"6.12\"", "`6.12` is no release");
    refused("ignored_with = [\"USER\"]", "ignored_with = [\"USERS\"]", "`USERS` is no parameter");
    refused("kind = \"flag\"", "kind = \"choice\"", "choices belong to the kind `choice`");
    refused("kind = \"flag\"", "kind = \"flag\"\nneeds = [\"DEPVAR\"]", "`DEPVAR` is no other parameter");
    refused("shape = \"table\"", "shape = \"text\"", "have no columns");
    refused("shape = \"table\"", "shape = \"headed_table\"", "items before them");
    refused("name = \"GAP", "name = GAP", "TOML parse error");
}
