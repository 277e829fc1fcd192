//! Keys of the loss of water.

use units::{Diffusivity, Length, Speed};

use super::{Absent, Key, Table, quantity};

pub(super) const WATER: Table = Table {
    path: "adhesive.water",
    repeated: false,
    always: false,
    about: "Loss of water into the cell walls, which thickens the adhesive and takes from its volume; implicit scheme. The run ends once the adhesive has set.",
    keys: &[
        needed(
            "solids",
            number,
            "Solids content at the start, by mass; the density of [adhesive] is of that.",
        ),
        needed(
            "uptake",
            quantity::<Speed>,
            "Volume of water that wood takes per wetted area and time.",
        ),
        needed(
            "diffusivity",
            quantity::<Diffusivity>,
            "Of water in the adhesive: how fast the middle of a lumen feeds its walls. Water's own is 2e-9 m2/s; 1e-10 m2/s and less in thick resin.",
        ),
        needed(
            "viscosity_by_solids",
            || "rows of solids content, factor".into(),
            "What multiplies the viscosity, from `[solids, 1.0]` on: linear in the logarithm of the factor.",
        ),
        Key {
            name: "capacity",
            form: quantity::<Length>,
            absent: Absent::Nothing("without end"),
            text: "Volume of water that wetted wood holds per area, then it is full: half the thickness of a cell wall times the water that its volume takes up.",
        },
        Key {
            name: "limit",
            form: number,
            absent: Absent::Nothing("the last row of `viscosity_by_solids`"),
            text: "Solids content from which wood takes no more.",
        },
        Key {
            name: "walls",
            form: || "list of names".into(),
            absent: Absent::Nothing("all bodies"),
            text: "Names of the bodies that take water: `wood-bottom` and `wood-top` of a bond file, or those of `[[body]]`.",
        },
    ],
};

const fn needed(name: &'static str, form: fn() -> String, text: &'static str) -> Key {
    Key {
        name,
        form,
        absent: Absent::Needed("in this table"),
        text,
    }
}

fn number() -> String {
    "number".into()
}
