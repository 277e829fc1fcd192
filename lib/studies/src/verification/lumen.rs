//! Cross-sections of straight lumens made of voxels of half a cell, in three dimensions.

/// Cross-section of a lumen of `n` cells.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Section {
    /// Square of edge `n` cells.
    Square,
    /// Voxels whose centres lie in a circle of diameter `n` cells, with so many voxels on the
    /// edge of a cell: 1 or 2. With one, `n` must be even.
    Round(u32),
}

impl Section {
    /// Word in names.
    pub fn name(self) -> &'static str {
        match self {
            Section::Square => "square",
            Section::Round(1) => "tube1",
            Section::Round(_) => "tube",
        }
    }

    /// Rows of voxels on one side of the axis.
    fn count(self, n: u32) -> u32 {
        match self {
            Section::Square => n,
            Section::Round(voxels) => n * voxels / 2,
        }
    }

    /// Half the width of each row of voxels of one side, from the axis outwards, over the
    /// diameter.
    pub fn rows(self, n: u32) -> Vec<f64> {
        let count = self.count(n);
        let radius = f64::from(count);
        let half = |row: u32| {
            let y = f64::from(row) + 0.5;
            let open = |k: &u32| self == Section::Square || (f64::from(*k) + 0.5).hypot(y) < radius;
            (0..count).filter(open).count() as f64 / (2.0 * radius)
        };
        (0..count).map(half).collect()
    }

    /// Open area over the square of the diameter.
    pub fn area(self, n: u32) -> f64 {
        let rows = self.rows(n);
        2.0 * rows.iter().sum::<f64>() / rows.len() as f64
    }

    /// Pressure gradient over viscosity and mean velocity times the square of the diameter in
    /// developed flow: 28.454 for the square (White 2006); for the tube 8 pi over its area
    /// (Hagen-Poiseuille with the radius of a circle of the voxels' own area).
    pub fn resistance(self, n: u32) -> f64 {
        match self {
            Section::Square => 28.454,
            Section::Round(_) => 8.0 * std::f64::consts::PI / self.area(n),
        }
    }

    /// [`Self::resistance`] of the lumen's own staircase walls, by finite differences (lib/studies/reference/staircase.py).
    ///
    /// # Panics
    /// Without a row of the table.
    pub fn staircase_resistance(self, n: u32) -> f64 {
        let row = format!("{},{n},", self.name());
        let mut lines = include_str!("../../reference/staircase.csv").lines();
        let found = lines.find_map(|line| line.strip_prefix(&row)?.parse().ok());
        found.unwrap_or_else(|| panic!("lib/studies/reference/staircase.csv has no row {row}"))
    }
}

/// A rectangle of a cross-section by its corners (across, up) from the lumen's axis, m.
#[derive(Clone, Copy, Debug)]
pub struct Rectangle {
    /// Low corner.
    pub low: [f64; 2],
    /// High corner.
    pub high: [f64; 2],
}

/// The quarter of a cross-section at positive coordinates about the axis.
pub struct Quarter {
    /// What is above the lumen.
    pub roof: Rectangle,
    /// What is beside it.
    pub sides: Vec<Rectangle>,
    /// What is open.
    pub open: Vec<Rectangle>,
}

/// The quarter of a lumen of diameter `d` (m), `n` cells; its solid goes out to `far` (m).
pub fn quarter(section: Section, n: u32, d: f64, far: f64) -> Quarter {
    let rectangle = |low, high| Rectangle { low, high };
    let mut quarter = Quarter {
        roof: rectangle([0.0, 0.5 * d], [far, far]),
        sides: Vec::new(),
        open: Vec::new(),
    };
    let rows = section.rows(n);
    let voxel = 0.5 * d / rows.len() as f64;
    // Rows of equal width are one rectangle.
    let mut start = 0;
    while start < rows.len() {
        let same = rows[start..].iter().take_while(|&&w| w == rows[start]);
        let end = start + same.count();
        let (low, high) = (start as f64 * voxel, end as f64 * voxel);
        let wide = rows[start] * d;
        quarter.open.push(rectangle([0.0, low], [wide, high]));
        quarter.sides.push(rectangle([wide, low], [far, high]));
        start = end;
    }
    quarter
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn resistances() {
        let square = Section::Square.staircase_resistance(6);
        assert!((square / 28.454 - 1.0).abs() < 0.001, "{square}");
        let tube = Section::Round(2);
        let [stairs, round] = [tube.staircase_resistance(12), tube.resistance(12)];
        assert!((1.0..1.12).contains(&(stairs / round)), "{stairs} {round}");
    }

    #[test]
    fn areas() {
        assert_eq!(Section::Square.area(6), 1.0);
        for (n, most) in [(4, 0.04), (6, 0.04), (96, 0.001)] {
            let share = Section::Round(2).area(n) / std::f64::consts::FRAC_PI_4;
            assert!((share - 1.0).abs() < most, "{n}: {share}");
        }
    }
}
