//! docs/case-file.md, the reference of all tables and keys. `mpm-run --reference` prints it, and `resolved.toml` takes names,
//! order and defaults from it. A test checks that every key of the schema has a row.

/// The reference of the case file, Markdown.
pub const REFERENCE: &str = include_str!("../../../../docs/case-file.md");

/// A table of a case file.
pub(crate) struct ReferenceTable {
    /// Heading, such as `[clamp]`, or `[[clamp.stage]]` for a list of tables.
    pub(crate) heading: &'static str,
    /// Dotted path, such as `clamp.stage`.
    pub(crate) path: &'static str,
    pub(crate) keys: Vec<Key>,
}

/// A key of a [`ReferenceTable`]: its name (`pid.kp` is `kp` in the inline table `pid`), its accepted values, and its default, in words
/// or as `` `value` ``.
pub(crate) struct Key([&'static str; 3]);

/// The tables in the order of the page.
pub(crate) fn tables() -> impl Iterator<Item = ReferenceTable> {
    REFERENCE.split("\n## `").skip(1).filter_map(|section| {
        let (heading, body) = section.split_once('`')?;
        Some(ReferenceTable {
            heading,
            path: heading.trim_matches(['[', ']']),
            keys: body.lines().filter_map(Key::of_row).collect(),
        })
    })
}

impl ReferenceTable {
    pub(crate) fn repeated(&self) -> bool {
        self.heading.starts_with("[[")
    }
}

impl Key {
    fn of_row(row: &'static str) -> Option<Self> {
        let mut cells = row.strip_prefix("| `")?.split(" | ");
        let name = cells.next()?.trim_end_matches('`');
        Some(Self([name, cells.next()?, cells.next()?]))
    }

    pub(crate) fn name(&self) -> &'static str {
        self.0[0]
    }

    pub(crate) fn default(&self) -> &'static str {
        self.0[2]
    }

    /// The default as TOML, if it is a value.
    pub(crate) fn value(&self) -> Option<&'static str> {
        let value = self.default().strip_prefix('`')?.strip_suffix('`')?;
        (!value.contains('`')).then_some(value)
    }
}

#[cfg(test)]
mod tests {
    use std::path::Path;

    use super::*;
    use crate::case::Case;
    use crate::failure::RunFailure;

    const CASE: &str = r#"
[grid]
cell = "1 um"
[adhesive]
density = "1 g/cm3"
bulk_modulus = "1 GPa"
viscosity = "1 cP"
[contact]
law = "stick"
[[clamp.stage]]
kind = "hold"
[integrator]
scheme = "explicit"
[[body]]
material = "rigid"
box = { min = ["0 m", "0 m", "0 m"], max = ["1 um", "1 um", "1 um"] }
"#;

    /// `CASE` with another value at `path`, parsed.
    fn case_with(path: &str, value: &str) -> Result<Case, RunFailure> {
        let mut root: toml::Table = CASE.parse().unwrap();
        let value = toml::from_str::<toml::Table>(&format!("v = {value}")).unwrap()["v"].clone();
        let (tables, last) = path.rsplit_once('.').unwrap_or(("", path));
        let mut place = &mut root;
        for name in tables.split('.').filter(|name| !name.is_empty()) {
            let there = place.entry(name).or_insert(toml::Table::new().into());
            if !matches!(there, toml::Value::Array(list) if list[0].is_table()) && !there.is_table()
            {
                *there = toml::Table::new().into();
            }
            let first = match there {
                toml::Value::Array(list) => &mut list[0],
                other => other,
            };
            place = first.as_table_mut().unwrap();
        }
        place.insert(last.into(), value);
        Case::parse(&root.to_string(), Path::new("c"))
    }

    fn refusal(path: &str, value: &str) -> String {
        case_with(path, value).map_or_else(|refused| refused.to_string(), |_| String::new())
    }

    /// All keys of the schema below `path`. The error on an unknown key lists the keys of its table.
    fn schema(path: &str) -> Vec<String> {
        let said = refusal(format!("{path}.zzz").trim_start_matches('.'), "1");
        let Some((_, known)) = said.split_once("unknown field `zzz`, expected ") else {
            return vec![path.to_owned()];
        };
        let names = known.split('`').skip(1).step_by(2);
        let below = |name| schema(format!("{path}.{name}").trim_start_matches('.'));
        names.flat_map(below).collect()
    }

    fn rows() -> impl Iterator<Item = (String, Key)> {
        tables().flat_map(|table| {
            let path = move |key: Key| (format!("{}.{}", table.path, key.name()), key);
            table.keys.into_iter().map(path)
        })
    }

    #[test]
    fn every_key_has_a_row_and_every_row_a_key() {
        let mut schema = schema("");
        let mut told: Vec<String> = rows().map(|(path, _)| path).collect();
        assert!(schema.len() > 80 && schema.contains(&"clamp.pid.kp".to_owned()));
        schema.sort_unstable();
        told.sort_unstable();
        assert_eq!(
            told, schema,
            "rows of docs/case-file.md (left) against the schema"
        );
        let rows = REFERENCE.lines().filter(|line| line.starts_with("| `"));
        for row in rows {
            assert!(
                row.matches('|').count() == 5 && row.ends_with(". |"),
                "{row}"
            );
        }
    }

    /// The schema's error on a wrong value names the accepted form, which the row must state.
    #[test]
    fn values_are_of_the_form_told() {
        let mut checked = 0;
        for (path, Key([_, form, _])) in rows() {
            let [mut said, list] = ["\"?\"", "[\"?\", \"?\", \"?\"]"].map(|v| refusal(&path, v));
            let three = form.starts_with("three ");
            if three {
                said = list;
            }
            let parts: Vec<&str> = form.trim_start_matches("three ").split(", ").collect();
            let quantity = said.split_once("'?' is not a").and_then(|(_, rest)| {
                let (noun, _) = rest.split_once(": a number with one of the units")?;
                Some(noun.split_once(' ')?.1)
            });
            let wanted = if let Some(noun) = quantity {
                assert_eq!(
                    parts
                        .iter()
                        .filter(|part| part.trim_end_matches('s') == noun)
                        .count(),
                    1,
                    "{path}: {form}"
                );
                checked += 1;
                continue;
            } else if let Some((_, choices)) = said.split_once("'?' is not accepted: \"") {
                let names = choices.split('"').step_by(2);
                let names = names.filter(|name| !name.ends_with("needed"));
                names
                    .map(|name| format!("`\"{name}\"`"))
                    .collect::<Vec<_>>()
                    .join(", ")
            } else if said.contains("expected a boolean") {
                "`true`, `false`".into()
            } else {
                continue;
            };
            assert_eq!(form, wanted, "{path}");
            checked += 1;
        }
        assert!(checked > 50, "{checked}");
    }

    /// The default value in a row is the value of a case without the key.
    #[test]
    fn defaults_are_those_of_the_schema() {
        let plain = format!("{:?}", Case::parse(CASE, Path::new("c")).unwrap());
        let mut told = 0;
        for (path, key) in rows() {
            // Defaults that the resolution sets, not the schema; the tests of `resolved.toml` check them.
            let resolved = [
                "velocity",
                "name",
                "acceleration",
                "shape",
                "stop",
                "velocity_update",
            ];
            let Some(value) = key
                .value()
                .filter(|_| !resolved.contains(&key.name()) && path != "integrator.pressure")
            else {
                continue;
            };
            let named = case_with(&path, value).unwrap_or_else(|e| panic!("{path} = {value}: {e}"));
            assert_eq!(format!("{named:?}"), plain, "{path}");
            told += 1;
        }
        assert!(told >= 7, "{told}");
    }

    #[test]
    fn the_units_of_the_page_are_those_accepted() {
        let mut told = 0;
        for (name, units) in units::ALL {
            let (_, noun) = name.split_once(' ').unwrap();
            let Some(row) = REFERENCE
                .lines()
                .find(|line| line.starts_with(&format!("| {noun} | `")))
            else {
                continue;
            };
            // Micro sign and Greek mu look alike: both are accepted, the page lists one.
            let names = units.iter().map(|(name, _)| *name);
            let names = names.filter(|name| !name.starts_with('\u{3bc}'));
            let names: Vec<_> = names.map(|name| format!("`{name}`")).collect();
            assert_eq!(row, format!("| {noun} | {} |", names.join(", ")));
            told += 1;
        }
        assert_eq!(told, 13);
    }
}
