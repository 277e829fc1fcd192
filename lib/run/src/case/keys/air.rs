//! Keys of trapped air.

use units::{Pressure, Time};

use super::{Absent, Key, Table, quantity};

pub(super) const AIR: Table = Table {
    path: "air",
    repeated: false,
    always: false,
    about: "Air that liquid and walls close off keeps its mass: each pocket of it has a pressure, by p V = constant, that the liquid presses against; implicit scheme. Without this table all air is at the pressure around, from which the liquid's pressures are counted.",
    keys: &[
        Key {
            name: "pressure",
            form: quantity::<Pressure>,
            absent: Absent::Needed("always"),
            text: "Absolute pressure of the air around, which a pocket has when it is closed off: `\"101.325 kPa\"`. An open side of the domain, and with `[clamp]` both sides normal to y, are outside; a mirror closes air off.",
        },
        Key {
            name: "leak_time",
            form: quantity::<Time>,
            absent: Absent::Nothing("walls are tight"),
            text: "Air leaks through the walls of pockets (pits): time in which the pressure of a pocket of fixed volume above that around falls to 1/e.",
        },
    ],
};
