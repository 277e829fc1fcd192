//! `--set`: keys of a case changed from the command line.

use std::path::Path;

use crate::case::{Case, case_text};
use crate::failure::RunFailure;

/// The text of the case file at `path` with `changes` (`key=value`), which parses as a case.
///
/// # Errors
/// [`RunFailure::Usage`]: a file that cannot be read, is no case or does not become one.
pub fn changed_case(path: &Path, changes: &[String]) -> Result<String, RunFailure> {
    let text = changed(&case_text(path)?, path, changes)?;
    Case::parse(&text, path)?;
    Ok(text)
}

/// The case text with `changes` applied; the text itself when there are none, so that errors
/// keep the user's own line numbers.
pub(crate) fn changed(
    original: &str,
    path: &Path,
    changes: &[String],
) -> Result<String, RunFailure> {
    if changes.is_empty() {
        return Ok(original.to_owned());
    }
    Case::parse(original, path)?;
    let mut root = toml::from_str::<toml::Table>(original)
        .map(toml::Value::Table)
        .map_err(|e| RunFailure::Usage(e.message().into()))?;
    for change in changes {
        let refuse = |why: &str| RunFailure::Usage(format!("--set {change}: {why}"));
        let (key, value) = change
            .split_once('=')
            .ok_or_else(|| refuse("KEY=VALUE is needed"))?;
        // A word that is no TOML value is meant as a string: --set grid.shape=linear.
        let value = match toml::from_str::<toml::Table>(&format!("v = {value}")) {
            Ok(mut table) => table.remove("v").unwrap_or_else(|| value.into()),
            Err(_) => value.into(),
        };
        let mut path: Vec<&str> = key.split('.').map(str::trim).collect();
        let last = path
            .pop()
            .filter(|k| !k.is_empty())
            .ok_or_else(|| refuse("the key is empty"))?;
        let mut place = &mut root;
        for part in path {
            place = enter(place, part).map_err(|why| refuse(&why))?;
        }
        match (place, last.parse::<usize>()) {
            (toml::Value::Array(list), Ok(i)) if i < list.len() => list[i] = value,
            (toml::Value::Table(table), _) => {
                table.insert(last.to_owned(), value);
            }
            _ => return Err(refuse(&format!("there is no '{last}' to set"))),
        }
    }
    let text = toml::to_string(&root).map_err(|e| RunFailure::Usage(e.to_string()))?;
    // Lines of this text are nobody's: a refusal names the changes instead.
    match toml::from_str::<Case>(&text) {
        Ok(_) => Ok(text),
        Err(error) => Err(RunFailure::Usage(format!(
            "--set {}: {}",
            changes.join(" --set "),
            error.message().replace('\n', " ")
        ))),
    }
}

/// The value below `place` at `part`: a key of a table, made if absent, or an index of an array.
fn enter<'a>(place: &'a mut toml::Value, part: &str) -> Result<&'a mut toml::Value, String> {
    match place {
        toml::Value::Table(table) => Ok(table
            .entry(part)
            .or_insert_with(|| toml::Table::new().into())),
        toml::Value::Array(list) => {
            let length = list.len();
            let index = part.parse::<usize>().ok();
            index
                .and_then(|i| list.get_mut(i))
                .ok_or_else(|| format!("'{part}' is no index of an array of {length}"))
        }
        _ => Err(format!("nothing can be set below '{part}'")),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn keys_can_be_changed_from_the_command_line() {
        let original = "[grid]\ncell = \"2.9 um\"\n[adhesive]\ndensity = \"1 g/cm3\"\nbulk_modulus = \"1 GPa\"\nviscosity = \"1 cP\"\n[integrator]\nscheme = \"explicit\"\n";
        let set = |original: &str, changes: &[&str]| {
            let changes: Vec<String> = changes.iter().map(ToString::to_string).collect();
            let text = changed(original, Path::new("c"), &changes)?;
            Case::parse(&text, Path::new("c"))
        };
        let changes = [
            "grid.cell=1.45 um",
            "integrator.cfl=0.25",
            "grid.dimensions=2",
            "clamp.closing_speed=\"1 m/s\"",
        ];
        let case = set(original, &changes).unwrap();
        assert!((case.grid.cell.si(1.0) - 1.45e-6).abs() < 1e-18);
        assert_eq!((case.integrator.cfl, case.grid.dimensions), (Some(0.25), 2));
        assert!(case.clamp.is_some());
        let body = format!(
            "{original}[[body]]\nmaterial = \"rigid\"\nbox = {{ min = [\"0 m\", \"0 m\", \"0 m\"], max = [\"1 m\", \"1 m\", \"1 m\"] }}\n"
        );
        let case = set(&body, &["body.0.box.min.1=0.5 m"]).unwrap();
        assert_eq!(case.body[0].corners.min[1].si(), 0.5);
        for absent in ["body.1.box.min.1=0.5 m", "body.0.box.min.3=0.5 m"] {
            assert!(set(&body, &[absent]).is_err());
        }
        assert!(set(original, &["nonsense"]).is_err());
        let said = set(original, &["grid.cel=1"]).unwrap_err().to_string();
        assert!(said.starts_with("--set grid.cel=1: "), "{said}");
        assert!(said.contains("`cell`"), "{said}");
    }
}
