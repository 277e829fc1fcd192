//! Case files of the verification scenes, written as text the way a user would.

use std::fmt::Write;

use crate::voxels::Voxels;

/// Phenol formaldehyde of the paper: density kg/m3, bulk modulus Pa, viscosity Pa s.
pub const PF: [f64; 3] = [1200.0, 1e9, 1.3];

/// A box body in a scene, lengths in metres.
#[derive(Clone, Debug)]
pub struct Body {
    /// "adhesive" or "rigid".
    pub material: &'static str,
    /// Low corner, m.
    pub min: [f64; 3],
    /// High corner, m.
    pub max: [f64; 3],
    /// How it moves.
    pub motion: Motion,
    /// Speed along -y besides, m/s, at which it presses the liquid: [`CaseText::released`] has none.
    pub pressing: f64,
    /// Name, where a reaction is reported by it.
    pub name: Option<&'static str>,
}

impl Body {
    /// A wall at rest.
    pub fn wall(min: [f64; 3], max: [f64; 3]) -> Self {
        Self {
            material: "rigid",
            min,
            max,
            motion: Motion::Rest,
            pressing: 0.0,
            name: None,
        }
    }

    /// Liquid at rest.
    pub fn liquid(min: [f64; 3], max: [f64; 3]) -> Self {
        Self {
            material: "adhesive",
            min,
            max,
            motion: Motion::Rest,
            pressing: 0.0,
            name: None,
        }
    }

    /// This body at a constant velocity, m/s.
    pub fn moving(mut self, v: [f64; 3]) -> Self {
        self.motion = Motion::Constant(v);
        self
    }

    /// This body also moving along -y at `speed` (m/s), to press the liquid.
    pub fn pressing(mut self, speed: f64) -> Self {
        self.pressing = speed;
        self
    }

    /// This body driven by the clamp.
    pub fn clamped(mut self) -> Self {
        self.motion = Motion::Clamped;
        self
    }

    /// This body with a name.
    pub fn named(mut self, name: &'static str) -> Self {
        self.name = Some(name);
        self
    }

    /// The text of its velocity; `None` at rest.
    fn velocity(&self) -> Option<String> {
        let [x, y, z] = match self.motion {
            Motion::Clamped => return Some("\"clamp\"".into()),
            Motion::Constant(v) => v,
            Motion::Rest if self.pressing == 0.0 => return None,
            Motion::Rest => [0.0; 3],
        };
        let y = y - self.pressing;
        Some(format!("[\"{x} m/s\", \"{y} m/s\", \"{z} m/s\"]"))
    }
}

/// How a body of a scene moves.
#[derive(Clone, Copy, Debug)]
pub enum Motion {
    /// Not at all.
    Rest,
    /// At a velocity, m/s.
    Constant([f64; 3]),
    /// Driven by the clamp.
    Clamped,
}

/// A case to be written.
#[derive(Clone, Debug)]
pub struct CaseText {
    /// First lines, as comments.
    pub title: String,
    /// Cell edge, m.
    pub cell: f64,
    /// 2 or 3.
    pub dimensions: u8,
    /// Box computed in, m.
    pub domain: [[f64; 3]; 2],
    /// Density, kg/m3.
    pub density: f64,
    /// Bulk modulus, Pa.
    pub bulk_modulus: f64,
    /// Viscosity.
    pub viscosity: Viscosity,
    /// Surface tension (N/m) and contact angle (degrees), if any.
    pub wetting: Option<[f64; 2]>,
    /// Lines of `[adhesive.cure]`, if any.
    pub cure: Option<String>,
    /// Lines of `[adhesive.water]`, if any.
    pub water: Option<String>,
    /// Lines of `[air]`, if any.
    pub air: Option<String>,
    /// Lines of `[contact]`.
    pub contact: String,
    /// Lines of `[clamp]`, if any.
    pub clamp: Option<String>,
    /// Body force per mass, m/s2.
    pub gravity: [f64; 3],
    /// `[boundary]` of x, y, z.
    pub boundary: [&'static str; 3],
    /// End without a clamp, s.
    pub stop: Option<f64>,
    /// Bodies.
    pub bodies: Vec<Body>,
    /// Wood and liquid of a bond file, in place of box and bodies.
    pub voxels: Option<Voxels>,
    /// Rows of the history, as the time between them, s.
    pub history_every: f64,
    /// States written on the way.
    pub snapshots: u32,
}

/// Viscosity of a scene's liquid; a table is read linearly in the logarithm of the shear rate.
#[derive(Clone, Debug)]
pub enum Viscosity {
    /// Pa s.
    Newtonian(f64),
    /// Shear rate (rheometer's, 1/s) and viscosity (Pa s).
    Table(Vec<[f64; 2]>),
    /// Key and value of a law by formula, for rheometer's rates.
    Law(String),
}

/// Lines of `[contact]` for walls the liquid sticks to.
pub const STICK: &str = "law = \"stick\"\n";

impl CaseText {
    /// PF at rest between sides that mirror, with walls it sticks to and nothing in it yet.
    pub fn new(title: impl Into<String>, cell: f64, dimensions: u8, size: [f64; 3]) -> Self {
        Self {
            title: title.into(),
            cell,
            dimensions,
            domain: [[0.0; 3], size],
            density: PF[0],
            bulk_modulus: PF[1],
            viscosity: Viscosity::Newtonian(PF[2]),
            wetting: None,
            cure: None,
            water: None,
            air: None,
            contact: STICK.into(),
            clamp: None,
            gravity: [0.0; 3],
            boundary: ["symmetry"; 3],
            stop: None,
            bodies: Vec::new(),
            voxels: None,
            history_every: 0.05e-6,
            snapshots: 0,
        }
    }

    /// The same in plane strain: one layer of cells, `size` along x and y.
    pub fn plane(title: impl Into<String>, cell: f64, [x, y]: [f64; 2]) -> Self {
        Self::new(title, cell, 2, [x, y, cell])
    }

    /// The same with no body that presses. The explicit scheme needs them, because its wall law is
    /// unilateral: without pressure, as in the adhesive that a clamp presses, liquid would slip off its
    /// walls. The implicit scheme's walls hold liquid at any pressure.
    pub fn released(mut self) -> Self {
        for body in &mut self.bodies {
            body.pressing = 0.0;
        }
        self
    }

    /// The TOML text with the `[integrator]` lines given.
    pub fn text(&self, integrator: &str) -> String {
        let mut out = String::new();
        // Writing to a string cannot fail.
        let _ = self.write(&mut out, integrator);
        out
    }

    fn write(&self, out: &mut String, integrator: &str) -> std::fmt::Result {
        for line in self.title.lines() {
            writeln!(out, "# {line}")?;
        }
        writeln!(
            out,
            "[grid]\ncell = \"{} um\"\ndimensions = {}",
            um(self.cell),
            self.dimensions
        )?;
        if self.voxels.is_none() {
            writeln!(out, "domain = {}", corners(self.domain[0], self.domain[1]))?;
        }
        self.write_adhesive(out)?;
        writeln!(out, "\n[contact]\n{}", self.contact.trim_end())?;
        if let Some(clamp) = &self.clamp {
            writeln!(out, "\n[clamp]\n{}", clamp.trim_end())?;
        }
        if let Some(stop) = self.stop {
            writeln!(out, "\n[stop]\ntime = \"{} us\"", number(stop * 1e6))?;
        }
        writeln!(out, "\n[integrator]\n{}", integrator.trim_end())?;
        writeln!(
            out,
            "\n[output]\nhistory_every = \"{} us\"",
            number(self.history_every * 1e6)
        )?;
        if self.snapshots > 0 {
            writeln!(out, "snapshots = {}", self.snapshots)?;
        }
        if self.gravity != [0.0; 3] {
            let g = self.gravity;
            writeln!(
                out,
                "\n[gravity]\nacceleration = [\"{} m/s2\", \"{} m/s2\", \"{} m/s2\"]",
                number(g[0]),
                number(g[1]),
                number(g[2])
            )?;
        }
        let [x, y, z] = self.boundary;
        writeln!(out, "\n[boundary]\nx = \"{x}\"\ny = \"{y}\"\nz = \"{z}\"")?;
        for body in &self.bodies {
            writeln!(out, "\n[[body]]\nmaterial = \"{}\"", body.material)?;
            writeln!(out, "box = {}", corners(body.min, body.max))?;
            if let Some(velocity) = body.velocity() {
                writeln!(out, "velocity = {velocity}")?;
            }
            if let Some(name) = body.name {
                writeln!(out, "name = \"{name}\"")?;
            }
        }
        Ok(())
    }

    fn write_adhesive(&self, out: &mut String) -> std::fmt::Result {
        writeln!(
            out,
            "\n[adhesive]\ndensity = \"{} kg/m3\"\nbulk_modulus = \"{} Pa\"",
            self.density, self.bulk_modulus
        )?;
        match &self.viscosity {
            Viscosity::Newtonian(eta) => writeln!(out, "viscosity = \"{} Pa s\"", number(*eta))?,
            Viscosity::Table(rows) => {
                writeln!(out, "shear_rate = \"rheometer\"\nviscosity_table = [")?;
                for [rate, eta] in rows {
                    writeln!(out, "  [\"{rate} 1/s\", \"{eta} Pa s\"],")?;
                }
                writeln!(out, "]")?;
            }
            Viscosity::Law(key) => writeln!(out, "shear_rate = \"rheometer\"\n{key}")?,
        }
        if let Some([tension, degrees]) = self.wetting {
            writeln!(
                out,
                "surface_tension = \"{tension} N/m\"\ncontact_angle = \"{degrees} deg\""
            )?;
        }
        if let Some(cure) = &self.cure {
            writeln!(out, "\n[adhesive.cure]\n{}", cure.trim_end())?;
        }
        if let Some(water) = &self.water {
            writeln!(out, "\n[adhesive.water]\n{}", water.trim_end())?;
        }
        if let Some(air) = &self.air {
            writeln!(out, "\n[air]\n{}", air.trim_end())?;
        }
        Ok(())
    }
}

fn corners(min: [f64; 3], max: [f64; 3]) -> String {
    let list = |v: [f64; 3]| v.map(|x| format!("\"{} um\"", um(x))).join(", ");
    format!("{{ min = [{}], max = [{}] }}", list(min), list(max))
}

fn um(metres: f64) -> String {
    number(metres * 1e6)
}

/// Twelve significant digits at most, without the noise of binary fractions.
fn number(x: f64) -> String {
    let rounded: f64 = format!("{x:.11e}").parse().unwrap_or(x);
    format!("{rounded}")
}
