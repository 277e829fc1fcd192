//! Case files of the scenes, written as text the way a user would.

use crate::voxels::Voxels;

/// Phenol formaldehyde of the paper: density kg/m3, bulk modulus Pa, viscosity Pa s.
pub const PF: [f64; 3] = [1200.0, 1e9, 1.3];

/// A box body in a scene, lengths in metres.
#[derive(Clone, Debug)]
pub struct Body {
    /// "adhesive" or "rigid".
    material: &'static str,
    /// Low corner, m.
    pub min: [f64; 3],
    /// High corner, m.
    pub max: [f64; 3],
    /// Velocity, m/s.
    velocity: [f64; 3],
    /// Speed along -y besides, m/s, at which it presses the liquid: [`CaseText::released`] has none.
    pressing: f64,
    /// Driven by the clamp.
    clamped: bool,
    /// Name, where a reaction is reported by it.
    pub(crate) name: Option<&'static str>,
}

impl Body {
    fn at_rest(material: &'static str, min: [f64; 3], max: [f64; 3]) -> Self {
        Self {
            material,
            min,
            max,
            velocity: [0.0; 3],
            pressing: 0.0,
            clamped: false,
            name: None,
        }
    }

    /// A wall at rest.
    pub(crate) fn wall(min: [f64; 3], max: [f64; 3]) -> Self {
        Self::at_rest("rigid", min, max)
    }

    /// Liquid at rest.
    pub(crate) fn liquid(min: [f64; 3], max: [f64; 3]) -> Self {
        Self::at_rest("adhesive", min, max)
    }

    /// This body at a constant velocity, m/s.
    pub(crate) fn moving(mut self, velocity: [f64; 3]) -> Self {
        self.velocity = velocity;
        self
    }

    /// This body also moving along -y at `speed` (m/s), to press the liquid.
    pub(crate) fn pressing(mut self, speed: f64) -> Self {
        self.pressing = speed;
        self
    }

    /// This body driven by the clamp.
    pub(crate) fn clamped(mut self) -> Self {
        self.clamped = true;
        self
    }

    /// This body with a name.
    pub(crate) fn named(mut self, name: &'static str) -> Self {
        self.name = Some(name);
        self
    }

    fn text(&self) -> String {
        let bounds = corners(self.min, self.max);
        let mut out = format!(
            "\n[[body]]\nmaterial = \"{}\"\nbox = {bounds}\n",
            self.material
        );
        let [x, y, z] = self.velocity;
        let y = y - self.pressing;
        if self.clamped {
            out += "velocity = \"clamp\"\n";
        } else if [x, y, z] != [0.0; 3] {
            out += &format!("velocity = [\"{x} m/s\", \"{y} m/s\", \"{z} m/s\"]\n");
        }
        if let Some(name) = self.name {
            out += &format!("name = \"{name}\"\n");
        }
        out
    }
}

/// A case to be written.
#[derive(Clone, Debug)]
pub struct CaseText {
    /// First lines, as comments.
    pub(crate) title: String,
    /// Cell edge, m.
    pub cell: f64,
    /// 2 or 3.
    pub(crate) dimensions: u8,
    /// Edges of the box computed in, from the origin, m.
    pub(crate) size: [f64; 3],
    /// Density, kg/m3.
    pub(crate) density: f64,
    /// Bulk modulus, Pa.
    pub(crate) bulk_modulus: f64,
    /// Viscosity.
    pub viscosity: Viscosity,
    /// Surface tension (N/m) and contact angle (degrees), if any.
    pub(crate) wetting: Option<[f64; 2]>,
    /// Lines of `[adhesive.cure]`, if any.
    pub(crate) cure: Option<String>,
    /// Lines of `[adhesive.water]`, if any.
    pub(crate) water: Option<String>,
    /// Lines of `[air]`, if any.
    pub air: Option<String>,
    /// Lines of `[contact]`.
    pub(crate) contact: String,
    /// Lines of `[clamp]`, if any.
    pub clamp: Option<String>,
    /// Body force per mass, m/s2.
    pub gravity: [f64; 3],
    /// `[boundary]` of x, y, z.
    pub(crate) boundary: [&'static str; 3],
    /// End without a clamp, s.
    pub stop: Option<f64>,
    /// Bodies.
    pub bodies: Vec<Body>,
    /// Wood and liquid of a bond file, in place of box and bodies.
    pub(crate) voxels: Option<Voxels>,
    /// Rows of the history, as the time between them, s.
    pub(crate) history_every: f64,
    /// States written on the way.
    pub(crate) snapshots: u32,
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

impl Viscosity {
    fn text(&self) -> String {
        let lines: String = match self {
            Self::Newtonian(eta) => return format!("viscosity = \"{} Pa s\"\n", number(*eta)),
            Self::Table(rows) => {
                let row = |[rate, eta]: &[f64; 2]| format!("  [\"{rate} 1/s\", \"{eta} Pa s\"],\n");
                let rows: String = rows.iter().map(row).collect();
                format!("viscosity_table = [\n{rows}]")
            }
            Self::Law(key) => key.clone(),
        };
        format!("shear_rate = \"rheometer\"\n{lines}\n")
    }
}

/// Lines of `[contact]` for walls the liquid sticks to.
pub(crate) const STICK: &str = "law = \"stick\"\n";

/// Lines of `[contact]` for walls of an influence length with its unit.
pub(crate) fn partial_slip(length: &str) -> String {
    format!("law = \"partial-slip\"\ninfluence_length = \"{length}\"\n")
}

impl CaseText {
    /// PF at rest between sides that mirror, with walls it sticks to and nothing in it yet.
    pub(crate) fn new(cell: f64, dimensions: u8, size: [f64; 3]) -> Self {
        Self {
            title: String::new(),
            cell,
            dimensions,
            size,
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
    pub(crate) fn plane(cell: f64, [x, y]: [f64; 2]) -> Self {
        Self::new(cell, 2, [x, y, cell])
    }

    /// The same with no body that presses. The explicit scheme needs them, because its wall law is
    /// unilateral: without pressure, as in the adhesive that a clamp presses, liquid would slip off its
    /// walls. The implicit scheme's walls hold liquid at any pressure.
    pub(crate) fn released(mut self) -> Self {
        for body in &mut self.bodies {
            body.pressing = 0.0;
        }
        self
    }

    /// The TOML text with the `[integrator]` lines given.
    pub(crate) fn text(&self, integrator: &str) -> String {
        let title = self.title.lines().map(|line| format!("# {line}\n"));
        let mut out: String = title.collect();
        let (cell, dimensions) = (um(self.cell), self.dimensions);
        out += &format!("[grid]\ncell = \"{cell} um\"\ndimensions = {dimensions}\n");
        if self.voxels.is_none() {
            out += &format!("domain = {}\n", corners([0.0; 3], self.size));
        }
        let adhesive = self.adhesive();
        let stop = self.stop.map(|time| format!("time = \"{} us\"", um(time)));
        let mut output = format!("history_every = \"{} us\"\n", um(self.history_every));
        if self.snapshots > 0 {
            output += &format!("snapshots = {}\n", self.snapshots);
        }
        let gravity = (self.gravity != [0.0; 3]).then(|| {
            let [x, y, z] = self.gravity.map(number);
            format!("acceleration = [\"{x} m/s2\", \"{y} m/s2\", \"{z} m/s2\"]")
        });
        let [x, y, z] = self.boundary;
        let boundary = format!("x = \"{x}\"\ny = \"{y}\"\nz = \"{z}\"");
        for (name, lines) in [
            ("adhesive", Some(adhesive.as_str())),
            ("adhesive.cure", self.cure.as_deref()),
            ("adhesive.water", self.water.as_deref()),
            ("air", self.air.as_deref()),
            ("contact", Some(&self.contact)),
            ("clamp", self.clamp.as_deref()),
            ("stop", stop.as_deref()),
            ("integrator", Some(integrator)),
            ("output", Some(&output)),
            ("gravity", gravity.as_deref()),
            ("boundary", Some(&boundary)),
        ] {
            if let Some(lines) = lines {
                out += &format!("\n[{name}]\n{}\n", lines.trim_end());
            }
        }
        out.extend(self.bodies.iter().map(Body::text));
        out
    }

    fn adhesive(&self) -> String {
        let (density, modulus) = (self.density, self.bulk_modulus);
        let mut out = format!("density = \"{density} kg/m3\"\nbulk_modulus = \"{modulus} Pa\"\n");
        out += &self.viscosity.text();
        if let Some([tension, angle]) = self.wetting {
            out += &format!("surface_tension = \"{tension} N/m\"\ncontact_angle = \"{angle} deg\"");
        }
        out
    }
}

fn corners(min: [f64; 3], max: [f64; 3]) -> String {
    let [min, max] = [min, max].map(|v| v.map(|x| format!("\"{} um\"", um(x))).join(", "));
    format!("{{ min = [{min}], max = [{max}] }}")
}

/// Micrometres of metres, or microseconds of seconds.
fn um(x: f64) -> String {
    number(x * 1e6)
}

/// Twelve significant digits at most, without the noise of binary fractions.
fn number(x: f64) -> String {
    let rounded: f64 = format!("{x:.11e}").parse().unwrap_or(x);
    format!("{rounded}")
}
