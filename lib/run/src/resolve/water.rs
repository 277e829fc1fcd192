//! The loss of water of a case.

use physics::{RigidBody, Water, WaterLaw};

use crate::case::{CaseError, WaterTable};

/// What `[adhesive.water]` says, of a liquid of `density` (kg/m3).
///
/// # Errors
/// Numbers out of range.
pub(super) fn water(table: &WaterTable, density: f64) -> Result<Water, CaseError> {
    let law = WaterLaw {
        uptake: table.uptake.si(),
        solids: table.solids,
        capacity: table.capacity.map(|length| length.si()),
        limit: table.limit,
        diffusivity: table.diffusivity.si(),
        factor: table.viscosity_by_solids.clone(),
        walls: table.walls.clone(),
    };
    Water::new(law, density).map_err(|said| CaseError(format!("[adhesive.water] {said}")))
}

/// Refuses walls that no body is.
pub(super) fn check(water: &Water, bodies: &[RigidBody]) -> Result<(), CaseError> {
    let names: Vec<&str> = bodies.iter().map(|body| body.name.as_str()).collect();
    if names.is_empty() {
        return Err(CaseError(
            "[adhesive.water] has no wall to go into: the scene has no rigid body".into(),
        ));
    }
    match water.stray(&names) {
        None => Ok(()),
        Some(name) => Err(CaseError(format!(
            "[adhesive.water] walls has '{name}', which no rigid body is named: there is {}",
            names.join(", ")
        ))),
    }
}
