//! The table of a sweep as text: its columns and cells, before any of them is understood.

use std::fmt::Display;
use std::path::{Path, PathBuf};

use cli::{Failure, Status};
use particle_file::read_table;

use crate::specimen;

/// What the cells of a column say.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum ColumnKind {
    /// A case file.
    Case,
    /// A bond file.
    Particles,
    /// An option of the synthetic specimen.
    Specimen(&'static str),
    /// A key of the case.
    Key,
}

/// Bytes of a row and of a cell: lists of texts.
const ROW_AND_CELL: [u64; 2] = [64, 64];
/// More columns than a case has keys: each is held against all others.
const MOST_COLUMNS: usize = 1000;

/// A table: every row has a cell for each column.
#[derive(Debug)]
pub struct Table {
    path: PathBuf,
    /// Name and kind of each column.
    pub columns: Vec<(String, ColumnKind)>,
    /// Trimmed cells; an empty one is the default.
    pub rows: Vec<Vec<String>>,
}

impl Table {
    /// Reads a CSV file with a header; lines that begin with `#` are passed over, and rows of empty
    /// cells alone, which spreadsheets write. Exit 3 for a file that cannot be read or is no CSV, exit 2 for an unknown
    /// column, a name twice, a row of another length. `-` is standard input.
    pub fn read(path: &Path) -> Result<Self, Failure> {
        let name = path.display();
        let text = read_table(path, ROW_AND_CELL)
            .map_err(|e| Failure::data(format!("cannot read '{name}': {e}")))?;
        Self::parse(path, &text)
    }

    fn parse(path: &Path, text: &[u8]) -> Result<Self, Failure> {
        let broken =
            |e: csv::Error| Failure::data(format!("'{}' is not a CSV table: {e}", path.display()));
        let mut reader = csv::ReaderBuilder::new()
            .comment(Some(b'#'))
            .trim(csv::Trim::All)
            .flexible(true)
            // Spreadsheets put a mark of three bytes before the header.
            .from_reader(text.strip_prefix(b"\xef\xbb\xbf").unwrap_or(text));
        let header = reader.headers().map_err(broken)?.clone();
        let mut table = Self {
            path: path.to_owned(),
            columns: Vec::new(),
            rows: Vec::new(),
        };
        if header.len() > MOST_COLUMNS {
            return Err(table.wrong(format_args!(
                "it has {} columns, and a sweep at most {MOST_COLUMNS}",
                header.len()
            )));
        }
        for name in &header {
            if table.columns.iter().any(|(other, _)| other == name) {
                return Err(table.wrong(format_args!("there are two columns '{name}'")));
            }
            let kind = kind_of(name).map_err(|why| table.wrong(why))?;
            table.columns.push((name.to_owned(), kind));
        }
        for record in reader.records() {
            let record = record.map_err(broken)?;
            if record.iter().all(str::is_empty) {
                continue;
            }
            if record.len() != header.len() {
                return Err(table.wrong(format_args!(
                    "row {} has {} cells and the header {}: put a cell with a comma in quotes",
                    table.rows.len() + 1,
                    record.len(),
                    header.len()
                )));
            }
            table.rows.push(record.iter().map(str::to_owned).collect());
        }
        match table.rows.is_empty() {
            true => Err(table.wrong("it has no row below its header")),
            false => Ok(table),
        }
    }

    /// A sentence about the table (exit 2).
    fn wrong(&self, what: impl Display) -> Failure {
        Failure::usage(format!("'{}': {what}", self.path.display()))
    }

    /// A sentence about a row, counted from 0 (exit 2).
    pub fn wrong_row(&self, row: usize, what: impl Display) -> Failure {
        self.failed_row(row, Status::Usage, what)
    }

    /// As [`Table::wrong_row`], with another exit status.
    pub fn failed_row(&self, row: usize, status: Status, what: impl Display) -> Failure {
        let name = self.path.display();
        Failure::new(status, format!("'{name}': row {}: {what}", row + 1))
    }

    /// A sentence about a cell (exit 2).
    pub fn wrong_cell(&self, row: usize, column: usize, what: impl Display) -> Failure {
        let name = &self.columns[column].0;
        self.wrong(format_args!("row {}, column {name}: {what}", row + 1))
    }

    /// A path of a cell, seen from the folder of the table.
    pub fn beside(&self, cell: &str) -> PathBuf {
        self.path.parent().unwrap_or(Path::new("")).join(cell)
    }

    /// The column of a kind and its cell in a row, where it is not empty.
    pub fn cell(&self, row: usize, kind: &ColumnKind) -> Option<(usize, &str)> {
        let found = self.given(row).find(|(_, own, _)| *own == kind);
        found.map(|(column, _, cell)| (column, cell))
    }

    /// The cells of a row that are not empty, by column.
    pub fn given(&self, row: usize) -> impl Iterator<Item = (usize, &ColumnKind, &str)> {
        let cells = self.rows[row].iter().map(String::as_str).enumerate();
        cells
            .filter(|(_, cell)| !cell.is_empty())
            .map(|(i, cell)| (i, &self.columns[i].1, cell))
    }
}

fn kind_of(name: &str) -> Result<ColumnKind, String> {
    match name {
        "case" => return Ok(ColumnKind::Case),
        "particles" => return Ok(ColumnKind::Particles),
        _ => {}
    }
    if let Some(option) = name.strip_prefix("specimen.") {
        let options = specimen::QUICK.map(|(known, _)| known);
        let known = options.into_iter().find(|known| *known == option);
        return known.map(ColumnKind::Specimen).ok_or_else(|| {
            let options = options.join(", ");
            format!("'{name}' is not a column of a sweep; of the specimen there are {options}")
        });
    }
    let key = name.contains('.') && !name.contains(|c: char| c.is_whitespace() || "=;".contains(c));
    key.then_some(ColumnKind::Key).ok_or_else(|| {
        let hint = match name.contains([';', '\t']) {
            true => " (columns are separated by commas)",
            false => "",
        };
        format!("'{name}' is not a column of a sweep{hint}: accepted are case, particles, specimen.seed and the like, and keys of the case such as adhesive.viscosity")
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    fn parsed(text: &str) -> Result<Table, Failure> {
        Table::parse(Path::new("f/t.csv"), text.as_bytes())
    }

    #[test]
    fn columns_are_told_and_cells_trimmed() {
        let text = "\u{feff}# mine\ncase, specimen.seed ,adhesive.viscosity\npf,1, 1300 cP\n,2,\n";
        let table = parsed(text).unwrap();
        let kinds = [
            ColumnKind::Case,
            ColumnKind::Specimen("seed"),
            ColumnKind::Key,
        ];
        assert!(table.columns.iter().map(|c| &c.1).eq(&kinds));
        assert_eq!(table.rows[0][2], "1300 cP");
        assert_eq!(table.given(1).count(), 1);
        assert_eq!(table.beside("bond"), Path::new("f/bond"));
    }

    #[test]
    fn rows_of_empty_cells_are_none() {
        let table = parsed("a.b,c.d\n,\n1,2\n , \n,,,,\n\n3,4\n,\n").unwrap();
        assert_eq!(table.rows, [["1", "2"], ["3", "4"]]);
    }
}
