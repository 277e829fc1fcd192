//! Keys of a press programme.

use physics::Press;
use units::{Length, Pressure, Speed, Time};

use super::{Absent, Key, Table, choice, quantity};

pub(super) const STAGE: Table = Table {
    path: "clamp.stage",
    repeated: true,
    always: false,
    about: "A stage of a press programme, in place of one speed, one limit and one end; implicit scheme. The run ends with the last stage.",
    keys: &[
        Key {
            name: "kind",
            form: choice::<Press>,
            absent: Absent::Needed("always"),
            text: "`\"approach\"` closes at its speed, `\"ramp\"` goes evenly to its pressure, `\"hold\"` keeps it, `\"release\"` takes it away.",
        },
        Key {
            name: "speed",
            form: quantity::<Speed>,
            absent: Absent::Nothing("that of the stage before; the first needs one"),
            text: "Largest speed of the clamp, closing or giving way.",
        },
        Key {
            name: "pressure",
            form: quantity::<Pressure>,
            absent: Absent::Nothing("a hold: that of the stage before"),
            text: "Ends an approach, is where a ramp goes, is what a hold keeps.",
        },
        Key {
            name: "time",
            form: quantity::<Time>,
            absent: Absent::Nothing("an approach: until the clamp has gone all its way"),
            text: "Longest duration of the stage, microseconds to hours: steps follow the flow.",
        },
        Key {
            name: "travel",
            form: quantity::<Length>,
            absent: Absent::Nothing("no such end"),
            text: "Ends the stage at this way of the clamp since the start of the run.",
        },
        Key {
            name: "contact",
            form: || "true, false".into(),
            absent: Absent::Nothing("no such end"),
            text: "Ends an approach with the first step in which liquid presses on the clamp's body.",
        },
        Key {
            name: "slower",
            form: quantity::<Speed>,
            absent: Absent::Nothing("no such end"),
            text: "Ends a hold or a release when the clamp is slower, which is what leaves the bond line per area and time. Give it where nobody knows how long to press.",
        },
    ],
};
