//! The table of constants in docs/methods.md against the crates of the two schemes.

use std::collections::BTreeSet;
use std::fs;
use std::path::Path;

/// Whose constants the table holds.
const CRATES: [&str; 3] = ["filling", "saddle-point", "mpm"];

/// Crate, file from the crate's `src`, name and value.
type Constant = [String; 4];

/// A sentence about each constant that the table lacks or has otherwise, and about each guard that is
/// no test.
pub fn differences(root: &Path) -> Vec<String> {
    let methods = fs::read_to_string(root.join("docs/methods.md")).expect("docs/methods.md");
    let (table, mut said) = (table(&methods), Vec::new());
    let (mut code, mut functions) = (BTreeSet::new(), String::new());
    for name in CRATES {
        let lib = root.join("lib").join(name);
        each_source(&lib.join("src"), "", &mut |file, text| {
            functions.push_str(text);
            if !file.ends_with("tests.rs") {
                code.extend(constants(name, file, text));
            }
        });
        each_source(&lib.join("tests"), "", &mut |_, text| {
            functions.push_str(text)
        });
    }
    for more in ["lib/physics/src", "tests/pipeline", "tests/verification"] {
        each_source(&root.join(more), "", &mut |_, text| {
            functions.push_str(text)
        });
    }
    for [name, file, constant, value] in code.difference(&table) {
        said.push(format!(
            "not in the table: {constant} = {value} in lib/{name}/src/{file}"
        ));
    }
    for [name, file, constant, value] in table.difference(&code) {
        said.push(format!(
            "not in the code: {constant} = {value} in lib/{name}/src/{file}"
        ));
    }
    for row in rows(&methods).filter(|row| row.len() == 8 && row[7].starts_with("none")) {
        // What only the speed or the layout of memory depends on no test can tell.
        if !row[5].contains("layout") && !row[5].contains("no result") {
            said.push(format!("nothing guards {}", row[0]));
        }
    }
    for guard in guards(&methods) {
        if !functions.contains(&format!("fn {guard}(")) {
            said.push(format!("no test {guard}"));
        }
    }
    said
}

/// The constants of a source file; marks such as `u32::MAX`, names of lanes and values that are not
/// numbers left out.
fn constants(name: &str, file: &str, text: &str) -> Vec<Constant> {
    let text = text.split("\nmod tests {").next().unwrap_or_default();
    let mut list = Vec::new();
    for line in text.lines() {
        let Some((_, rest)) = line.split_once("const ") else {
            continue;
        };
        let parts = rest.split_once(": ").and_then(|(constant, rest)| {
            let (kind, value) = rest.split_once(" = ")?;
            Some((constant, kind, value.strip_suffix(';')?))
        });
        let Some((constant, kind, value)) = parts else {
            continue;
        };
        let upper = constant
            .chars()
            .all(|c| c.is_ascii_uppercase() || c == '_' || c.is_ascii_digit());
        let number = !["Self", "bool", "Lane"].contains(&kind) && !kind.contains("str");
        if upper && number && !value.ends_with("::MAX") {
            list.push([name, file, constant, value].map(str::to_owned));
        }
    }
    list
}

/// The section on constants.
fn section(methods: &str) -> &str {
    let section = methods.split("\n## 4. ").nth(1).unwrap_or_default();
    section.split("\n## ").next().unwrap_or_default()
}

fn rows(methods: &str) -> impl Iterator<Item = Vec<&str>> {
    (section(methods)
        .lines()
        .filter(|line| line.starts_with("| ")))
    .map(|line| {
        let cells = line.split(" | ");
        cells.map(|cell| cell.trim_matches(['|', ' '])).collect()
    })
}

/// The rows of the table, each of the crate that the last heading with a crate's name says.
fn table(methods: &str) -> BTreeSet<Constant> {
    let mut list = BTreeSet::new();
    let mut name = "";
    for row in rows(methods) {
        let is_heading = row[0].starts_with("**");
        let named = |name: &&str| row[0].contains(&format!("`{name}`"));
        if let Some(of) = CRATES.into_iter().find(named)
            && is_heading
        {
            name = of;
        }
        if let [constant, file, value, ..] = row[..]
            && constant.starts_with('`')
        {
            list.insert([name, file, constant, value].map(|s| s.trim_matches('`').to_owned()));
        }
    }
    list
}

/// Names of tests in the last column of the table and in the paragraph below it.
fn guards(methods: &str) -> Vec<String> {
    let named = |text: &str| -> Vec<String> {
        (text.split('`').skip(1).step_by(2))
            .filter(|s| {
                s.contains('_') && s.chars().all(|c| matches!(c, 'a'..='z' | '0'..='9' | '_'))
            })
            .map(str::to_owned)
            .collect()
    };
    let below = section(methods)
        .lines()
        .filter(|line| !line.starts_with('|'));
    let mut list = named(&below.collect::<Vec<_>>().join("\n"));
    for row in rows(methods).filter(|row| row.len() > 5) {
        list.extend(named(row[row.len() - 1]));
    }
    list
}

fn each_source(folder: &Path, inside: &str, seen: &mut impl FnMut(&str, &str)) {
    for entry in fs::read_dir(folder).expect("a folder of sources") {
        let path = entry.expect("an entry").path();
        let name = path
            .file_name()
            .unwrap_or_default()
            .to_string_lossy()
            .into_owned();
        let name = if inside.is_empty() {
            name
        } else {
            format!("{inside}/{name}")
        };
        if path.is_dir() {
            each_source(&path, &name, seen);
        } else if name.ends_with(".rs") {
            seen(&name, &fs::read_to_string(&path).expect("a source"));
        }
    }
}

#[test]
fn a_changed_constant_differs() {
    let text = "/// Doc.\npub const HALF: f64 = 0.5;\nconst NONE: u32 = u32::MAX;\nconst WORD: &str = \"a\";\n";
    let found = constants("mpm", "a.rs", text);
    assert_eq!(found, [["mpm", "a.rs", "HALF", "0.5"].map(str::to_owned)]);
    let row = |value: &str| {
        format!(
            "\n## 4. N\n\n| **`mpm`** | |\n| `HALF` | `a.rs` | `{value}` | - | w | d | none |\n\n## 5. M\n"
        )
    };
    assert!(table(&row("0.5")).contains(&found[0]) && !table(&row("0.25")).contains(&found[0]));
}
