//! Goals of the verification, for the page to say whether it reaches them.

/// A largest error for some of the runs.
pub(super) struct Goal {
    /// Beginnings of names of scenes, in words for the page.
    pub cases: &'static str,
    /// Whole words at the beginnings of names of scenes.
    prefixes: &'static [&'static str],
    /// Label of the method, or "explicit" for every update.
    pub method: &'static str,
    /// Beginning of the quantity's name.
    pub quantity: &'static str,
    /// Largest error.
    pub limit: f64,
    /// Why it is out of reach, where it is.
    pub why: Option<&'static str>,
}

impl Goal {
    /// This goal, out of reach for the reason given.
    const fn because(mut self, why: &'static str) -> Self {
        self.why = Some(why);
        self
    }

    /// Whether a run of `scene` by the method of this label counts.
    pub(super) fn is_about(&self, scene: &str, label: &str) -> bool {
        let method = match self.method {
            "explicit" => !label.starts_with("implicit"),
            "implicit" => label.starts_with("implicit"),
            method => label == method,
        };
        // Whole words of the name: "off0" is not the beginning of "off0.25".
        let begins = |p: &str| {
            let rest = scene.strip_prefix(p);
            rest.is_some_and(|rest| rest.is_empty() || rest.starts_with('-'))
        };
        method && self.prefixes.iter().any(|p| begins(p))
    }
}

const fn goal(
    cases: &'static str,
    prefixes: &'static [&'static str],
    method: &'static str,
    quantity: &'static str,
    limit: f64,
) -> Goal {
    Goal {
        cases,
        prefixes,
        method,
        quantity,
        limit,
        why: None,
    }
}

/// Couette flow: its walls are those of Poiseuille flow, and the line through points a poor measure.
const COUETTE: &str = "the distance of walls is that of Poiseuille flow, which makes the stress of shear \
    too large by 2/(3 n (n + 1.2)), the row above; the line through points makes 3 to 4 times as much of it";
/// A lumen that takes water.
const CONTACT: &str = "on its way, in the tube; +2.4 % at 12 cells, and where it stops +2.5 and -0.4 %: walls are wetted where \
    cells hold liquid, a contact line lags behind by a part of a cell";
/// Flow through spheres of voxels.
const SPHERES: &str = "at 8 cells a period, the sphere 4 cells across; 3.9 % at 16 and 2.1 % at 24";
/// Walls half way between faces of cells.
const HALVES: &str = "walls half way between faces: a front fills half cells beside them, 3.0 % of the force at 12 cells; on faces 1.7 % \
    of the force and 0.3 % of L at 6 cells";

/// The numbers the project set out to reach, one a line.
#[rustfmt::skip]
pub(super) const GOALS: &[Goal] = &[
    goal("incline, 0.5 ms, on nodes", &["incline-n6-off0"], "XPIC(5)", "rms profile", 0.01),
    goal("incline, 0.5 ms, on nodes", &["incline-n6-off0"], "XPIC(5)", "rms v_y", 0.001),
    goal("channel, 6 cells, any offset", &["channel-n6"], "implicit", "mean velocity", 0.02),
    goal("channel, 3 cells, any offset", &["channel-n3"], "implicit", "mean velocity", 0.05),
    goal("table in a channel, 3 cells", &["table-n3"], "implicit", "mean velocity", 0.025),
    goal("table in a channel, 6 cells", &["table-n6"], "implicit", "mean velocity", 0.02),
    goal("table in a channel, 12 cells", &["table-n12"], "implicit", "mean velocity", 0.007),
    goal("table in a channel, 24 cells", &["table-n24"], "implicit", "mean velocity", 0.0025),
    goal("laws by formula in a channel, 12 cells", &[
        "law-power0.5-n12", "law-power0.3-n12", "law-cross-n12", "law-carreau-n12", "law-herschel-n12",
    ], "implicit", "mean velocity", 0.02),
    goal("plug of a yield stress, 12 cells", &["law-herschel-n12"], "implicit", "motion within the plug", 0.001),
    goal("filling with cure, slit and tube, 6 cells", &["cure-slit-n6", "cure-tube-n6"], "implicit", "L", 0.03),
    goal("filling with loss of water, slit and tube, 6 cells", &["water-slit-n6", "water-tube-n6"], "implicit", "L", 0.03).because(CONTACT),
    goal("mass of water", &["water"], "implicit", "mass of water", 1e-9),
    goal("end of a flow that sets", &["cure"], "implicit", "time", 0.001),
    goal("wicking, 6 cells, slits at any offset and tubes", &["wicking-slit-n6", "wicking-tube-n6"], "implicit", "L", 0.05),
    goal("what does not wet stays out: a cell at most", &["wicking-slit-n6-120deg", "wicking-tube-n6-120deg"], "implicit", "length entered", 1.0 / 6.0),
    goal("Jurin's height, 6 cells, 0 to 120 degrees", &["jurin-n6"], "implicit", "height", 0.05),
    goal("filling against closed-in air, 6 cells, at rest", &["air-n6"], "implicit", "L at the end, Boyle", 0.02),
    goal("filling against air that leaks, 6 cells, at the end", &["air-n6-leak"], "implicit", "L at the end", 0.02),
    goal("filling against closed-in air, 6 cells, course", &["air-n6"], "implicit", "L(t)", 0.02),
    goal("filling against closed-in air, 12 cells, course", &["air-n12"], "implicit", "L(t)", 0.02),
    goal("incline, 12 cells", &["incline-n12"], "implicit", "rms profile", 0.005),
    goal("couette, 6 cells, any offset", &["couette-n6"], "implicit", "stress", 0.02),
    goal("couette, 6 cells, any offset", &["couette-n6"], "implicit", "slip velocity", 0.02).because(COUETTE),
    goal("square duct, 6 cells", &["duct-square-n6"], "implicit", "mean velocity", 0.01),
    goal("slit, 6 cells, walls on faces of cells", &["slit-n6-off0"], "implicit", "piston force", 0.03),
    goal("slit, 12 cells, walls on faces of cells", &["slit-n12-off0"], "implicit", "piston force", 0.015),
    goal("slit, 6 cells, walls half way between faces", &["slit-n6-off0.5"], "implicit", "piston force", 0.03).because(HALVES),
    goal("filling at constant pressure, 3 cells", &["washburn-n3"], "implicit", "L(t)", 0.02),
    goal("filling at constant pressure, 6 cells", &["washburn-n6"], "implicit", "L(t)", 0.01).because(HALVES),
    goal("squeeze film, plates, from 3 cells", &["squeeze-n3", "squeeze-n6"], "implicit", "force", 0.02),
    goal("squeeze film, disc, from 3 cells", &["disc8-n3", "disc8-n6"], "implicit", "force", 0.02),
    goal("film closed by a load, 1 us to 1000 s", &["stefan-n6"], "implicit", "gap over time", 0.02),
    goal("spheres, gap of 4 cells or more", &[
        "spheres-n8-0.064", "spheres-n16-0.064", "spheres-n16-0.125", "spheres-n16-0.216",
        "spheres-n24-0.064", "spheres-n24-0.125", "spheres-n24-0.216",
    ], "implicit", "permeability, same voxels", 0.04).because(SPHERES),
    goal("flow along the grain, one and two voxels a cell", &["grain-n24", "grain-n48"], "implicit", "permeability", 0.02),
    goal("slit, 6 and 12 cells, volume", &["slit-n6", "slit-n12"], "implicit", "density", 0.005),
    goal("sealed lumens", &["sealed"], "explicit", "points leaked", 0.0),
    goal("sealed lumens", &["sealed"], "implicit", "points leaked", 0.0),
    goal("compression", &["tait"], "explicit", "rms pressure of points", 1e-4),
    goal("sound", &["acoustic"], "explicit", "frequency", 0.01),
    goal("Galilean", &["galilean"], "explicit", "largest drift", 1e-6),
    goal("Galilean", &["galilean"], "implicit", "largest drift", 1e-6),
    goal("momentum of a drop", &["drop"], "explicit", "momentum", 1e-5),
    goal("load control", &["clamp"], "explicit", "overshoot", 0.05),
    goal("load control", &["clamp"], "implicit", "overshoot", 0.05),
    goal("load control", &["clamp"], "implicit", "travel", 1e-6),
];
