//! Grey values in cuts through the middle of a stack.

use rayon::prelude::*;

use crate::{Crop, Error, Stack};

impl Stack {
    /// The grey values of the layers normal to x, y and z in the middle of `crop`, each in storage order.
    ///
    /// # Errors
    /// A page that cannot be read.
    pub fn middle_cuts(&self, crop: &Crop) -> Result<[Vec<f64>; 3], Error> {
        let format = self.format();
        let [x, y, z] = crop.dims().map(|n| n / 2);
        let of_page = |at: usize| {
            let mut page = Vec::new();
            self.read_page(at, &mut page)?;
            let rows: Vec<&[u8]> = crop.rows(format, &page).collect();
            let whole = at == crop.ranges()[2].start + z;
            let whole = rows.iter().filter(|_| whole);
            Ok([
                rows.iter()
                    .filter_map(|row| format.values(row).nth(x))
                    .collect(),
                format.values(rows[y]).collect(),
                whole.flat_map(|row| format.values(row)).collect(),
            ])
        };
        let pages = crop.ranges()[2].clone().into_par_iter().map(of_page);
        let pages: Vec<[Vec<f64>; 3]> = pages.collect::<Result<_, _>>()?;
        Ok([0, 1, 2].map(|axis| pages.iter().flat_map(|page| &page[axis]).copied().collect()))
    }
}
