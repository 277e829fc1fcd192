//! The density projection evens out the density and leaves free surfaces alone.

use physics::VoxelBlock;

use super::*;
use crate::geometry::Lattice;
use crate::geometry::tests::{domain, lattice};
use crate::liquid::tests::at;
use crate::liquid::{Bins, Fractions, Particles, Volumes};
use crate::system::{Before, Operator, Scales};
use crate::transport::Path;

/// Root mean square and mean of r - 1 over the full cells.
fn error(fractions: &Fractions) -> [f64; 2] {
    let full = (fractions.cell.iter().zip(&fractions.density)).filter(|(phi, _)| **phi >= 0.999);
    let errors: Vec<f64> = full.map(|(_, &r)| f64::from(r) - 1.0).collect();
    let n = errors.len() as f64;
    [
        (errors.iter().map(|e| e * e).sum::<f64>() / n).sqrt(),
        errors.iter().sum::<f64>() / n,
    ]
}

/// One projection of liquid in a channel; density error before it, iterations, and the part of what was to
/// be pushed out that is not.
fn project(lattice: &Lattice, particles: &mut Particles) -> ([f64; 2], usize, f64) {
    let window = &lattice.window;
    let mut bins = Bins::default();
    particles.sort(window, &mut bins);
    let mut fractions = Fractions::default();
    fractions.update(particles, &bins, lattice, &[[0.0; 3]; 2]);
    let volumes = Volumes::new(lattice, &fractions.liquid);
    let operator = Operator::new(lattice, &volumes, Scales::plain());
    let dofs = &operator.dofs;
    let before = Before {
        velocity: &vec![0.0; dofs.faces.len()],
        pressure: &vec![0.0; dofs.cells.len()],
        stiffness: &vec![1.0; dofs.cells.len()],
        lost: &[],
        air: &[],
    };
    let system = operator.assemble(&[[0.0; 3]], before).unwrap();
    let pick =
        |field: &[f32]| -> Vec<f32> { dofs.cells.iter().map(|&c| field[c as usize]).collect() };
    let cells = Cells {
        density: pick(&fractions.density),
        fraction: pick(&volumes.fraction),
        volume: pick(&volumes.cell),
    };
    let (moves, iterations) = displacement(
        &system.g,
        &system.g.transpose(),
        &system.face_volume,
        &cells,
        1.0,
    )
    .unwrap();
    assert!(moves.iter().all(|d| d.abs() <= LONGEST));
    let mut pushed = vec![0.0; cells.volume.len()];
    system.g.multiply(&moves, &mut pushed);
    let [mut square, mut wanted] = [0.0; 2];
    for (cell, pushed) in pushed.iter().enumerate() {
        let error = (f64::from(cells.density[cell]) - 1.0).clamp(-CLIP, CLIP);
        let surface = error < 0.0 && cells.fraction[cell] < FULL;
        let half = if surface {
            0.0
        } else {
            0.5 * error * f64::from(cells.volume[cell])
        };
        square += (pushed - half).powi(2);
        wanted += half * half;
    }
    let left = (square / wanted).sqrt();
    let field = Field::new(window, &dofs.face, moves);
    let path = Path {
        before: &lattice.solids,
        after: &lattice.solids,
        scale: 1.0,
    };
    let moved = path.follow(particles, |x, near| field.at(x, near));
    assert_eq!(moved.pinched, 0);
    (error(&fractions), iterations, left)
}

/// Liquid that is 15 % too dense here and too thin there in a channel with walls off the cells,
/// with a free surface at one end.
fn perturbed(axes: usize) -> (Lattice, Particles) {
    let depth = if axes == 3 { 6 } else { 1 };
    let end = depth as f64;
    let walls = vec![
        VoxelBlock::solid_box([0.0, 0.0, 0.0], [30.0, 1.3, end]),
        VoxelBlock::solid_box([0.0, 7.3, 0.0], [30.0, 10.0, end]),
    ];
    let lattice = lattice(domain([30, 10, depth], axes), vec![walls]);
    let mut points = Vec::new();
    for k in 0..if axes == 3 { 2 * depth } else { 1 } {
        for j in 0..12 {
            for i in 0..40 {
                let x = 0.25 + 0.5 * f64::from(i);
                let wave = 0.3 * (std::f64::consts::PI * x / 5.0).sin();
                let z = if axes == 3 {
                    0.25 + 0.5 * k as f64
                } else {
                    0.5
                };
                points.push([x + wave, 1.55 + 0.5 * f64::from(j), z]);
            }
        }
    }
    (lattice, at(points, if axes == 3 { 0.125 } else { 0.25 }))
}

#[test]
fn the_density_of_perturbed_liquid_evens_out() {
    for axes in [2, 3] {
        let (lattice, mut particles) = perturbed(axes);
        let volume = particles.total_volume();
        let mut errors = Vec::new();
        for _ in 0..10 {
            let (error, iterations, left) = project(&lattice, &mut particles);
            println!("{iterations} iterations, {left:.3} left");
            assert!(iterations < 20 && left < 0.1);
            errors.push(error);
        }
        for (step, [rms, mean]) in errors.iter().enumerate() {
            println!("{axes}D step {step}: density error rms {rms:.4}, mean {mean:+.4}");
        }
        assert!(errors[0][0] > 0.1, "not perturbed");
        assert!(errors[1][0] < 0.65 * errors[0][0] && errors[9][0] < 0.3 * errors[0][0]);
        assert!(errors[9][1].abs() < 0.015);
        assert_eq!(particles.total_volume(), volume);
        let inside = |x: &[f64; 3]| x[1] > 1.3 && x[1] < 7.3;
        assert!(particles.position.iter().all(inside));
    }
}

/// Fewer particles per cell at the free surface than inside is no error: nothing moves there.
#[test]
fn a_partly_filled_surface_is_left_alone() {
    let (lattice, mut particles) = perturbed(2);
    particles
        .position
        .iter_mut()
        .enumerate()
        .for_each(|(p, x)| {
            x[0] = 0.25 + 0.5 * (particles.id[p] % 40) as f64;
        });
    particles.retain(|x| x[0] < 16.0 || ((x[0] * 2.0) as u64).is_multiple_of(2) && x[0] < 17.0);
    let before: f64 = particles.position.iter().map(|x| x[0]).fold(0.0, f64::max);
    for _ in 0..5 {
        project(&lattice, &mut particles);
    }
    let after: f64 = particles.position.iter().map(|x| x[0]).fold(0.0, f64::max);
    println!("surface at {before:.3} before, {after:.3} after five projections");
    assert!((after - before).abs() < 0.15);
}

/// Cells with a passage each: half of an error of at most 0.3 is taken away, by a quarter of a cell
/// at most; a crowded cell behind a narrow passage does not hold back the rest, and where the
/// liquid fraction is below 0.85 there is no lack of liquid but its surface.
#[test]
fn a_cell_alone_moves_by_its_error() {
    let passage = [1.0, 1.0, 0.5, 1.0, 1.0];
    let g = Csr::assemble(5, 5, |row, entries| entries.add(row, passage[row])).unwrap();
    let cells = Cells {
        density: vec![1.1, 2.0, 2.0, 0.9, 0.9],
        fraction: vec![1.0, 1.0, 1.0, 0.84, 0.86],
        volume: vec![1.0; 5],
    };
    let (moves, _) = displacement(&g, &g.transpose(), &[1.0; 5], &cells, 1.0).unwrap();
    for (moved, wanted) in moves.iter().zip([0.05, 0.15, 0.25, 0.0, -0.05]) {
        assert!((moved - wanted).abs() < 1e-3, "{moves:?}");
    }
}

/// After a step in which nothing went farther than 0.0004 cells, 0.4 of what a step removes; where all rests, nothing.
#[test]
fn liquid_that_rests_is_left_where_it_is() {
    let g = Csr::assemble(1, 1, |_, entries| entries.add(0, 1.0)).unwrap();
    let cells = Cells {
        density: vec![1.1],
        fraction: vec![1.0],
        volume: vec![1.0],
    };
    for (way, wanted) in [(0.001, 0.05), (0.0004, 0.02), (0.0, 0.0)] {
        let (moves, _) = displacement(&g, &g.transpose(), &[1.0], &cells, way).unwrap();
        assert!((moves[0] - wanted).abs() < 1e-6, "{way}: {moves:?}");
    }
}

/// Two faces of one cell share what it pushes out by their volumes, of which 0.02 counts at least.
#[test]
fn a_face_with_next_to_no_liquid_takes_its_share() {
    let g = Csr::assemble(1, 2, |_, entries| {
        (0..2).for_each(|face| entries.add(face, 1.0))
    });
    let g = g.unwrap();
    let cells = Cells {
        density: vec![1.1],
        fraction: vec![1.0],
        volume: vec![1.0],
    };
    let (moves, _) = displacement(&g, &g.transpose(), &[0.001, 1.0], &cells, 1.0).unwrap();
    assert!((moves[0] / moves[1] / 50.0 - 1.0).abs() < 1e-3, "{moves:?}");
}
