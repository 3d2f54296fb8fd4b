//! Lookup of keywords and parameters by written names: S-11 to S-16 and the test vectors of appendix A.

use inpact_parser::grammar::{Definition, Dialect, Grammar, Lookup, Release, lookup_name};
use std::sync::LazyLock;

/// The languages of all releases, made once.
fn of_release(release: Release) -> &'static Grammar {
    static ALL: LazyLock<Vec<Grammar>> =
        LazyLock::new(|| Release::ALL.map(|release| Grammar::new(Dialect::Abaqus, release)).into());
    ALL.iter().find(|grammar| grammar.release() == release).expect("every release has one")
}

/// The full names a keyword may mean in a release; one and `Exact` or `Abbreviated`, several, or none.
fn keyword(written: &str, release: Release) -> (&'static str, Vec<&'static str>) {
    let grammar = of_release(release);
    let name = |id| grammar.keyword(id).name.as_str();
    match grammar.keyword_named(written.as_bytes()) {
        Lookup::Exact(id) => ("exact", vec![name(id)]),
        Lookup::Abbreviated(id) => ("abbreviated", vec![name(id)]),
        Lookup::Ambiguous(ids) => ("ambiguous", ids.into_iter().map(name).collect()),
        Lookup::Unknown => ("unknown", vec![]),
    }
}

fn exact(written: &str, name: &str) {
    assert_eq!(keyword(written, Release::NEWEST), ("exact", vec![name]), "{written:?}");
}

fn abbreviated(written: &str, name: &str) {
    assert_eq!(keyword(written, Release::NEWEST), ("abbreviated", vec![name]), "{written:?}");
}

fn definition(name: &str) -> &'static Definition {
    let grammar = Grammar::builtin();
    grammar.keyword(grammar.id_of(name).unwrap()).definition().unwrap()
}

fn parameter(keyword: &str, written: &str, expected: &str) {
    let definition = definition(keyword);
    let shown = match definition.parameter_named_in(written.as_bytes(), Release::NEWEST) {
        Lookup::Exact(index) | Lookup::Abbreviated(index) => definition.parameters[index].name.clone(),
        Lookup::Ambiguous(indices) => {
            let names = indices.into_iter().map(|index| definition.parameters[index].name.as_str());
            names.collect::<Vec<_>>().join(" | ")
        }
        Lookup::Unknown => "unknown".to_owned(),
    };
    assert_eq!(shown, expected, "*{keyword}, {written}");
}

#[test]
fn a_01_blanks_and_case_do_not_count() {
    exact("gapelectricalconductance", "GAP ELECTRICAL CONDUCTANCE");
    exact(" Gap\tElectrical  Conductance ", "GAP ELECTRICAL CONDUCTANCE");
    exact("ENDSTEP", "END STEP");
    parameter("GAP ELECTRICAL CONDUCTANCE", "PRES", "PRESSURE");
}

#[test]
fn a_02_prefixes_must_be_unique() {
    abbreviated("GAP E", "GAP ELECTRICAL CONDUCTANCE");
    exact("GAP", "GAP");
    let (kind, candidates) = keyword("CONTACT P", Release::NEWEST);
    assert_eq!(kind, "ambiguous");
    assert_eq!(candidates, ["CONTACT PAIR", "CONTACT PERMEABILITY", "CONTACT PRINT", "CONTACT PROPERTY ASSIGNMENT"]);
}

#[test]
fn a_04_parameters_are_abbreviated_too() {
    parameter("CONTACT PERMEABILITY", "CUTOFFF", "CUTOFF FLOW ACROSS");
    parameter("CONTACT PERMEABILITY", "CUTOFF", "CUTOFF FLOW ACROSS | CUTOFF GAP FILL");
    parameter("CONTACT PERMEABILITY", "CUTOFFS", "unknown");
}

/// S-14: a longer text than the name is not the name.
#[test]
fn s_14_over_long_names_are_unknown() {
    parameter("CHANGE FRICTION", "INTERACTION NAME", "unknown");
    assert_eq!(definition("CHANGE FRICTION").nearest_parameters("INTERACTION NAME", 3), ["INTERACTION"]);
    assert_eq!(keyword("SURFACE INTERACTIONS", Release::NEWEST).0, "unknown");
}

/// S-15: the least prefix of a keyword, and that one letter less does not mean it.
///
/// The table there was computed from the 504 names of 6.14; the list here has 610, those of newer releases among them.
/// The rows that the newer names change are in the two tests below.
#[test]
fn s_15_least_prefixes() {
    let rows = [
        ("SURFACE INTERACTION", "SURFACEI"),
        ("SURFACE BEHAVIOR", "SURFACEB"),
        ("SURFACE SMOOTHING", "SURFACESM"),
        ("SURFACE PROPERTY ASSIGNMENT", "SURFACEPROPERTYA"),
        ("HEADING", "HEAD"),
        ("HEAT TRANSFER", "HEATT"),
        ("INCLUDE", "INCL"),
        ("PARAMETER DEPENDENCE", "PARAMETERD"),
        ("PHYSICAL CONSTANTS", "PH"),
        ("END STEP", "ENDS"),
        ("END PART", "ENDP"),
        ("END INSTANCE", "ENDI"),
        ("END ASSEMBLY", "ENDA"),
        ("INSTANCE", "INS"),
        ("ASSEMBLY", "ASS"),
        ("MODEL CHANGE", "MODE"),
        ("GAP ELECTRICAL CONDUCTANCE", "GAPE"),
        ("GAP FLOW", "GAPF"),
        ("GAP HEAT GENERATION", "GAPH"),
        ("GAP RADIATION", "GAPR"),
        ("FRICTION", "FRI"),
        ("CHANGE FRICTION", "CHAN"),
        ("COHESIVE BEHAVIOR", "COHESIVEB"),
        ("DAMAGE INITIATION", "DAMAGEI"),
        ("DAMAGE EVOLUTION", "DAMAGEE"),
        ("SOILS", "SOI"),
        ("GEOSTATIC", "GEO"),
        ("STATIC", "STA"),
        ("COUPLED TEMPERATURE-DISPLACEMENT", "COUPLEDTE"),
        ("INITIAL CONDITIONS", "INI"),
        ("TEMPERATURE", "TEM"),
        ("CONTACT PAIR", "CONTACTPA"),
        ("CONTACT PERMEABILITY", "CONTACTPE"),
        ("CONTACT PROPERTY ASSIGNMENT", "CONTACTPRO"),
        ("CONTACT PRINT", "CONTACTPRI"),
        ("CONTACT INCLUSIONS", "CONTACTINC"),
        ("CONTACT EXCLUSIONS", "CONTACTE"),
        ("CONTACT INTERFERENCE", "CONTACTINT"),
        ("CONTACT DAMPING", "CONTACTD"),
        ("CONTACT OUTPUT", "CONTACTO"),
        ("CONTACT FILE", "CONTACTFI"),
        ("CONTACT FORMULATION", "CONTACTFO"),
        ("CONTACT STABILIZATION", "CONTACTS"),
    ];
    for (name, least) in rows {
        for release in [Release::R6_14, Release::NEWEST] {
            assert_eq!(keyword(least, release), ("abbreviated", vec![name]), "{least}");
            let shorter = &least[..least.len() - 1];
            let (kind, found) = keyword(shorter, release);
            assert!(kind == "ambiguous" || found != [name], "{shorter} should not mean {name}");
        }
    }
}

/// S-15: names that begin others, so that only the complete spelling selects them.
#[test]
fn s_15_names_that_begin_others() {
    for name in ["SURFACE", "GAP", "CONTACT", "PARAMETER", "CONTACT CONTROLS", "STEP", "PART"] {
        exact(name, name);
    }
    assert_eq!(keyword("STE", Release::NEWEST).0, "ambiguous");
    assert_eq!(keyword("PAR", Release::NEWEST).0, "ambiguous");
}

/// S-15, Q-33: what the newer names change. *GAP CONVECTION makes `GAPC` ambiguous, *COUPLED THERMAL-ELECTROCHEMICAL
/// `COUPLEDTH`. `FIE` is ambiguous with *FIELD IMPORT and others, of which only the names are known, not the release.
#[test]
fn s_15_newer_names_lengthen_prefixes() {
    assert_eq!(keyword("GAPC", Release::R6_14), ("abbreviated", vec!["GAP CONDUCTANCE"]));
    assert_eq!(keyword("GAPC", Release::NEWEST), ("ambiguous", vec!["GAP CONDUCTANCE", "GAP CONVECTION"]));
    abbreviated("GAPCOND", "GAP CONDUCTANCE");
    abbreviated("GAPCONV", "GAP CONVECTION");
    assert_eq!(keyword("COUPLEDTH", Release::R6_14), ("abbreviated", vec!["COUPLED THERMAL-ELECTRICAL"]));
    assert_eq!(keyword("COUPLEDTH", Release::NEWEST).0, "ambiguous");
    abbreviated("COUPLEDTHERMAL-ELECTRI", "COUPLED THERMAL-ELECTRICAL");
    assert_eq!(keyword("FIE", Release::NEWEST).0, "ambiguous");
    exact("FIELD", "FIELD");
}

/// K015: a keyword that the release does not have is unknown there, exact or not.
#[test]
fn a_release_has_its_own_names() {
    assert_eq!(keyword("GAP DIFFUSIVITY", Release::R2017).0, "unknown");
    assert_eq!(keyword("GAP DIFFUSIVITY", Release::R2024).0, "exact");
    let permeability = definition("CONTACT PERMEABILITY");
    assert_eq!(permeability.parameter_named_in(b"CONSTRAINT METHOD", Release::R2016), Lookup::Unknown);
    assert!(permeability.parameter_named_in(b"CONSTRAINT METHOD", Release::R2017).found().is_some());
}

/// S-16. D, P, PA, PR and T as the manual's lists have them; TYPE came to *GAP ELECTRICAL CONDUCTANCE later.
#[test]
fn s_16_least_parameter_prefixes() {
    for keyword in ["GAP ELECTRICAL CONDUCTANCE", "GAP CONDUCTANCE"] {
        parameter(keyword, "D", "DEPENDENCIES");
        parameter(keyword, "p", "PRESSURE");
        parameter(keyword, "U", "USER");
    }
    parameter("GAP ELECTRICAL CONDUCTANCE", "T", "TYPE");
    parameter("GAP CONDUCTANCE", "T", "unknown");
    parameter("CONTACT PERMEABILITY", "CO", "CONSTRAINT METHOD");
    parameter("CONTACT PERMEABILITY", "C", "CUTOFF FLOW ACROSS | CUTOFF GAP FILL | CONSTRAINT METHOD");
    parameter("CONTACT PERMEABILITY", "CUTOFFG", "CUTOFF GAP FILL");
    parameter("CONTACT PERMEABILITY", "D", "DEPENDENCIES");
    for (written, expected) in [
        ("N", "NAME"),
        ("D", "DEPVAR"),
        ("PA", "PAD THICKNESS"),
        ("PR", "PROPERTIES"),
        ("T", "TRACKING THICKNESS"),
        ("UN", "UNSYMM"),
        ("US", "USER"),
        ("P", "PROPERTIES | PAD THICKNESS"),
        ("U", "USER | UNSYMM"),
    ] {
        parameter("SURFACE INTERACTION", written, expected);
    }
}

/// S-13: the abbreviations that decks use.
#[test]
fn s_13_abbreviations_seen_in_decks() {
    parameter("STEP", "inc", "INC");
    parameter("STEP", "AMP", "AMPLITUDE");
    parameter("PHYSICAL CONSTANTS", "ABS", "ABSOLUTE ZERO");
    parameter("PHYSICAL CONSTANTS", "STEFAN", "STEFAN BOLTZMANN");
    parameter("PHYSICAL CONSTANTS", "STEFANB", "STEFAN BOLTZMANN");
    parameter("PHYSICAL CONSTANTS", "UNIVERSAL GAS", "UNIVERSAL GAS CONSTANT");
    parameter("HEAT TRANSFER", "deltmx", "DELTMX");
}

#[test]
fn s_13_choices_are_abbreviated_too() {
    let pair = definition("CONTACT PAIR").parameter("TYPE").unwrap();
    assert_eq!(pair.choice_named(b"surface to surface"), Some("SURFACE TO SURFACE"));
    assert_eq!(pair.choice_named(b"SURFACETOSURFACE"), Some("SURFACE TO SURFACE"));
    assert_eq!(pair.choice_named(b"S"), Some("SURFACE TO SURFACE"));
    assert_eq!(pair.choice_named(b"MORTAR"), None);
    let method = definition("CONTACT PERMEABILITY").parameter("CONSTRAINT METHOD").unwrap();
    assert_eq!(method.choice_named(b"FOO"), None);
    assert_eq!(lookup_name(b"a", ["AB", "AC"]), Lookup::Ambiguous(vec![0, 1]));
    assert_eq!(lookup_name(b"A B", ["AB", "ABC"]), Lookup::Exact(0));
}

#[test]
fn unknown_names_are_unknown() {
    let grammar = Grammar::builtin();
    for written in [&b""[..], b"  \t", b"5e8", b"\xff\xfe", b"END", b"NO ANALYSIS", b"GAP=", &[b'S'; 1000]] {
        let unknown = Lookup::Unknown;
        let expected = if written == b"END" { "ambiguous" } else { "unknown" };
        assert_eq!(grammar.keyword_named(written) == unknown, expected == "unknown", "{written:?}");
    }
}

#[test]
fn keywords_of_calculix_are_known_by_name() {
    let grammar = Grammar::builtin();
    assert!(grammar.is_calculix_keyword(b"no analysis"));
    assert!(grammar.is_calculix_keyword(b"GAPCONDUCTANCE"));
    assert!(!grammar.is_calculix_keyword(b"GAP ELECTRICAL CONDUCTANCE"));
}

/// The nearest names come first, and one that is far from everything has none.
#[test]
fn near_names_are_found() {
    let grammar = Grammar::builtin();
    let nearest = |written| grammar.nearest_keywords(written, 3);
    assert_eq!(nearest("GAP ELECTRICAL CONDUCTENCE")[0], "GAP ELECTRICAL CONDUCTANCE");
    let nearest_two = ["ELECTRICAL CONDUCTIVITY", "GAP ELECTRICAL CONDUCTANCE"];
    assert_eq!(nearest("GAP ELECTRICAL CONDUCTIVITY"), nearest_two);
    assert_eq!(nearest("Surface Interactions")[0], "SURFACE INTERACTION");
    assert_eq!(nearest("SURFACE BEHAVIOUR")[0], "SURFACE BEHAVIOR");
    assert_eq!(nearest("SOLIS")[0], "SOILS");
    assert_eq!(nearest("SOLID SECTIONS")[0], "SOLID SECTION");
    assert_eq!(nearest("STEPS")[0], "STEP");
    assert!(nearest("QQQQQQQQ").is_empty());
    assert!(nearest("").is_empty());
    assert!(grammar.nearest_keywords("CONTACT", 2).len() <= 2);
    assert_eq!(definition("GAP CONDUCTANCE").nearest_parameters("PRESURE", 3), ["PRESSURE"]);
}

/// The work does not grow with the length of a word: a megabyte is cut off, not compared.
#[test]
fn megabytes_are_answered() {
    let grammar = Grammar::builtin();
    let long = "GAP CONDUCTANCE".to_owned() + &"X".repeat(10_000_000);
    assert_eq!(grammar.keyword_named(long.as_bytes()), Lookup::Unknown);
    assert_eq!(grammar.nearest_keywords(&long, 3)[0], "GAP CONDUCTANCE");
    let blanks = "GAP".to_owned() + &" ".repeat(10_000_000) + "E";
    assert!(matches!(grammar.keyword_named(blanks.as_bytes()), Lookup::Abbreviated(_)));
}

/// CalculiX has its own list of names, no abbreviations, and other columns in some options.
#[test]
fn calculix_has_a_language_of_its_own() {
    let grammar = Grammar::new(Dialect::Calculix, Release::NEWEST);
    let definition = |name: &str| {
        let id = grammar.keyword_named(name.as_bytes()).found().expect("a keyword of CalculiX");
        grammar.keyword(id).definition().expect("it is defined")
    };
    let columns = |name: &str| definition(name).layout(|_| false, 0).expect("rows of numbers").columns;
    assert_eq!(columns("GAP CONDUCTANCE"), ["conductance", "pressure", "temp"]);
    assert_eq!(columns("gap heat generation"), ["fraction", "slave_weight", "slip_rate"]);
    assert!(!definition("SURFACE").parameters_complete, "an Abaqus list says nothing about CalculiX");
    assert!(definition("GAP CONDUCTANCE").parameters_complete);
    // CX-03: ccx looks at as many letters as its own name has, so that an abbreviation is another keyword, or none.
    assert_eq!(grammar.keyword_named(b"SURFACE INTERACT").found(), grammar.id_of("SURFACE"));
    assert_eq!(grammar.keyword_named(b"GAP COND"), Lookup::Unknown);
    assert_eq!(grammar.keyword_named(b"GAP ELECTRICAL CONDUCTANCE"), Lookup::Unknown);
    assert!(grammar.id_of("GAP ELECTRICAL CONDUCTANCE").is_some());
    assert!(matches!(grammar.keyword_named(b"NODE"), Lookup::Exact(_)));
    assert!(matches!(grammar.keyword_named(b"transform f"), Lookup::Exact(_)));
}

/// Every file of `grammar/calculix/` is read as strictly as those of Abaqus, and its example is right.
#[test]
fn the_files_for_calculix_load() {
    let grammar = Grammar::new(Dialect::Calculix, Release::NEWEST);
    let folder = std::path::Path::new(env!("CARGO_MANIFEST_DIR")).join("grammar/calculix");
    let mut read = 0;
    for entry in std::fs::read_dir(folder).unwrap() {
        let path = entry.unwrap().path();
        let definition = Definition::parse(&std::fs::read_to_string(&path).unwrap())
            .unwrap_or_else(|error| panic!("{}: {error}", path.display()));
        assert!(grammar.has(grammar.id_of(&definition.name).unwrap()), "{}", definition.name);
        let deck = inpact_parser::deck::scan("example.inp", definition.example.as_bytes(), &grammar);
        let (_, problems) = inpact_parser::model::read(&deck, &grammar);
        assert_eq!(problems, [], "{}", definition.name);
        read += 1;
    }
    assert!(read >= 5, "{read} files");
}
