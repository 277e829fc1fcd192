//! CSV files by the names of their columns.

use std::path::Path;

use csv::StringRecord;
use particle_file::read_table;

use crate::{Error, check_origin};

/// Bytes of a row and of a cell: records of the csv crate, 195 bytes a row of three cells, and the numbers
/// of the columns that are drawn.
const RECORD: [u64; 2] = [180, 16];

/// A CSV file whose columns are asked for by name.
pub struct Table {
    name: String,
    headers: StringRecord,
    rows: Vec<StringRecord>,
}

impl Table {
    /// Reads a table; lines that begin with `#` are no rows.
    ///
    /// # Errors
    /// [`Error::Data`] for an unreadable file, or one that is no table with at least one row; those of [`check_origin`].
    pub fn read(path: &Path) -> Result<Self, Error> {
        check_origin(path)?;
        let name = path.display().to_string();
        let unreadable = |e| Error::Data(format!("cannot read '{name}': {e}"));
        let text = read_table(path, RECORD).map_err(unreadable)?;
        Self::of(&text, name)
    }

    fn of(text: &[u8], name: String) -> Result<Self, Error> {
        let mut reader = csv::ReaderBuilder::new()
            .comment(Some(b'#'))
            .trim(csv::Trim::All)
            .from_reader(text);
        let broken = |e: csv::Error| Error::Data(format!("'{name}' is not a CSV table: {e}"));
        let headers = reader.headers().map_err(broken)?.clone();
        let rows: Result<Vec<_>, _> = reader.records().collect();
        let rows = rows.map_err(broken)?;
        if rows.is_empty() {
            return Err(Error::Data(format!(
                "'{name}' has no data: at least one row below its header is needed"
            )));
        }
        Ok(Self {
            name,
            headers,
            rows,
        })
    }

    /// What the file is called.
    pub fn name(&self) -> &str {
        &self.name
    }

    /// The names of the columns.
    pub fn headers(&self) -> &StringRecord {
        &self.headers
    }

    /// The rows below them, each of as many cells.
    pub fn rows(&self) -> &[StringRecord] {
        &self.rows
    }

    /// Whether there is such a column.
    pub(crate) fn has(&self, column: &str) -> bool {
        self.headers.iter().any(|header| header == column)
    }

    /// The columns that stand before `column`.
    pub(crate) fn before(&self, column: &str) -> Result<Vec<&str>, Error> {
        let index = self.index(column)?;
        Ok(self.headers.iter().take(index).collect())
    }

    /// The cells of a column.
    pub(crate) fn texts(&self, column: &str) -> Result<Vec<&str>, Error> {
        let index = self.index(column)?;
        Ok(self.rows.iter().map(|row| &row[index]).collect())
    }

    /// The number of a column in the row of both sides of a table of `wp-metrics`; NaN where there is none.
    pub fn in_total(&self, column: &str) -> f64 {
        let (sides, cells) = (self.texts("side"), self.texts(column));
        let cell =
            (sides.iter().flatten().zip(cells.iter().flatten())).find(|cell| *cell.0 == "total");
        cell.and_then(|(_, cell)| cell.parse().ok())
            .unwrap_or(f64::NAN)
    }

    /// The numbers of a column, finite in every row.
    pub(crate) fn numbers(&self, column: &str) -> Result<Vec<f64>, Error> {
        self.numbers_but(column, |_| false)
    }

    /// The numbers of a column that has none in rows which `may_lack` one: an empty cell or NaN there is NaN.
    pub(crate) fn numbers_but(
        &self,
        column: &str,
        may_lack: impl Fn(usize) -> bool,
    ) -> Result<Vec<f64>, Error> {
        let number = |(row, cell): (usize, &str)| {
            let number = if cell.is_empty() { "NaN" } else { cell }.parse::<f64>();
            let number = number
                .ok()
                .filter(|n| n.is_finite() || n.is_nan() && may_lack(row));
            number.ok_or_else(|| {
                let line = self.rows[row].position().map_or(0, csv::Position::line);
                Error::Data(format!(
                    "'{}', line {line}, column {column}: '{cell}' is not a finite number",
                    self.name
                ))
            })
        };
        let cells = self.texts(column)?;
        cells.into_iter().enumerate().map(number).collect()
    }

    /// As [`Table::numbers_but`], but at least one row must hold a number.
    pub(crate) fn some_numbers(
        &self,
        column: &str,
        may_lack: impl Fn(usize) -> bool,
    ) -> Result<Vec<f64>, Error> {
        let numbers = self.numbers_but(column, may_lack)?;
        match numbers.iter().any(|n| n.is_finite()) {
            true => Ok(numbers),
            false => Err(Error::Data(format!(
                "'{}', column {column}: no row holds a finite number",
                self.name
            ))),
        }
    }

    fn index(&self, column: &str) -> Result<usize, Error> {
        let found = self.headers.iter().position(|header| header == column);
        found.ok_or_else(|| Error::Data(self.without(column)))
    }

    /// That it lacks a column.
    pub(crate) fn without(&self, column: &str) -> String {
        let present: Vec<&str> = self.headers.iter().collect();
        let (name, present) = (&self.name, present.join(", "));
        format!("'{name}' has no column {column}: it has {present}")
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn table(text: &str) -> Result<Table, Error> {
        Table::of(text.as_bytes(), "t.csv".into())
    }

    #[test]
    fn columns_go_by_name_and_cells_lack_numbers_only_where_they_may() {
        let table = table("# made by hand\na,b,c\n1,2,inf\n3,,nan\n").unwrap();
        assert_eq!(table.numbers("a").unwrap(), [1.0, 3.0]);
        let b = table.some_numbers("b", |row| row == 1).unwrap();
        assert!(b[0] == 2.0 && b[1].is_nan());
        let said = |found: Result<Vec<f64>, Error>| found.unwrap_err().to_string();
        let empty = "'t.csv', line 4, column b: '' is not a finite number";
        assert_eq!(said(table.numbers("b")), empty);
        let infinite = "'t.csv', line 3, column c: 'inf' is not a finite number";
        assert_eq!(said(table.numbers_but("c", |_| true)), infinite);
        let lacks = "'t.csv' has no column d: it has a, b, c";
        assert_eq!(said(table.numbers("d")), lacks);
    }

    #[test]
    fn a_table_has_at_least_one_row() {
        for text in ["", "a,b,c\n", "# nothing\n"] {
            let said = table(text).err().unwrap().to_string();
            assert!(said.contains("at least one row"), "{said}");
        }
    }
}
