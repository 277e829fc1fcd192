//! CSV files by the names of their columns.

use std::io::Read;
use std::path::Path;

use csv::StringRecord;
use particle_file::read_table;

use crate::Error;

/// Bytes of a row and of a cell: records of the csv crate, 195 bytes a row of three cells, and the numbers
/// of the columns that are drawn.
const RECORD: [u64; 2] = [180, 16];

/// A CSV file whose columns are asked for by name.
pub(crate) struct Table {
    name: String,
    headers: StringRecord,
    rows: Vec<StringRecord>,
}

impl Table {
    pub(crate) fn read(path: &Path) -> Result<Self, Error> {
        let name = path.display().to_string();
        let unreadable = |e| Error::Data(format!("cannot read '{name}': {e}"));
        let text = read_table(path, RECORD).map_err(unreadable)?;
        Self::from_reader(text.as_slice(), name)
    }

    pub(crate) fn from_reader(reader: impl Read, name: String) -> Result<Self, Error> {
        let mut reader = csv::ReaderBuilder::new()
            .comment(Some(b'#'))
            .trim(csv::Trim::All)
            .from_reader(reader);
        let broken = |e: csv::Error| Error::Data(format!("'{name}' is not a CSV table: {e}"));
        let headers = reader.headers().map_err(broken)?.clone();
        let rows = reader
            .records()
            .collect::<Result<Vec<_>, _>>()
            .map_err(broken)?;
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

    pub(crate) fn name(&self) -> &str {
        &self.name
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

    /// The numbers of a column; empty cells are NaN.
    pub(crate) fn numbers(&self, column: &str) -> Result<Vec<f64>, Error> {
        let number = |(row, cell): (usize, &str)| {
            if cell.is_empty() {
                return Ok(f64::NAN);
            }
            cell.parse().map_err(|_| {
                Error::Data(format!(
                    "'{}', row {} below the header, column {column}: '{cell}' is not a number",
                    self.name,
                    row + 1
                ))
            })
        };
        let cells = self.texts(column)?;
        cells.into_iter().enumerate().map(number).collect()
    }

    /// As [`Table::numbers`], but the column must hold at least one finite number.
    pub(crate) fn data(&self, column: &str) -> Result<Vec<f64>, Error> {
        let numbers = self.numbers(column)?;
        if numbers.iter().any(|n| n.is_finite()) {
            Ok(numbers)
        } else {
            Err(Error::Data(format!(
                "'{}', column {column}: no row holds a finite number",
                self.name
            )))
        }
    }

    fn index(&self, column: &str) -> Result<usize, Error> {
        let found = self.headers.iter().position(|header| header == column);
        found.ok_or_else(|| {
            let present: Vec<&str> = self.headers.iter().collect();
            Error::Data(format!(
                "'{}' has no column {column}: it has {}",
                self.name,
                present.join(", ")
            ))
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn table(text: &str) -> Result<Table, Error> {
        Table::from_reader(text.as_bytes(), "t.csv".into())
    }

    #[test]
    fn columns_go_by_name_and_gaps_are_nan() {
        let table = table("# made by hand\na,b\n1,2\n3,\n").unwrap();
        assert_eq!(table.numbers("a").unwrap(), [1.0, 3.0]);
        let b = table.data("b").unwrap();
        assert!(b[0] == 2.0 && b[1].is_nan());
    }

    #[test]
    fn refusals_name_file_row_and_column() {
        let said = |result: Result<Vec<f64>, Error>| result.unwrap_err().to_string();
        let good = table("a,b\n1,x\nNaN,\n").unwrap();
        let missing = said(good.numbers("c"));
        assert!(missing.contains("no column c") && missing.contains("a, b"));
        let wrong = said(good.numbers("b"));
        assert!(wrong.contains("row 1") && wrong.contains("'x'"), "{wrong}");
        let nothing = said(table("a\nNaN\n").unwrap().data("a"));
        assert!(nothing.contains("no row holds a finite number"));
        assert!(table("a,b\n").is_err());
        assert!(table("").is_err());
        assert!(table("a,b\n1\n").is_err());
    }
}
