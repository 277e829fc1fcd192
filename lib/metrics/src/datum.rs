//! The plane or surfaces from which depth is measured.

use bondline::layers_to_surface;
use units::Axis;

use crate::fit::{self, Plane, Tilt};
use crate::penetration::Side;
use crate::{Adhesive, Error, State, Wood};

/// The kind of reference from which penetration is measured.
#[derive(Clone, Copy, Debug, PartialEq, strum::Display)]
#[strum(serialize_all = "lowercase")]
pub enum Reference {
    /// The level midway between the current bond surfaces of the two adherends; in a scanned specimen the bond plane.
    Mid,
    /// The current bond surface of the adherend on each side; adhesive between the surfaces has zero depth.
    Adherend,
    /// A given level, m.
    Plane(f64),
    /// The plane, possibly tilted, that best fits the middle between the surfaces.
    Fit,
}

/// A [`Reference`] found in a state.
#[derive(Clone, Debug, PartialEq)]
pub enum Datum {
    /// Levels along the normal, m.
    Level {
        /// The axis across the bond.
        normal: Axis,
        /// Zero of the bottom side.
        bottom: f64,
        /// Zero of the top side; not below `bottom`.
        top: f64,
    },
    /// A tilted plane.
    Tilted(Plane),
}

impl Datum {
    /// Finds `reference` in `state`.
    ///
    /// # Errors
    /// No adhesive; no bond line or no wood, for which [`Reference::Plane`] helps; a plane outside the state.
    pub fn find(reference: Reference, state: &State) -> Result<Self, Error> {
        // Undamaged wood is a stack without adhesive.
        if matches!(state.adhesive, Adhesive::Voxels(voxels) if voxels.bits.count() == 0) {
            return Err(Error::Data(bondline::Error::no_adhesive().to_string()));
        }
        let normal = state.normal;
        let level = |bottom, top| Datum::Level {
            normal,
            bottom,
            top,
        };
        if let Reference::Plane(plane) = reference {
            let across = |corner: [f64; 3]| corner[normal.index()];
            let (low, high) = (across(state.box_min_m), across(state.box_max_m));
            if !(low..=high).contains(&plane) {
                return Err(Error::Usage(format!(
                    "the plane at {:.3} um is outside the bond, which reaches from {:.3} to {:.3} um along {normal}",
                    1e6 * plane,
                    1e6 * low,
                    1e6 * high
                )));
            }
            return Ok(level(plane, plane));
        }
        let [bottom, top] = bond_surfaces(state)?;
        let middle = 0.5 * (bottom + top);
        match reference {
            Reference::Adherend => Ok(level(bottom, top)),
            Reference::Fit => fit::plane(state, middle).map(Datum::Tilted).map_err(|why| {
                Error::Usage(format!(
                    "{why}; wp-metrics --reference mid takes a level plane"
                ))
            }),
            _ => Ok(level(middle, middle)),
        }
    }

    /// A sentence if the datum cuts through so much wood of a specimen that it is hardly a bond plane.
    pub fn severed_doubt(&self, state: &State) -> Option<String> {
        let (Wood::Whole(wood), Adhesive::Voxels(_)) = (state.wood, state.adhesive) else {
            return None;
        };
        let n = state.normal.index();
        let layers = (self.plane_m(Side::Total) - wood.origin_m[n]) / wood.voxel_m;
        // Allow for rounding of planes between voxels.
        let severed = bondline::severed(wood.bits, state.normal, (layers + 1e-6) as usize);
        let area: usize = (0..3)
            .filter(|a| *a != n)
            .map(|a| wood.bits.dims()[a])
            .product();
        bondline::severed_doubt(severed, area as u64)
    }

    /// A sentence if a fitted plane may not run between the adherends, with its tilt and the reason.
    pub fn fit_doubt(&self) -> Option<String> {
        match self {
            Datum::Level { .. } => None,
            Datum::Tilted(plane) => plane.doubt.clone(),
        }
    }

    /// Tilt of a fitted plane.
    pub fn tilt(&self) -> Option<Tilt> {
        match self {
            Datum::Level { .. } => None,
            Datum::Tilted(plane) => Some(plane.tilt()),
        }
    }

    /// Area of the bond over its projection along the normal.
    pub fn slant(&self) -> f64 {
        match self {
            Datum::Level { .. } => 1.0,
            Datum::Tilted(plane) => plane.slant(),
        }
    }

    /// The side of the bond on which `point` lies (both if it lies on the plane between them), and its depth (m) there. `point`
    /// is the centre of a voxel or a material point.
    pub fn depth(&self, point: [f64; 3], voxel_m: f64) -> (Side, f64) {
        match self {
            Datum::Level { normal, .. } => self.depth_of_level(point[normal.index()], voxel_m),
            Datum::Tilted(plane) => {
                let distance = plane.distance(point);
                (Side::of(distance, voxel_m), distance.abs())
            }
        }
    }

    /// [`Datum::depth`] at a coordinate along the normal; for a tilted plane, at the centre of the bond area.
    pub fn depth_of_level(&self, coordinate: f64, voxel_m: f64) -> (Side, f64) {
        let side = Side::of(coordinate - self.plane_m(Side::Total), voxel_m);
        let below = self.plane_m(Side::Bottom) - coordinate;
        let above = coordinate - self.plane_m(Side::Top);
        let beyond = match side {
            Side::Bottom => below,
            Side::Top => above,
            Side::Total => below.max(above),
        };
        (side, beyond.max(0.0))
    }

    /// Coordinate (m) along the normal from which depths on `side` are measured; for both sides together, the one that
    /// separates them; for a tilted plane, at the centre of the bond area.
    pub fn plane_m(&self, side: Side) -> f64 {
        match (self, side) {
            (Datum::Level { bottom, .. }, Side::Bottom) => *bottom,
            (Datum::Level { top, .. }, Side::Top) => *top,
            (Datum::Level { bottom, top, .. }, Side::Total) => 0.5 * (bottom + top),
            (Datum::Tilted(plane), _) => plane.centre_m(),
        }
    }
}

/// Levels (m) of the bond surfaces of the bottom and the top adherend.
fn bond_surfaces(state: &State) -> Result<[f64; 2], Error> {
    let n = state.normal.index();
    let no_wood = |which: &str| {
        Error::Usage(format!(
            "there is no {which} to measure from; give the level with --reference plane=LEN"
        ))
    };
    match state.wood {
        Wood::None => Err(no_wood("wood")),
        Wood::Whole(wood) => {
            let Adhesive::Voxels(adhesive) = state.adhesive else {
                return Err(no_wood("bottom and top adherend"));
            };
            let specimen = bondline::Specimen::new(wood, adhesive)?;
            let line = bondline::find_bond_line(&specimen, state.normal)?;
            let at = |layers: usize| wood.origin_m[n] + layers as f64 * wood.voxel_m;
            Ok([at(line.bottom), at(line.top)])
        }
        Wood::Parted { bottom, top } => {
            let mut below = bottom.bits.counts_along(n);
            below.reverse();
            let above = top.bits.counts_along(n);
            let bare_below = layers_to_surface(&below).ok_or_else(|| no_wood("bottom adherend"))?;
            let bare_above = layers_to_surface(&above).ok_or_else(|| no_wood("top adherend"))?;
            Ok([
                bottom.max_m()[n] - bare_below as f64 * bottom.voxel_m,
                top.origin_m[n] + bare_above as f64 * top.voxel_m,
            ])
        }
    }
}
