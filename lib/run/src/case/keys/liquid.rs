//! Keys of viscosity by formula and of cure.

use units::{Consistency, MolarEnergy, Pressure, ShearRate, Time, Viscosity};

use super::{Absent, Key, Table, quantity};

/// A key that its law cannot do without.
const fn needed(name: &'static str, form: fn() -> String, text: &'static str) -> Key {
    Key {
        name,
        form,
        absent: Absent::Nothing("needed with its law"),
        text,
    }
}

pub(super) const POWER_LAW: Table = law(
    "adhesive.power_law",
    "Viscosity by a power law, K rate^(n - 1), in place of `viscosity`.",
    &[
        needed("consistency", quantity::<Consistency>, "K."),
        needed("index", number, "n: below 1 the liquid thins."),
        needed(
            "rates",
            || "two shear rates".into(),
            "Where the law holds; outside, the viscosity of the nearer end.",
        ),
    ],
);

pub(super) const CROSS: Table = law(
    "adhesive.cross",
    "Viscosity by Cross, eta_inf + (eta_0 - eta_inf)/(1 + (time rate)^m), in place of `viscosity`.",
    &[
        needed("zero_rate", quantity::<Viscosity>, "eta_0."),
        needed("infinite_rate", quantity::<Viscosity>, "eta_inf."),
        needed("time", quantity::<Time>, "Time constant."),
        needed("exponent", number, "m."),
    ],
);

pub(super) const CARREAU_YASUDA: Table = law(
    "adhesive.carreau_yasuda",
    "Viscosity by Carreau and Yasuda, eta_inf + (eta_0 - eta_inf) (1 + (time rate)^a)^((n - 1)/a), in place of `viscosity`.",
    &[
        needed("zero_rate", quantity::<Viscosity>, "eta_0."),
        needed("infinite_rate", quantity::<Viscosity>, "eta_inf."),
        needed("time", quantity::<Time>, "Time constant."),
        needed("index", number, "n."),
        Key {
            name: "transition",
            form: number,
            absent: Absent::Nothing("2, the law of Carreau"),
            text: "a: how sharply the plateau ends.",
        },
    ],
);

pub(super) const HERSCHEL_BULKLEY: Table = law(
    "adhesive.herschel_bulkley",
    "Viscosity by Herschel and Bulkley, tau_y/rate + K rate^(n - 1), regularised, in place of `viscosity`.",
    &[
        needed("yield_stress", quantity::<Pressure>, "tau_y."),
        needed("consistency", quantity::<Consistency>, "K."),
        needed("index", number, "n."),
        needed(
            "regularisation_rate",
            quantity::<ShearRate>,
            "Shear rate below which the liquid creeps instead of standing: a hundredth or less of the rates that matter.",
        ),
    ],
);

pub(super) const CURE: Table = law(
    "adhesive.cure",
    "What multiplies the viscosity as the adhesive sets; implicit scheme. Steps follow it, and the run ends once the adhesive has set.",
    &[
        optional(
            "gel_time",
            quantity::<Time>,
            "t_gel of the factor (1 - t/t_gel)^-n, at the reference temperature.",
        ),
        optional(
            "exponent",
            number,
            "n of that factor; goes with `gel_time`.",
        ),
        optional(
            "factor",
            || "rows of time, factor".into(),
            "The factor as a table, in place of `gel_time`.",
        ),
        optional(
            "temperature",
            || "rows of time, temperature".into(),
            "Temperature of the bond line over time, such as `[[\"0 s\", \"20 C\"], [\"60 s\", \"140 C\"]]`.",
        ),
        optional(
            "reference_temperature",
            || "temperature, C or K".into(),
            "Temperature at which viscosity, gel time and factor hold.",
        ),
        optional(
            "activation_energy",
            quantity::<MolarEnergy>,
            "Of cure (Arrhenius): how much faster it goes when hot.",
        ),
        optional(
            "flow_activation_energy",
            quantity::<MolarEnergy>,
            "Of flow (Arrhenius): how much thinner the liquid is when hot.",
        ),
    ],
);

const fn optional(name: &'static str, form: fn() -> String, text: &'static str) -> Key {
    Key {
        name,
        form,
        absent: Absent::Nothing("not used"),
        text,
    }
}

const fn law(path: &'static str, about: &'static str, keys: &'static [Key]) -> Table {
    Table {
        path,
        repeated: false,
        always: false,
        about,
        keys,
    }
}

fn number() -> String {
    "number".into()
}
