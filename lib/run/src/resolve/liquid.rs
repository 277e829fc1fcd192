//! The liquid of a case.

use physics::{
    Course, Cure, CureLaw, Law, Liquid, Newtonian, RigidBody, Table, Tait, Viscosity, Water,
    WaterLaw, Wetting,
};

use crate::case::{Adhesive, CureTable, WaterTable};
use crate::failure::{RunFailure, refused};

/// The liquid of `[adhesive]`.
/// Errors: no viscosity or more than one, a table or a law out of range.
pub(super) fn liquid(adhesive: &Adhesive) -> Result<Liquid, RunFailure> {
    let density = adhesive.density.si();
    let water = adhesive.water.as_ref().map(|table| water(table, density));
    Ok(Liquid {
        density,
        tait: Tait {
            bulk_modulus: adhesive.bulk_modulus.si(),
        },
        viscosity: viscosity(adhesive)?,
        cure: adhesive.cure.as_ref().map(cure).transpose()?,
        water: water.transpose()?,
        shear_rate: adhesive.shear_rate,
        cavitation_pressure: adhesive.cavitation_pressure.map(|p| p.si()),
        wetting: wetting(adhesive)?,
    })
}

fn wetting(adhesive: &Adhesive) -> Result<Option<Wetting>, RunFailure> {
    match (adhesive.surface_tension, adhesive.contact_angle) {
        (Some(tension), Some(angle)) => {
            let contact_angle = angle.si();
            if !(0.0..=std::f64::consts::PI).contains(&contact_angle) {
                return refused("[adhesive] contact_angle lies between \"0 deg\" and \"180 deg\"");
            }
            Ok(Some(Wetting {
                tension: tension.si(),
                contact_angle,
            }))
        }
        (None, None) if adhesive.dynamic_angle.is_some() => {
            refused("[adhesive] dynamic_angle goes with surface_tension and contact_angle")
        }
        (None, None) => Ok(None),
        _ => refused("[adhesive] surface_tension and contact_angle go together"),
    }
}

fn viscosity(adhesive: &Adhesive) -> Result<Viscosity, RunFailure> {
    const KEYS: &str =
        "viscosity, viscosity_table, power_law, cross, carreau_yasuda and herschel_bulkley";
    let out_of_range = |said: String| RunFailure::Usage(format!("[adhesive] {said}"));
    let newtonian = (adhesive.viscosity).map(|eta| Ok(Viscosity::Newtonian(Newtonian(eta.si()))));
    let table = adhesive.viscosity_table.as_ref().map(|rows| {
        let rows: Vec<_> = rows.iter().map(|(r, eta)| (r.si(), eta.si())).collect();
        let table = Table::new(&rows).map_err(out_of_range)?;
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
        law.check().map_err(out_of_range)?;
        Ok(Viscosity::Law(law))
    });
    let mut given = newtonian.into_iter().chain(table).chain(laws);
    match (given.next(), given.next()) {
        (Some(one), None) => one,
        (Some(_), Some(_)) => refused(format!(
            "[adhesive] has more than one of {KEYS}: give only one"
        )),
        (None, _) => refused(format!("[adhesive] needs viscosity or another of {KEYS}")),
    }
}

fn cure(table: &CureTable) -> Result<Cure, RunFailure> {
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
            return refused(
                "[adhesive.cure] takes either gel_time and exponent, for (1 - t/t_gel)^-n, or factor, a table",
            );
        }
    };
    if table.activation_energy.is_some() && course.is_none() {
        return refused("[adhesive.cure] activation_energy needs gel_time or factor");
    }
    let heats = table.activation_energy.is_some() || table.flow_activation_energy.is_some();
    let reference = match (&table.temperature, table.reference_temperature) {
        (Some(points), Some(reference)) if heats && !points.is_empty() => reference.0,
        // Any value: nothing depends on it.
        (None, None) if !heats => 300.0,
        _ => {
            return refused(
                "[adhesive.cure] temperature, reference_temperature and activation_energy or flow_activation_energy go together",
            );
        }
    };
    let law = CureLaw {
        course,
        temperature: (table.temperature.iter().flatten())
            .map(|(time, kelvin)| (time.si(), kelvin.0))
            .collect(),
        reference,
        cure_energy: table.activation_energy.map_or(0.0, |e| e.si()),
        flow_energy: table.flow_activation_energy.map_or(0.0, |e| e.si()),
    };
    Cure::new(&law).map_err(|said| RunFailure::Usage(format!("[adhesive.cure] {said}")))
}

/// The loss of water of `[adhesive.water]`, for a liquid of `density` (kg/m3).
fn water(table: &WaterTable, density: f64) -> Result<Water, RunFailure> {
    let law = WaterLaw {
        uptake: table.uptake.si(),
        solids: table.solids,
        capacity: table.capacity.map(|length| length.si()),
        limit: table.limit,
        diffusivity: table.diffusivity.si(),
        factor: table.viscosity_by_solids.clone(),
        walls: table.walls.clone(),
    };
    Water::new(law, density).map_err(|said| RunFailure::Usage(format!("[adhesive.water] {said}")))
}

/// Refuses names in `[adhesive.water] walls` that no body has.
pub(super) fn check_walls(liquid: &Liquid, bodies: &[RigidBody]) -> Result<(), RunFailure> {
    let Some(water) = &liquid.water else {
        return Ok(());
    };
    let names: Vec<&str> = bodies.iter().map(|body| body.name.as_str()).collect();
    if names.is_empty() {
        return refused("[adhesive.water] needs a wall, but the scene has no rigid body");
    }
    match water.stray(&names) {
        None => Ok(()),
        Some(name) => refused(format!(
            "[adhesive.water] walls: there is no rigid body '{name}', only {}",
            names.join(", ")
        )),
    }
}
