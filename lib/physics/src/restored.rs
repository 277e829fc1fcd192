//! Checks that every scheme makes before it restores a saved state: a checkpoint is a file that anyone can write, with a
//! valid checksum.

use crate::{Motion, Scene, Stop};

/// Largest displacement of a body, cells.
const MOST_CELLS: f64 = 1e9;
/// Rounding of sums of the same steps, relative.
const ROUNDING: f64 = 1e-6;

/// Refuses `values` that are not all finite.
///
/// # Errors
/// The name of the array and the index of the first such value.
pub fn check_finite<T: Copy + Into<f64>>(values: &[T], name: &str) -> Result<(), String> {
    match values.iter().position(|&x| !x.into().is_finite()) {
        None => Ok(()),
        Some(i) => Err(format!(
            "array '{name}' of the checkpoint has a value that is not a finite number at place {i}"
        )),
    }
}

/// Refuses point numbers that are not distinct numbers below `total`, the points of the scene, or whose count and `lost`
/// do not add up to `total`.
///
/// # Errors
/// A sentence on what is wrong.
pub fn check_points(id: &[u32], total: usize, lost: u64) -> Result<(), String> {
    if (id.len() as u64).checked_add(lost) != Some(total as u64) || id.is_empty() {
        return Err(format!(
            "the checkpoint has {} points and counts {lost} as lost, but the scene has {total}",
            id.len()
        ));
    }
    let mut seen = vec![false; total];
    for &point in id {
        match seen.get_mut(point as usize) {
            Some(seen) if !*seen => *seen = true,
            _ => {
                return Err(format!(
                    "the checkpoint has point {point} twice, or too many"
                ));
            }
        }
    }
    Ok(())
}

/// Refuses displacements (m) that bodies with these motions cannot have at clamp travel `travel_m`.
///
/// # Errors
/// The body with a wrong displacement.
pub fn check_bodies(
    scene_motions: &[Motion],
    displacement: &[[f64; 3]],
    travel_m: f64,
    cell_m: f64,
) -> Result<(), String> {
    if displacement.len() != scene_motions.len() {
        return Err(format!(
            "the checkpoint has {} rigid bodies, the scene {}",
            displacement.len(),
            scene_motions.len()
        ));
    }
    let near = |a: f64, b: f64| (a - b).abs() <= ROUNDING * (a.abs() + cell_m);
    for (body, (motion, d)) in scene_motions.iter().zip(displacement).enumerate() {
        let fits = match motion {
            Motion::Fixed => *d == [0.0; 3],
            Motion::Clamped => d[0] == 0.0 && d[2] == 0.0 && near(d[1], -travel_m),
            Motion::Constant(_) => d.iter().all(|x| x.abs() <= MOST_CELLS * cell_m),
        };
        if !fits {
            return Err(format!(
                "rigid body {body} of the checkpoint is displaced by {d:?} m, which its motion cannot do"
            ));
        }
    }
    Ok(())
}

/// Refuses a clamp travel (m) that a run of `scene` cannot have.
///
/// # Errors
/// The travel and its possible range.
pub fn check_travel(scene: &Scene, travel_m: f64) -> Result<(), String> {
    let most = match scene.stop {
        Stop::Closed { travel_m } => travel_m * (1.0 + ROUNDING),
        Stop::Time(_) => MOST_CELLS * scene.grid.cell_m,
    };
    match (0.0..=most).contains(&travel_m) {
        true => Ok(()),
        false => Err(format!(
            "the clamp travel of the checkpoint, {travel_m:e} m, is not from 0 to {most:e} m"
        )),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_no_run_saves_is_refused() {
        assert!(check_finite(&[0.0_f32, 1.0], "a").is_ok());
        assert!(check_finite(&[0.0, f64::NAN], "a").is_err());
        assert!(check_points(&[2, 0], 3, 1).is_ok());
        for (id, lost) in [
            (vec![2, 2], 1),
            (vec![3, 0], 1),
            (vec![0], 0),
            (vec![], 3),
            (vec![0], u64::MAX),
        ] {
            assert!(check_points(&id, 3, lost).is_err(), "{id:?} {lost}");
        }
        let motions = [Motion::Fixed, Motion::Clamped, Motion::Constant([1.0; 3])];
        let bodies = |d: [[f64; 3]; 3]| check_bodies(&motions, &d, 2e-6, 1e-6);
        let sound = [[0.0; 3], [0.0, -2e-6, 0.0], [5.0, 0.0, 1e-6]];
        assert!(bodies(sound).is_ok());
        for (body, d) in [
            (0, [0.0, 1e-9, 0.0]),
            (1, [0.0; 3]),
            (1, [f64::NAN; 3]),
            (2, [1e30; 3]),
        ] {
            let mut forged = sound;
            forged[body] = d;
            assert!(bodies(forged).is_err(), "{body} {d:?}");
        }
        assert!(check_bodies(&motions, &sound[..2], 2e-6, 1e-6).is_err());
    }
}
