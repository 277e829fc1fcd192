//! Compressed sparse rows with 32-bit columns, and the row products the solver is made of.

use rayon::prelude::*;

use crate::SolveError;
use crate::vector::{CHUNK, Real, for_each};

/// A sparse matrix by rows: `columns` and `values` of row `i` are the entries
/// `row_start[i]..row_start[i + 1]`, columns ascending and unique.
#[derive(Clone)]
pub struct Csr<T> {
    n_columns: usize,
    row_start: Vec<u32>,
    columns: Vec<u32>,
    values: Vec<T>,
}

/// Entries of a row above which the search for a column takes longer than sorting.
const LONG: usize = 64;

/// One row under assembly; entries to the same column add up.
#[derive(Debug, Default)]
pub struct RowEntries {
    entries: Vec<(u32, f64)>,
}

impl RowEntries {
    /// Adds `value` at `column`.
    pub fn add(&mut self, column: usize, value: f64) {
        // A column beyond u32 stays out of range and is refused when the row is stored.
        let column = u32::try_from(column).unwrap_or(u32::MAX);
        if self.entries.len() >= LONG {
            self.entries.push((column, value));
            return;
        }
        match self.entries.iter_mut().find(|entry| entry.0 == column) {
            Some(entry) => entry.1 += value,
            None => self.entries.push((column, value)),
        }
    }

    /// Sorts the columns and makes them unique. Duplicates in long rows are added up here, in the order of their values.
    fn finish(&mut self) {
        if self.entries.len() < LONG {
            self.entries.sort_unstable_by_key(|entry| entry.0);
            return;
        }
        self.entries.sort_by_key(|entry| entry.0);
        self.entries.dedup_by(|next, sum| {
            let same = next.0 == sum.0;
            if same {
                sum.1 += next.1;
            }
            same
        });
    }
}

/// Rows of one chunk of a matrix, before they are joined or packed.
pub(crate) struct Rows<T> {
    row_end: Vec<u32>,
    columns: Vec<u32>,
    values: Vec<T>,
}

impl<T> Rows<T> {
    /// Columns and values of its row `row`.
    pub(crate) fn row(&self, row: usize) -> (&[u32], &[T]) {
        let start = (row.checked_sub(1)).map_or(0, |before| self.row_end[before]);
        let range = start as usize..self.row_end[row] as usize;
        (&self.columns[range.clone()], &self.values[range])
    }

    /// Number of rows.
    pub(crate) fn len(&self) -> usize {
        self.row_end.len()
    }
}

impl<T: Real> Csr<T> {
    /// Assembles row by row, in parallel over fixed ranges of rows: `fill(row, entries)` adds the
    /// entries of one row in any order, repeats allowed.
    ///
    /// # Errors
    /// [`SolveError::Matrix`] when an entry is not finite or lies outside `n_columns`, or when
    /// rows, columns or entries do not fit 32 bits.
    pub fn assemble(
        n_rows: usize,
        n_columns: usize,
        fill: impl Fn(usize, &mut RowEntries) + Sync,
    ) -> Result<Self, SolveError> {
        let chunks: Vec<Rows<T>> = assemble_chunks(n_rows, n_columns, fill)?;
        let total: usize = chunks.iter().map(|rows| rows.columns.len()).sum();
        if total > u32::MAX as usize {
            return Err(SolveError::Matrix(format!(
                "{total} entries exceed the 32-bit index range"
            )));
        }
        let mut row_start = Vec::with_capacity(n_rows + 1);
        row_start.push(0);
        let mut columns = vec![0; total];
        let mut values = vec![T::default(); total];
        // Every chunk is copied to its place in parallel and released at once.
        let mut places = Vec::with_capacity(chunks.len());
        let (mut columns_left, mut values_left) = (&mut columns[..], &mut values[..]);
        for rows in &chunks {
            let before = (total - columns_left.len()) as u32;
            row_start.extend(rows.row_end.iter().map(|end| before + end));
            let (columns, after) = columns_left.split_at_mut(rows.columns.len());
            columns_left = after;
            let (values, after) = values_left.split_at_mut(rows.values.len());
            values_left = after;
            places.push((columns, values));
        }
        (chunks.into_par_iter().zip(places)).for_each(|(rows, (columns, values))| {
            columns.copy_from_slice(&rows.columns);
            values.copy_from_slice(&rows.values);
        });
        Ok(Self {
            n_columns,
            row_start,
            columns,
            values,
        })
    }

    /// Number of rows.
    pub fn n_rows(&self) -> usize {
        self.row_start.len() - 1
    }

    /// Number of columns.
    pub fn n_columns(&self) -> usize {
        self.n_columns
    }

    /// Columns and values of row `row`.
    pub fn row(&self, row: usize) -> (&[u32], &[T]) {
        let range = self.row_start[row] as usize..self.row_start[row + 1] as usize;
        (&self.columns[range.clone()], &self.values[range])
    }

    /// The entry on the diagonal of every row, zero where none is stored.
    pub fn diagonal(&self) -> Vec<T> {
        let mut diagonal = vec![T::default(); self.n_rows()];
        for_each(&mut diagonal, |row, out| {
            *out = value_at(self.row(row), row)
        });
        diagonal
    }

    /// The transposed matrix.
    pub fn transpose(&self) -> Self {
        let mut row_start = vec![0u32; self.n_columns + 1];
        for &column in &self.columns {
            row_start[column as usize + 1] += 1;
        }
        for i in 0..self.n_columns {
            row_start[i + 1] += row_start[i];
        }
        let mut next = row_start.clone();
        let mut columns = vec![0u32; self.columns.len()];
        let mut values = vec![T::default(); self.values.len()];
        for row in 0..self.n_rows() {
            let (row_columns, row_values) = self.row(row);
            for (&column, &value) in row_columns.iter().zip(row_values) {
                let slot = &mut next[column as usize];
                columns[*slot as usize] = row as u32;
                values[*slot as usize] = value;
                *slot += 1;
            }
        }
        Self {
            n_columns: self.n_rows(),
            row_start,
            columns,
            values,
        }
    }

    /// The same matrix in another precision.
    pub(crate) fn cast<U: Real>(&self) -> Csr<U> {
        let mut values = vec![U::default(); self.values.len()];
        for_each(&mut values, |i, out| {
            *out = U::nearest(self.values[i].into())
        });
        Csr {
            n_columns: self.n_columns,
            row_start: self.row_start.clone(),
            columns: self.columns.clone(),
            values,
        }
    }

    /// Row `row` times `x`, in the precision of the matrix.
    #[inline]
    pub(crate) fn row_times(&self, row: usize, x: &[T]) -> T {
        let (columns, values) = self.row(row);
        let mut sum = T::default();
        for (&column, &value) in columns.iter().zip(values) {
            sum += value * x[column as usize];
        }
        sum
    }

    /// Row `row` times `x`, in double precision.
    #[inline]
    pub fn row_times_wide<X: Real>(&self, row: usize, x: &[X]) -> f64 {
        let (columns, values) = self.row(row);
        let mut sum = 0.0;
        for (&column, &value) in columns.iter().zip(values) {
            sum += value.into() * x[column as usize].into();
        }
        sum
    }
}

/// The value of a row in a column, zero if none is stored.
pub(crate) fn value_at<T: Real>((columns, values): (&[u32], &[T]), column: usize) -> T {
    let at = columns.binary_search(&(column as u32));
    at.map_or_else(|_| T::default(), |at| values[at])
}

/// The rows of a matrix by chunks, as [`Csr::assemble`] joins them.
pub(crate) fn assemble_chunks<T: Real>(
    n_rows: usize,
    n_columns: usize,
    fill: impl Fn(usize, &mut RowEntries) + Sync,
) -> Result<Vec<Rows<T>>, SolveError> {
    if n_rows >= u32::MAX as usize || n_columns >= u32::MAX as usize {
        return Err(SolveError::Matrix(format!(
            "a matrix of {n_rows} x {n_columns} exceeds the 32-bit index range"
        )));
    }
    (0..n_rows.div_ceil(CHUNK))
        .into_par_iter()
        .map(|chunk| {
            let rows = chunk * CHUNK..n_rows.min((chunk + 1) * CHUNK);
            assemble_rows(rows, n_columns, &fill)
        })
        .collect()
}

fn assemble_rows<T: Real>(
    range: std::ops::Range<usize>,
    n_columns: usize,
    fill: &(impl Fn(usize, &mut RowEntries) + Sync),
) -> Result<Rows<T>, SolveError> {
    let mut rows = Rows {
        row_end: Vec::with_capacity(range.len()),
        columns: Vec::with_capacity(8 * range.len()),
        values: Vec::with_capacity(8 * range.len()),
    };
    let mut row_entries = RowEntries::default();
    for row in range {
        row_entries.entries.clear();
        fill(row, &mut row_entries);
        row_entries.finish();
        for &(column, value) in &row_entries.entries {
            if column as usize >= n_columns || !value.is_finite() {
                return Err(SolveError::Matrix(format!(
                    "entry {value} at row {row}, column {column} of a matrix with {n_columns} \
                     columns; entries must be finite and lie inside"
                )));
            }
            rows.columns.push(column);
            rows.values.push(T::nearest(value));
        }
        // A chunk whose count exceeds 32 bits is refused when the chunks are joined.
        rows.row_end.push(rows.columns.len() as u32);
    }
    Ok(rows)
}
