//! Keys of the scheme and of what a run writes.

use mpm::{PressureFrom, VelocityUpdate};
use physics::Choice;
use units::Time;

use super::{Absent, Key, Table, choice, quantity, si, word};
use crate::case::{Case, SchemeName};
use crate::schemes;

pub(super) const INTEGRATOR: Table = Table {
    path: "integrator",
    repeated: false,
    always: true,
    about: "Scheme and its options. A key of the other scheme is refused.",
    keys: &[
        Key {
            name: "scheme",
            form: choice::<SchemeName>,
            absent: Absent::Needed("always"),
            text: "`\"explicit\"`: the paper's material point method. `\"implicit\"`: pressure and viscosity solved for, the liquid as volume fractions on a grid that closes with the press, walls at the voxel faces: for results, and for anything slower than 1 m/s.",
        },
        Key {
            name: "velocity_update",
            form: choice::<VelocityUpdate>,
            absent: Absent::Of("`\"flip\"`", |case, _| {
                of_explicit(case, VelocityUpdate::default().name())
            }),
            text: "Explicit scheme: how points take their velocity from the nodes. The paper runs `\"flip\"` and `\"xpic\"` of order 5.",
        },
        Key {
            name: "order",
            form: || "1 to 20".into(),
            absent: Absent::Needed("with `\"xpic\"` and `\"fmpm\"`"),
            text: "Order of the velocity filter; each takes a third of a FLIP step more.",
        },
        Key {
            name: "cfl",
            form: || "number, at most 1.5".into(),
            absent: Absent::Of("0.5; implicit: 1", |case, _| {
                Some(format!("{:?}", schemes::cfl(case)))
            }),
            text: "Courant number: the time step over the limit that binds; implicit: cells that the fastest liquid crosses in a step. Lower it where a run stops as unstable: `--resume --set integrator.cfl=0.25` goes on from the last checkpoint. Nothing else may change in a run.",
        },
        Key {
            name: "pressure",
            form: choice::<PressureFrom>,
            absent: Absent::Of("`\"point\"`", |case, _| {
                of_explicit(case, PressureFrom::default().name())
            }),
            text: "Explicit scheme: whose volume change sets a point's pressure. `\"cell-mean\"` is not the paper's; it takes most of the excess pressure in narrow lumens away ([explicit options](results/explicit-options.md)).",
        },
        Key {
            name: "density_projection",
            form: || "length, cells".into(),
            absent: Absent::Nothing("none, as in the paper"),
            text: "Explicit scheme: way of the fastest point between two projections of the points to uniform density, such as `\"0.04 cell\"`. Where liquid is to fill lumens without gaps and clumps.",
        },
        Key {
            name: "tolerance",
            form: || "1e-8 to 1e-2".into(),
            absent: Absent::Of("1e-3", |case, _| {
                let used = case.integrator.scheme != SchemeName::Explicit;
                used.then(|| format!("{:?}", implicit::Settings::default().tolerance))
            }),
            text: "Implicit scheme: relative residual at which a step's linear solve ends. 1e-3 keeps forces to 0.1 to 0.3 %; 1e-4 is for verification.",
        },
    ],
};

pub(super) const OUTPUT: Table = Table {
    path: "output",
    repeated: false,
    always: true,
    about: "What is written while the run goes on.",
    keys: &[
        Key {
            name: "snapshots",
            form: || "0 to 1000000".into(),
            absent: Absent::Value("0"),
            text: "States written over the time of a closing at full speed, evenly; a run that a pressure limit slows down writes more. Needed for shear rates and films.",
        },
        Key {
            name: "history_every",
            form: quantity::<Time>,
            absent: Absent::Of(
                "a thousandth of the closing time at full speed, or of `stop.time`; each step of a press programme",
                |_, setup| (setup.history_every_s > 0.0).then(|| si::<Time>(setup.history_every_s)),
            ),
            text: "Time between rows of `history.csv`. Rows are also when a run is looked at for speed and compression.",
        },
        Key {
            name: "penetration",
            form: || "`true`, `false`".into(),
            absent: Absent::Value("false"),
            text: "Whether each row of `history.csv` also tells what the press has come to (WP, EP, depth of 95 % of the adhesive, wetted area, depth to which open lumens are half full, state of the bond line), measured as `wp-metrics --series` does. A row costs about a fifth of an implicit step; `summary.json` has the end in any case. With a bond file, in three dimensions.",
        },
    ],
};

fn of_explicit(case: &Case, name: &str) -> Option<String> {
    let used = case.integrator.scheme == SchemeName::Explicit;
    used.then(|| word(name))
}
