//! Keys of liquid, walls and press.

use physics::{Pid, ShearRate, WallLaw};
use units::{Density, Length, Pressure, Speed, Time, Viscosity};

use super::{Absent, Key, Table, choice, quantity, si, wetting, word};
use crate::case::{Case, ClampTable, SchemeName, StopRule};

pub(super) const ADHESIVE: Table = Table {
    path: "adhesive",
    repeated: false,
    always: true,
    about: "The liquid.",
    keys: &[
        Key {
            name: "density",
            form: quantity::<Density>,
            absent: Absent::Needed("always"),
            text: "Mass density at rest, solids included.",
        },
        Key {
            name: "bulk_modulus",
            form: quantity::<Pressure>,
            absent: Absent::Needed("always"),
            text: "K of Eq. 1; 1 GPa is the paper's. A run is refused or stops beyond p = 0.2 K; a smaller K makes explicit steps longer and the liquid softer than any adhesive.",
        },
        Key {
            name: "viscosity",
            form: quantity::<Viscosity>,
            absent: Absent::Needed("unless a table or a law is given"),
            text: "Newtonian viscosity at the temperature of the press.",
        },
        Key {
            name: "viscosity_table",
            form: || "rows of shear rate, viscosity".into(),
            absent: Absent::Needed("unless `viscosity` or a law is given"),
            text: "Viscosity against shear rate, rising rates, at least two rows: linear in the logarithm of the rate between them, constant outside. For adhesives that thin or thicken.",
        },
        Key {
            name: "shear_rate",
            form: choice::<ShearRate>,
            absent: Absent::Value("\"paper\""),
            text: "What the table's rate is: `\"paper\"` 2 abs(dev D), `\"rheometer\"` sqrt(2 D:D), the rate of simple shear. Take `\"rheometer\"` for a table that you measured.",
        },
        Key {
            name: "cavitation_pressure",
            form: quantity::<Pressure>,
            absent: Absent::Nothing("any tension, as Eq. 1 has it"),
            text: "Largest tension that the liquid carries; beyond it cavities open. Give it, such as `\"0.1 MPa\"`, where liquid is pulled apart; then the liquid's volume may grow and no longer counts against the run.",
        },
        wetting::SURFACE_TENSION,
        wetting::CONTACT_ANGLE,
        wetting::DYNAMIC_ANGLE,
    ],
};

pub(super) const CONTACT: Table = Table {
    path: "contact",
    repeated: false,
    always: false,
    about: "What happens between liquid and wall. Needed where there is wood or a rigid body.",
    keys: &[
        Key {
            name: "law",
            form: choice::<WallLaw>,
            absent: Absent::Needed("always"),
            text: "`\"partial-slip\"` is Eq. 3, `\"stick\"` its limit for a short influence length, `\"frictionless\"` that for a long one: the paper's upper bound of penetration.",
        },
        Key {
            name: "influence_length",
            form: length_or_cells,
            absent: Absent::Needed("with `\"partial-slip\"`"),
            text: "1/k of Eq. 3; the paper has `\"0.01 cell\"`. Give a length where runs of several cell sizes are compared.",
        },
        Key {
            name: "separation",
            form: length_or_cells,
            absent: Absent::Nothing(
                "0.8 cell with `\"gimp\"` and `\"linear\"`, 0.92 with `\"bspline2\"`",
            ),
            text: "Explicit scheme: how near liquid and wall touch at a node. Not the paper's if given; every other value that was tried is worse somewhere ([explicit options](results/explicit-options.md)).",
        },
    ],
};

pub(super) const CLAMP: Table = Table {
    path: "clamp",
    repeated: false,
    always: false,
    about: "The press: drives the upper adherend, or the bodies with `velocity = \"clamp\"`, along -y.",
    keys: &[
        Key {
            name: "closing_speed",
            form: quantity::<Speed>,
            absent: Absent::Needed("unless there are stages"),
            text: "Speed at the start and the largest ever. The paper's 1 m/s is far above a press; implicit runs at real speeds take no more steps.",
        },
        Key {
            name: "max_pressure",
            form: quantity::<Pressure>,
            absent: Absent::Nothing("none: constant speed"),
            text: "Pressure at which the clamp is held: force on the upper body over the cross-section. 2.5 MPa is the transverse strength of hybrid poplar.",
        },
        Key {
            name: "pid.kp",
            form: number,
            absent: Absent::Of("0; implicit: none", |case, _| gain(case, |pid| pid.kp)),
            text: "Proportional gain of the controller that keeps `max_pressure`, dimensionless. Give `pid = { kp, ki, kd }`, all three, where the pressure overshoots or crawls. The implicit scheme solves for the speed that gives the pressure, to 0.5 %, and uses these gains only if they are given.",
        },
        Key {
            name: "pid.ki",
            form: number,
            absent: Absent::Of("0.02; implicit: none", |case, _| gain(case, |pid| pid.ki)),
            text: "Integral gain per unit of time, which is 0.015 cell over the speed of sound.",
        },
        Key {
            name: "pid.kd",
            form: number,
            absent: Absent::Of("0; implicit: none", |case, _| gain(case, |pid| pid.kd)),
            text: "Derivative gain times unit of time.",
        },
        Key {
            name: "stop",
            form: || "`\"closed\"`, time".into(),
            absent: Absent::Of("`\"closed\"`", |case, _| {
                unstaged(case).map(|_| word("closed"))
            }),
            text: "End of the run: when the adherends are back where they were in the stack, or at a time.",
        },
        Key {
            name: "time_limit",
            form: quantity::<Time>,
            absent: Absent::Of("twice the closing time at full speed", |case, setup| {
                let stop = unstaged(case)?.stop.unwrap_or(StopRule::Closed);
                (stop == StopRule::Closed).then(|| si::<Time>(setup.time_limit_s))
            }),
            text: "Latest end of a run with `stop = \"closed\"`, which a pressure limit may keep from closing for ever. Lengthen it where a run ends at it while it still moves; `summary.json` says `time-limit` then.",
        },
        Key {
            name: "travel",
            form: quantity::<Length>,
            absent: Absent::Of("with a bond file, its gap", |case, setup| {
                case.clamp.as_ref()?;
                setup.initial_gap_m.map(si::<Length>)
            }),
            text: "Way of the clamp at which the bond is closed. Give it with `[[body]]` and `stop = \"closed\"`, or to leave a bond line thicker than the experiment's.",
        },
    ],
};

pub(super) const STOP: Table = Table {
    path: "stop",
    repeated: false,
    always: false,
    about: "End of a run without clamp; refused with one.",
    keys: &[Key {
        name: "time",
        form: quantity::<Time>,
        absent: Absent::Needed("without `[clamp]`"),
        text: "Simulated time at which the run ends.",
    }],
};

fn length_or_cells() -> String {
    "length, cells".into()
}

fn number() -> String {
    "number".into()
}

/// The clamp of a case without a press programme.
fn unstaged(case: &Case) -> Option<&ClampTable> {
    let clamp = case.clamp.as_ref()?;
    clamp.stage.is_empty().then_some(clamp)
}

/// A gain that the scheme takes by itself.
fn gain(case: &Case, of: fn(Pid) -> f64) -> Option<String> {
    let held = case.clamp.as_ref()?.max_pressure.is_some();
    let used = held && case.integrator.scheme == SchemeName::Explicit;
    used.then(|| format!("{:?}", of(Pid::default())))
}
