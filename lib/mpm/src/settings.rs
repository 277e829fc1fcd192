//! Settings of the explicit scheme.

use physics::Choice;

/// Shape function between points and nodes.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum ShapeFunction {
    /// Uniform GIMP with boxes of half a cell, the paper's
    /// (Bardenhagen & Kober, 10.3970/cmes.2004.005.477).
    #[default]
    Gimp,
    /// Quadratic B-spline (Steffen, Kirby & Berzins, 10.1002/nme.2360).
    Bspline2,
    /// Hat function of classic MPM. A node with little mass feels full forces, so that liquid
    /// whose surface lies off the nodes is unstable at any step; such a run stops and says so.
    Linear,
}

impl Choice for ShapeFunction {
    const NAMED: &'static [(&'static str, Self)] = &[
        ("gimp", Self::Gimp),
        ("bspline2", Self::Bspline2),
        ("linear", Self::Linear),
    ];
}

/// How points take their velocity from the nodes.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum VelocityUpdate {
    /// Increment of the nodal velocity (Brackbill & Ruppel, 10.1016/0021-9991(86)90211-1).
    #[default]
    Flip,
    /// Nodal velocity; XPIC(1).
    Pic,
    /// XPIC(m), null space filter of order m (Hammerquist & Nairn 2017).
    Xpic(u32),
    /// FMPM(m), approximate full mass matrix (Nairn & Hammerquist, 10.1016/j.cma.2021.113667).
    Fmpm(u32),
    /// Affine PIC (Jiang et al., 10.1145/2766996).
    Apic,
}

impl Choice for VelocityUpdate {
    const NAMED: &'static [(&'static str, Self)] = &[
        ("flip", Self::Flip),
        ("pic", Self::Pic),
        ("xpic", Self::Xpic(0)),
        ("fmpm", Self::Fmpm(0)),
        ("apic", Self::Apic),
    ];
}

impl VelocityUpdate {
    /// The order m of XPIC and FMPM, 1 of all others.
    pub fn order(self) -> u32 {
        match self {
            Self::Xpic(m) | Self::Fmpm(m) => m,
            Self::Flip | Self::Pic | Self::Apic => 1,
        }
    }

    /// What the nodes keep for it.
    pub(crate) fn mode(self) -> Mode {
        match self {
            Self::Flip => Mode::Increment,
            Self::Xpic(2..) => Mode::FilterBefore,
            Self::Fmpm(2..) => Mode::FilterAfter,
            Self::Apic => Mode::Affine,
            Self::Pic | Self::Xpic(_) | Self::Fmpm(_) => Mode::Replace,
        }
    }
}

/// What the second half of a node's velocity lanes is for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Mode {
    /// The increment (FLIP): points keep their own velocity, and contact before the forces
    /// does not reach them.
    Increment,
    /// v+, which points take.
    Replace,
    /// Nothing: points take v+ and an affine field of it (APIC).
    Affine,
    /// v*, the sum of the recursion from the velocity before the forces (XPIC).
    FilterBefore,
    /// v*, the sum of the recursion from v+ (FMPM).
    FilterAfter,
}

/// Whose volume change sets a point's pressure.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum PressureFrom {
    /// The point's own, the paper's.
    #[default]
    Point,
    /// The mean of its cell.
    CellMean,
}

impl Choice for PressureFrom {
    const NAMED: &'static [(&'static str, Self)] =
        &[("point", Self::Point), ("cell-mean", Self::CellMean)];
}

/// What of the explicit scheme a case chooses.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Settings {
    /// Shape function.
    pub shape: ShapeFunction,
    /// Velocity update.
    pub velocity_update: VelocityUpdate,
    /// Time step over the limit that binds. With GIMP 0.7 is stable for 1e-3 to 1.3 Pa s in a
    /// pool on a wall off the nodes; 1.0 is not, neither there nor in wood, and 0.7 is not in every bond
    /// (docs/methods.md section 2.2).
    pub cfl: f64,
    /// Whose volume change sets a point's pressure; not the paper's unless `Point`.
    pub pressure: PressureFrom,
    /// How far (cells) the fastest point moves between two projections of the points to uniform
    /// density; `None`, the paper's, for no projection.
    pub density_projection: Option<f64>,
    /// Largest separation (cells) of liquid and wall, by positions extrapolated to a node, at
    /// which they are in contact; `None` for the shape function's own value.
    pub separation: Option<f64>,
}

impl Default for Settings {
    fn default() -> Self {
        Self {
            shape: ShapeFunction::Gimp,
            velocity_update: VelocityUpdate::Flip,
            cfl: 0.5,
            pressure: PressureFrom::Point,
            density_projection: None,
            separation: None,
        }
    }
}

/// Highest order of XPIC and FMPM: beyond it the filter costs far more than the step.
pub(crate) const MAX_ORDER: u32 = 20;

/// Beyond this many cells liquid and wall never share a node: each reaches 1.5 cells at most.
const MAX_SEPARATION: f64 = 3.0;

impl Settings {
    /// Says what is wrong with the settings, if anything.
    ///
    /// # Errors
    /// One sentence about the first value out of range.
    pub fn check(&self) -> Result<(), String> {
        if !(self.cfl > 0.0 && self.cfl <= 1.5) {
            return Err(format!(
                "cfl is {:?}: it must be above 0 and at most 1.5",
                self.cfl
            ));
        }
        if let Some(cells) = self.density_projection
            && !(cells > 0.0 && cells <= 1.0)
        {
            return Err(format!(
                "density_projection is {cells} cells: it must be above 0 and at most 1 cell"
            ));
        }
        if let Some(cells) = self.separation
            && !(cells > 0.0 && cells <= MAX_SEPARATION)
        {
            return Err(format!(
                "separation is {cells} cells: it must be above 0 and at most {MAX_SEPARATION} cells, beyond which no point reaches a node"
            ));
        }
        match self.velocity_update {
            VelocityUpdate::Xpic(m) | VelocityUpdate::Fmpm(m) if m == 0 || m > MAX_ORDER => {
                Err(format!(
                    "the order of the velocity update is {m}: it must be 1 to {MAX_ORDER}"
                ))
            }
            VelocityUpdate::Apic if self.shape == ShapeFunction::Linear => Err(
                "velocity_update \"apic\" needs shape \"gimp\" or \"bspline2\": with \"linear\" it is undefined for a point on a node".into(),
            ),
            _ => Ok(()),
        }
    }
}
