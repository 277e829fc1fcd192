//! The liquid of a case.

use physics::{Course, Cure, CureLaw, Law, Liquid, Newtonian, Table, Tait, Viscosity, Wetting};

use super::water::water;
use crate::case::{Adhesive, CaseError, CureTable};

/// The liquid of `[adhesive]`.
///
/// # Errors
/// No viscosity or two, a table or a law out of range.
pub(super) fn liquid(adhesive: &Adhesive) -> Result<Liquid, CaseError> {
    Ok(Liquid {
        density: adhesive.density.si(),
        tait: Tait {
            bulk_modulus: adhesive.bulk_modulus.si(),
        },
        viscosity: viscosity(adhesive)?,
        cure: adhesive.cure.as_ref().map(cure).transpose()?,
        water: (adhesive.water.as_ref())
            .map(|table| water(table, adhesive.density.si()))
            .transpose()?,
        shear_rate: adhesive.shear_rate,
        cavitation_pressure: adhesive.cavitation_pressure.map(|p| p.si()),
        wetting: wetting(adhesive)?,
    })
}

fn wetting(adhesive: &Adhesive) -> Result<Option<Wetting>, CaseError> {
    let refused = |said: &str| Err(CaseError(format!("[adhesive] {said}")));
    match (adhesive.surface_tension, adhesive.contact_angle) {
        (Some(tension), Some(angle)) => {
            let contact_angle = angle.si();
            if !(0.0..=std::f64::consts::PI).contains(&contact_angle) {
                return refused("contact_angle lies between \"0 deg\" and \"180 deg\"");
            }
            Ok(Some(Wetting {
                tension: tension.si(),
                contact_angle,
            }))
        }
        (None, None) if adhesive.dynamic_angle.is_some() => {
            refused("dynamic_angle goes with surface_tension and contact_angle")
        }
        (None, None) => Ok(None),
        _ => refused("surface_tension and contact_angle go together"),
    }
}

fn viscosity(adhesive: &Adhesive) -> Result<Viscosity, CaseError> {
    let refused = |said: String| CaseError(format!("[adhesive] {said}"));
    let newtonian = (adhesive.viscosity).map(|eta| Ok(Viscosity::Newtonian(Newtonian(eta.si()))));
    let table = adhesive.viscosity_table.as_ref().map(|points| {
        let points: Vec<_> = (points.iter())
            .map(|(rate, eta)| (rate.si(), eta.si()))
            .collect();
        let table = Table::new(&points).map_err(refused)?;
        Ok(Viscosity::Table(table))
    });
    let power = adhesive.power_law.map(|law| Law::Power {
        k: law.consistency.si(),
        n: law.index,
        rates: law.rates.map(|rate| rate.si()),
    });
    let cross = adhesive.cross.map(|law| Law::Cross {
        eta: [law.zero_rate.si(), law.infinite_rate.si()],
        time: law.time.si(),
        m: law.exponent,
    });
    let carreau = adhesive.carreau_yasuda.map(|law| Law::CarreauYasuda {
        eta: [law.zero_rate.si(), law.infinite_rate.si()],
        time: law.time.si(),
        n: law.index,
        a: law.transition,
    });
    let herschel = adhesive.herschel_bulkley.map(|law| Law::HerschelBulkley {
        tau: law.yield_stress.si(),
        k: law.consistency.si(),
        n: law.index,
        r: law.regularisation_rate.si(),
    });
    let laws = [power, cross, carreau, herschel];
    let laws = laws.into_iter().flatten().map(|law| {
        law.check().map_err(refused)?;
        Ok(Viscosity::Law(law))
    });
    let mut given = newtonian.into_iter().chain(table).chain(laws);
    match (given.next(), given.next()) {
        (Some(one), None) => one,
        (Some(_), Some(_)) => Err(refused(format!(
            "has more than one of {KEYS}: only one can hold"
        ))),
        (None, _) => Err(refused(format!("needs viscosity or another of {KEYS}"))),
    }
}

const KEYS: &str =
    "viscosity, viscosity_table, power_law, cross, carreau_yasuda and herschel_bulkley";

fn cure(table: &CureTable) -> Result<Cure, CaseError> {
    let refused = |said: &str| CaseError(format!("[adhesive.cure] {said}"));
    let course = match (table.gel_time, table.exponent, &table.factor) {
        (Some(time), Some(exponent), None) => Some(Course::Gel {
            time: time.si(),
            exponent,
        }),
        (None, None, Some(points)) => {
            let points = points.iter().map(|(time, factor)| (time.si(), *factor));
            Some(Course::Table(points.collect()))
        }
        (None, None, None) => None,
        _ => {
            return Err(refused(
                "takes either gel_time and exponent, for (1 - t/t_gel)^-n, or factor, a table",
            ));
        }
    };
    if table.activation_energy.is_some() && course.is_none() {
        return Err(refused(
            "activation_energy is that of gel_time or factor: one of them is needed",
        ));
    }
    let heats = table.activation_energy.is_some() || table.flow_activation_energy.is_some();
    let reference = match (&table.temperature, table.reference_temperature) {
        (Some(points), Some(reference)) if heats && !points.is_empty() => reference.0,
        // Any: nothing depends on it.
        (None, None) if !heats => 300.0,
        _ => {
            return Err(refused(
                "temperature, reference_temperature and activation_energy or flow_activation_energy go together",
            ));
        }
    };
    let energy =
        |given: Option<crate::case::Positive<units::MolarEnergy>>| given.map_or(0.0, |e| e.si());
    let law = CureLaw {
        course,
        temperature: (table.temperature.iter().flatten())
            .map(|(time, kelvin)| (time.si(), kelvin.0))
            .collect(),
        reference,
        cure_energy: energy(table.activation_energy),
        flow_energy: energy(table.flow_activation_energy),
    };
    Cure::new(&law).map_err(|said| refused(&said))
}
