//! A clamp's body that presses a slab of liquid on another, with or without a lumen.

use crate::case_text::{Body, CaseText};

/// Shape of a press, lengths in cells.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Press {
    /// Width of the domain, and where the liquid is along x.
    pub(crate) width: f64,
    pub(crate) liquid: [f64; 2],
    /// Thickness of the liquid, and of the air between it and the upper body.
    pub(crate) slab: f64,
    pub(crate) air: f64,
    /// Heights of the floor of the lumen and of that of the slab.
    pub(crate) floors: [f64; 2],
    /// Lumen of the lower body, from and to.
    pub(crate) lumen: Option<[f64; 2]>,
    /// How far the upper body moves.
    pub(crate) travel: f64,
    /// Cells along z, and how many of them hold liquid; one for plane strain.
    pub(crate) depth: [f64; 2],
}

impl Press {
    /// Its case in cells of an edge (m), but for the lines of its clamp.
    pub(crate) fn case(&self, cell: f64) -> CaseText {
        let ([bottom, floor], [deep, wet]) = (self.floors, self.depth);
        let plate = floor + self.slab + self.air;
        let top = (plate + 2.0).ceil();
        let m = |[x, y]: [f64; 2], z: f64| [x, y, z].map(|x| x * cell);
        let wall = |low, high| Body::wall(m(low, 0.0), m(high, deep)).named("bottom");
        let mut bodies = Vec::new();
        if let Some([from, to]) = self.lumen {
            bodies.push(wall([0.0, 0.0], [self.width, bottom]));
            bodies.push(wall([0.0, bottom], [from, floor]));
            bodies.push(wall([to, bottom], [self.width, floor]));
        } else {
            bodies.push(wall([0.0, 0.0], [self.width, floor]));
        }
        let upper = wall([0.0, plate], [self.width, top + self.travel]);
        bodies.push(upper.clamped().named("top"));
        let ([left, right], surface) = (self.liquid, floor + self.slab);
        bodies.push(Body::liquid(
            m([left, floor], 0.0),
            m([right, surface], wet),
        ));
        CaseText {
            bodies,
            ..CaseText::new(
                cell,
                if deep > 1.0 { 3 } else { 2 },
                m([self.width, top], deep),
            )
        }
    }
}
