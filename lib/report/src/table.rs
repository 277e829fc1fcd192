//! Tables of the tools, for reading.

use crate::{Error, Labelled, html, read};

/// Rows of a table beyond which a page would not be read: maps and histories are drawn instead.
const MOST_ROWS: usize = 1000;
const MOST_BYTES: u64 = 1 << 20;

/// A CSV table.
pub struct Table {
    caption: String,
    headers: Vec<String>,
    rows: Vec<Vec<String>>,
}

impl Table {
    /// Reads a table of at most 1000 rows.
    ///
    /// # Errors
    /// An unreadable file, or none of this kind or length.
    pub fn read(file: &Labelled) -> Result<Self, Error> {
        let name = file.path.display().to_string();
        let broken = |e: csv::Error| Error(format!("'{name}' is not a CSV table: {e}"));
        let bytes = read(&file.path, MOST_BYTES)?;
        let mut reader = csv::ReaderBuilder::new()
            .comment(Some(b'#'))
            .from_reader(bytes.as_slice());
        let words = |record: &csv::StringRecord| record.iter().map(str::to_owned).collect();
        let headers: Vec<String> = words(reader.headers().map_err(broken)?);
        let rows: Vec<Vec<String>> = (reader.records())
            .map(|record| record.map(|record| words(&record)))
            .collect::<Result<_, _>>()
            .map_err(broken)?;
        if rows.is_empty() || rows.len() > MOST_ROWS {
            return Err(Error(format!(
                "'{name}' has {} rows: a page takes tables of 1 to {MOST_ROWS}",
                rows.len()
            )));
        }
        Ok(Self {
            caption: file.label.clone(),
            headers,
            rows,
        })
    }

    /// The number in `column` of the first row with `key` in its column; NaN where there is none.
    pub(crate) fn number(&self, (key_column, key): (&str, &str), column: &str) -> f64 {
        let find = |name: &str| self.headers.iter().position(|header| header == name);
        let found = find(key_column).zip(find(column)).and_then(|(by, of)| {
            let row = self.rows.iter().find(|row| row[by] == key)?;
            row[of].parse().ok()
        });
        found.unwrap_or(f64::NAN)
    }

    /// The table as HTML: columns that hold something, numbers to four digits.
    pub(crate) fn to_html(&self) -> String {
        let holds = |column: &usize| self.rows.iter().any(|row| !row[*column].is_empty());
        let columns: Vec<usize> = (0..self.headers.len()).filter(holds).collect();
        let headers: Vec<String> = columns.iter().map(|&c| words(&self.headers[c])).collect();
        let headers: Vec<&str> = headers.iter().map(String::as_str).collect();
        let cell = |text: &String| match text.parse() {
            Ok(number) if text.contains(['.', 'e']) => html::rounded(number),
            _ => text.clone(),
        };
        let row = |row: &Vec<String>| columns.iter().map(|&c| cell(&row[c])).collect();
        let rows: Vec<Vec<String>> = self.rows.iter().map(row).collect();
        html::table(&self.caption, &headers, &rows)
    }
}

/// `total WP (um)` of `total_wp_um`: the unit behind the name.
fn words(name: &str) -> String {
    let (name, unit) = match name.rsplit_once('_') {
        Some((name, unit @ ("um" | "um2" | "um3" | "Pa" | "s"))) => (name, format!(" ({unit})")),
        _ => (name, String::new()),
    };
    let word = |word: &str| match word {
        "wp" | "ep" => word.to_uppercase(),
        other => other.to_owned(),
    };
    name.split('_').map(word).collect::<Vec<_>>().join(" ") + &unit
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn columns_are_named_with_their_units_behind() {
        for (name, said) in [
            ("total_wp_um", "total WP (um)"),
            ("paper_case", "paper case"),
            ("pressure_Pa", "pressure (Pa)"),
            ("note", "note"),
        ] {
            assert_eq!(words(name), said);
        }
    }

    #[test]
    fn numbers_are_rounded_empty_columns_left_out_and_what_is_no_table_is_refused() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("t.csv");
        let read = |text: &str| {
            std::fs::write(&path, text).unwrap();
            let label = "T".to_owned();
            Table::read(&Labelled {
                label,
                path: path.clone(),
            })
        };
        let page = read("case,wp_um,note\nflip,7.801234,\n").unwrap().to_html();
        assert!(page.contains("<td class=\"number\">7.801</td>"), "{page}");
        assert!(!page.contains("note"), "{page}");
        assert!(page.contains("<th scope=\"row\">flip</th>"), "{page}");
        for bad in ["", "a,b\n", "a,b\n1\n", &"a\n1\n".repeat(1001)] {
            assert!(read(bad).is_err(), "{bad}");
        }
    }
}
