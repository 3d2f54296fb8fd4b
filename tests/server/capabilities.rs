//! What an editor is shown: hover, completion, outline, hints, colours. Each on a sample deck, held by snapshots.

use crate::client::{Client, file_of, marked, shown};
use serde_json::{Value, json};

/// A deck with one of everything.
const DECK: &str = "\
*HEADING
Busbar joint
*PARAMETER
k_contact = 2.5E3
clearance_end = 1.E-5*2
*SURFACE INTERACTION, NAME=JOINT
*GAP ELECTRICAL CONDUCTANCE, DEPENDENCIES=1
<k_contact>, 0., 20., 1.
     0., <clearance_end>, 20., 1.
5000., 0., 90., 1.
  10., 1.E-5, 90., 1.
   0., 2.0E-5, 90., 1.
*GAP CONDUCTANCE
20., 0.
10., 0.1
*CONTACT PERMEABILITY, CUTOFF FLOW ACROSS=0.1, CONSTRAINT METHOD=PENALTY
1.,
*GAP HEAT GENERATION
1., 0.5
*SURFACE, NAME=UPPER
BAR-1, S1
*SURFACE, NAME=LOWER
BAR-2, S2
*CONTACT PAIR, INTERACTION=JOINT
UPPER, LOWER
*STEP
*COUPLED THERMAL-ELECTRICAL, STEADY STATE
** inpact: ignore T001
*BOUNDARY
UPPER, 11, 11, 20.
*END STEP
";

/// Hovers over marked places of a deck; `¦` stands before the place.
fn hover(marked_line: &str) -> String {
    let (line, (_, character)) = marked(marked_line);
    let number = DECK.lines().position(|other| other == line).expect("a line of the deck") as u64;
    let mut client = Client::start();
    client.open("deck.inp", DECK);
    let found = client.at("textDocument/hover", "deck.inp", (number, character)).expect("answered");
    if found.is_null() {
        return "nothing".to_owned();
    }
    let text = format!("{}\n{}", shown(&found["range"]), found["contents"]["value"].as_str().unwrap());
    client.without_folder(&text)
}

#[test]
fn hover_on_cells() {
    let cells = [
        "   ¦0., 2.0E-5, 90., 1.",
        "   0., ¦2.0E-5, 90., 1.",
        "   0., 2.0E-5, ¦90., 1.",
        "   0., 2.0E-5, 90., ¦1.",
        "10., ¦0.1",
        "¦1.,",
        "1., ¦0.5",
        "UPPER, ¦LOWER",
    ];
    let pages: Vec<String> = cells.iter().map(|cell| format!("### {}\n{}", cell.trim(), hover(cell))).collect();
    insta::assert_snapshot!(pages.join("\n"));
}

#[test]
fn hover_on_keyword_lines_and_names() {
    let places = [
        "*GAP ¦CONDUCTANCE",
        "*CONTACT PERMEABILITY, CUTOFF FLOW ACROSS=0.1, CONSTRAINT ¦METHOD=PENALTY",
        "*SURFACE INTERACTION, NAME=¦JOINT",
        "*CONTACT PAIR, INTERACTION=J¦OINT",
        "<k_¦contact>, 0., 20., 1.",
        "     0., <clearance¦_end>, 20., 1.",
        "** inpact: ignore T0¦01",
        "*BOUN¦DARY",
        "Busbar ¦joint",
        "¦*HEADING",
    ];
    let pages: Vec<String> = places.iter().map(|place| format!("### {place}\n{}", hover(place))).collect();
    insta::assert_snapshot!(pages.join("\n"));
}

/// What is offered at `¦`: labels, what is inserted, details; of many the first few.
fn complete(text: &str) -> String {
    let (text, place) = marked(text);
    let mut client = Client::start();
    client.write("mesh.inp", "*NODE\n1, 0., 0.\n");
    std::fs::create_dir(client.path("parts")).expect("made");
    client.write_and_open("deck.inp", &text);
    let found = client.at("textDocument/completion", "deck.inp", place).expect("answered");
    let mut items = found["items"].as_array().expect("a list").clone();
    items.sort_by_key(|item| item["sortText"].as_str().or(item["label"].as_str()).unwrap_or_default().to_owned());
    let line = |item: &Value| {
        let edit = &item["textEdit"];
        format!(
            "  {} | {} | {}{}\n",
            item["label"].as_str().unwrap(),
            shown(&edit["range"]),
            edit["newText"].as_str().unwrap().replace('\n', "⏎"),
            item["detail"].as_str().map_or_else(String::new, |detail| format!(" | {detail}"))
        )
    };
    let lines: String = items.iter().take(14).map(line).collect();
    // How many there are changes with every keyword and rule.
    if items.len() > 14 { format!("{lines}  … and more\n") } else { lines }
}

#[test]
fn completion_of_keywords() {
    let texts = [
        "*SURFACE INTERACTION, NAME=A\n*GAP¦",
        "*HEADING\nx\n*¦",
        "*STEP\n*¦\n*END STEP\n",
        "*SURFACE INTERACTION, NAME=A\n*GAP¦, DEPENDENCIES=1\n",
    ];
    let lists: Vec<String> =
        texts.iter().map(|text| format!("### {}\n{}", text.replace('\n', "⏎"), complete(text))).collect();
    insta::assert_snapshot!(lists.join("\n"));
}

#[test]
fn completion_of_parameters_values_and_names() {
    let texts = [
        "*SURFACE INTERACTION, NAME=A\n*CONTACT PERMEABILITY, CUT¦\n",
        "*SURFACE INTERACTION, NAME=A\n*CONTACT PERMEABILITY, CONSTRAINT METHOD=¦\n",
        "*SURFACE INTERACTION, NAME=A\n*SURFACE INTERACTION, NAME=\"B c\"\n*CONTACT PAIR, INTERACTION=¦\n",
        "*SURFACE, NAME=TOP\nE, S1\n*SURFACE, NAME=BOTTOM\nE, S2\n*CONTACT PAIR, INTERACTION=A\nTOP, B¦\n",
        "*PARAMETER\nk = 2\nlength = k*3\n*SURFACE INTERACTION, NAME=A\n*GAP CONDUCTANCE\n<¦, 0.\n",
        "*INCLUDE, INPUT=¦\n",
        "*NSET, NSET=HOT\n1,\n*ELSET, ELSET=BARS\n1,\n*BOUNDARY\n¦\n",
        "** inpact: ignore T00¦\n*SURFACE INTERACTION, NAME=A\n",
        "*SURFACE INTERACTION, NAME=A\n*CONTACT PERMEABILITY,\n  CUT¦\n",
        "*HEADING\nany ¦text\n",
    ];
    let lists: Vec<String> =
        texts.iter().map(|text| format!("### {}\n{}", text.replace('\n', "⏎"), complete(text))).collect();
    insta::assert_snapshot!(lists.join("\n"));
}

fn outline(symbols: &Value, depth: usize) -> String {
    let one = |symbol: &Value| {
        let detail = symbol["detail"].as_str().map_or_else(String::new, |detail| format!(" ({detail})"));
        format!(
            "{}{}{detail} {} at {}\n{}",
            "  ".repeat(depth),
            symbol["name"].as_str().unwrap(),
            shown(&symbol["range"]),
            shown(&symbol["selectionRange"]),
            outline(&symbol["children"], depth + 1)
        )
    };
    symbols.as_array().into_iter().flatten().map(one).collect()
}

#[test]
fn document_symbols_are_nested() {
    let mut client = Client::start();
    client.open("deck.inp", DECK);
    insta::assert_snapshot!(outline(&client.of("textDocument/documentSymbol", "deck.inp"), 0));
    client.open("cae.inp", include_str!("../../decks/fragments/cae-assembly.inp"));
    insta::assert_snapshot!(outline(&client.of("textDocument/documentSymbol", "cae.inp"), 0));
}

#[test]
fn folding_and_selection() {
    let mut client = Client::start();
    client.open("deck.inp", DECK);
    let folds = client.of("textDocument/foldingRange", "deck.inp");
    let one = |fold: &Value| {
        format!("{}-{}\n", fold["startLine"].as_u64().unwrap() + 1, fold["endLine"].as_u64().unwrap() + 1)
    };
    let folds: String = folds.as_array().unwrap().iter().map(one).collect();
    let places = json!([{"line": 10, "character": 7}, {"line": 23, "character": 28}, {"line": 29, "character": 2}]);
    let params = json!({"textDocument": {"uri": client.uri("deck.inp")}, "positions": places});
    let found = client.request("textDocument/selectionRange", &params).expect("answered");
    let chain = |selection: &Value| {
        let mut ranges = Vec::new();
        let mut at = selection;
        while at.is_object() {
            ranges.push(shown(&at["range"]));
            at = &at["parent"];
        }
        ranges.join(" < ") + "\n"
    };
    let selections: String = found.as_array().unwrap().iter().map(chain).collect();
    insta::assert_snapshot!(format!("{folds}\n{selections}"));
}

#[test]
fn hints_and_lenses() {
    let mut client = Client::start();
    client.open("deck.inp", DECK);
    let whole = json!({"start": {"line": 0, "character": 0}, "end": {"line": 99, "character": 0}});
    let params = json!({"textDocument": {"uri": client.uri("deck.inp")}, "range": whole});
    let hints = client.request("textDocument/inlayHint", &params).expect("answered");
    let mut lines: Vec<String> = DECK.lines().map(str::to_owned).collect();
    for hint in hints.as_array().unwrap().iter().rev() {
        let line = usize::try_from(hint["position"]["line"].as_u64().unwrap()).unwrap();
        let at = usize::try_from(hint["position"]["character"].as_u64().unwrap()).unwrap();
        let padding = |key: &str| if hint[key] == true { " " } else { "" };
        let label = hint["label"].as_str().unwrap();
        lines[line].insert_str(at, &format!("{}⟨{label}⟩{}", padding("paddingLeft"), padding("paddingRight")));
    }
    let lenses = client.of("textDocument/codeLens", "deck.inp");
    let lens = |lens: &Value| {
        let command = &lens["command"];
        format!("{} {} {}\n", shown(&lens["range"]), command["title"].as_str().unwrap(), command["arguments"][0])
    };
    let lenses: String = lenses.as_array().unwrap().iter().map(lens).collect();
    insta::assert_snapshot!(format!("{}\n\n{lenses}", lines.join("\n")));
}

#[test]
fn colours_of_columns() {
    let mut client = Client::start();
    client.open("deck.inp", DECK);
    let tokens = |found: &Value| -> String {
        let types =
            ["keyword", "parameter", "string", "number", "comment", "variable", "type", "function", "enumMember"];
        let lines: Vec<&str> = DECK.lines().collect();
        let data: Vec<usize> = found["data"]
            .as_array()
            .unwrap()
            .iter()
            .map(|number| usize::try_from(number.as_u64().unwrap()).unwrap())
            .collect();
        let (mut line, mut start) = (0, 0);
        let mut text = String::new();
        for token in data.chunks_exact(5) {
            start = if token[0] == 0 { start + token[1] } else { token[1] };
            line += token[0];
            text +=
                &format!("{}:{} {} {}\n", line + 1, start + 1, types[token[3]], &lines[line][start..start + token[2]]);
        }
        text
    };
    let whole = tokens(&client.of("textDocument/semanticTokens/full", "deck.inp"));
    insta::assert_snapshot!(whole);
    let range = json!({"start": {"line": 12, "character": 0}, "end": {"line": 14, "character": 8}});
    let params = json!({"textDocument": {"uri": client.uri("deck.inp")}, "range": range});
    let part = tokens(&client.request("textDocument/semanticTokens/range", &params).expect("answered"));
    assert!(whole.contains(&part) && part.starts_with("13:1 keyword *GAP CONDUCTANCE\n"), "{part}");
}

#[test]
fn links_and_definitions_lead_into_included_files() {
    let mut client = Client::start();
    client.write(
        "joint.inp",
        "*PARAMETER\nk = 3.\n*SURFACE INTERACTION, NAME=Joint\n*GAP CONDUCTANCE\n<k>, 0.\n0., 1.\n",
    );
    let deck = "*INCLUDE, INPUT=joint.inp\n*SURFACE, NAME=TOP\nE, S1\n*SURFACE, NAME=LOW\nE, S2\n*CONTACT PAIR, INTERACTION=joint\nTOP, LOW\n*BOUNDARY\nTOP, 1\n";
    client.write_and_open("deck.inp", deck);
    let links = client.of("textDocument/documentLink", "deck.inp");
    assert_eq!(file_of(&links[0]["target"]), "joint.inp");
    assert_eq!(shown(&links[0]["range"]), "1:17-1:26");
    let places = |found: &Value| -> Vec<String> {
        let list = found.as_array().cloned().unwrap_or_else(|| vec![found.clone()]);
        list.iter().map(|place| format!("{} {}", file_of(&place["uri"]), shown(&place["range"]))).collect()
    };
    let definition = |client: &mut Client, place| {
        places(&client.at("textDocument/definition", "deck.inp", place).expect("answered"))
    };
    assert_eq!(definition(&mut client, (0, 20)), ["joint.inp 1:1-1:1"]);
    assert_eq!(definition(&mut client, (5, 28)), ["joint.inp 3:28-3:33"]);
    assert_eq!(definition(&mut client, (6, 1)), ["deck.inp 2:16-2:19"]);
    assert_eq!(definition(&mut client, (8, 1)), ["deck.inp 2:16-2:19"]);
    let params = |client: &Client, name: &str, line: u64, character: u64| {
        json!({
            "textDocument": {"uri": client.uri(name)},
            "position": {"line": line, "character": character},
            "context": {"includeDeclaration": true},
        })
    };
    let asked = params(&client, "deck.inp", 5, 28);
    let references = client.request("textDocument/references", &asked).expect("answered");
    assert_eq!(places(&references), ["joint.inp 3:28-3:33", "deck.inp 6:28-6:33"]);
    let asked = params(&client, "deck.inp", 6, 1);
    let references = client.request("textDocument/references", &asked).expect("answered");
    assert_eq!(places(&references), ["deck.inp 2:16-2:19", "deck.inp 7:1-7:4", "deck.inp 9:1-9:4"]);
    client.open("joint.inp", &std::fs::read_to_string(client.path("joint.inp")).expect("read"));
    let asked = params(&client, "joint.inp", 4, 1);
    let references = client.request("textDocument/references", &asked).expect("answered");
    assert_eq!(places(&references), ["joint.inp 2:1-2:2", "joint.inp 5:2-5:3"]);
    let highlights = client.at("textDocument/documentHighlight", "deck.inp", (6, 1)).expect("answered");
    assert_eq!(highlights.as_array().unwrap().len(), 3);
}
