//! Tables of the tools, for reading.

use figures::{Table, worded};

use crate::html::{self, rounded};
use crate::{Error, Labelled};

/// Rows of a table beyond which a page would not be read: maps and histories are drawn instead.
const MOST_ROWS: usize = 1000;

/// A CSV table of at most 1000 rows as HTML: columns that hold something, numbers to four digits.
///
/// # Errors
/// An unreadable file, or none of this kind or length.
pub fn table(file: &Labelled) -> Result<String, Error> {
    let table = Table::read(&file.path)?;
    let rows = table.rows();
    if rows.len() > MOST_ROWS {
        return Err(Error::Data(format!(
            "'{}' has {} rows: a page accepts tables of 1 to {MOST_ROWS}",
            table.name(),
            rows.len()
        )));
    }
    let held = |column: &(usize, &str)| rows.iter().any(|row| !row[column.0].is_empty());
    let columns = table.headers().iter().enumerate().filter(held);
    // Pages have units as the tables have.
    let plain = |name: &str| {
        worded(name)
            .replace('µ', "u")
            .replace('²', "2")
            .replace('³', "3")
    };
    let named = columns.map(|(c, name)| (c, plain(name)));
    let (columns, headers): (Vec<usize>, Vec<String>) = named.unzip();
    let cell = |text: &str| match text.parse() {
        Ok(number) if text.contains(['.', 'e']) => rounded(number),
        _ => text.to_owned(),
    };
    let cells = rows
        .iter()
        .map(|row| columns.iter().map(|&c| cell(&row[c])).collect());
    let cells: Vec<Vec<String>> = cells.collect();
    Ok(html::table(&file.label, &headers, &cells))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_are_rounded_empty_columns_left_out_and_what_is_no_table_is_refused() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("t.csv");
        let read = |text: &str| {
            std::fs::write(&path, text).unwrap();
            let (label, path) = ("T".to_owned(), path.clone());
            table(&Labelled { label, path })
        };
        let page = read("case,adhesive.viscosity_Pa_s,wp_um,note\nflip,1,7.801234,\n").unwrap();
        for part in [
            "<td class=\"number\">7.801</td>",
            "<th scope=\"row\">flip</th>",
            "<th scope=\"col\">case</th>",
            "<th scope=\"col\" class=\"number\">WP (um)</th>",
            "class=\"number\">adhesive.viscosity (Pa s)</th>",
        ] {
            assert!(page.contains(part), "{page}");
        }
        assert!(!page.contains("note"), "{page}");
        for bad in ["", "a,b\n", "a,b\n1\n", &"a\n1\n".repeat(1001)] {
            assert!(read(bad).is_err(), "{bad}");
        }
    }
}
