//! Steady flows driven by moving bodies: forces against lubrication theory and an independent
//! finite-element solution. Run with `--nocapture` to see the errors.

use super::flow::{Flow, worst};
use physics::VoxelBlock;

/// Force between plates closing at unit speed over the exact 8 V a^3/h^3 (plane) for a film of
/// half-length `a` gaps; influence length `slip`, all in cells. By symmetry half of it.
fn squeeze_film(gap: f64, aspect: usize, offset: f64, slip: f64) -> f64 {
    let half = aspect * gap as usize;
    let low = 2.0 + offset;
    let cells = [half + 6, gap as usize + 5, 1];
    let plate =
        |from: f64, to: f64| vec![VoxelBlock::solid_box([-9.0, from, 0.0], [999.0, to, 1.0])];
    let mut flow = Flow::new(cells, 2, vec![plate(-9.0, low), plate(low + gap, 99.0)]);
    flow.slip = slip;
    flow.speeds[1] = [0.0, -1.0, 0.0];
    let solved = flow.solve(|x| x[0] < half as f64);
    let balance = solved.forces[0][1] / solved.forces[1][1] + 1.0;
    assert!(
        balance.abs() < 1e-3,
        "the plates' forces differ by {balance}"
    );
    let mobility = 1.0 + 6.0 * slip / gap;
    solved.forces[1][1] / (4.0 * (half as f64 / gap).powi(3)) * mobility
}

#[test]
fn squeeze_film_between_plates() {
    for (gap, tolerance) in [(2.0, 0.1), (3.0, 0.02), (6.0, 0.01)] {
        for slip in [0.0, 0.01] {
            let error =
                worst((0..4).map(|i| squeeze_film(gap, 16, 0.25 * f64::from(i), slip) - 1.0));
            println!("squeeze film, gap {gap}, influence length {slip}: force error {error:+.4}");
            assert!(error.abs() < tolerance, "gap {gap}: {error}");
        }
    }
}

/// Shear stress between plates `n` cells apart, one sliding, over the exact 1/(n + 2 l); the
/// slip velocity is the stress times the influence length l.
fn couette(n: f64, offset: f64, slip: f64) -> f64 {
    let low = 2.0 + offset;
    let plate =
        |from: f64, to: f64| vec![VoxelBlock::solid_box([-9.0, from, 0.0], [99.0, to, 1.0])];
    let cells = [4, n as usize + 5, 1];
    let mut flow = Flow::new(cells, 2, vec![plate(-9.0, low), plate(low + n, 99.0)]);
    flow.domain.boundary[0] = physics::Boundary::Periodic;
    flow.slip = slip;
    flow.speeds[1] = [1.0, 0.0, 0.0];
    -flow.solve(|_| true).forces[1][0] / 4.0 * (n + 2.0 * slip)
}

/// The wall law is made for pressure-driven flow; what it does to shear-driven flow is an
/// error of order 2/(3 n^2).
#[test]
fn couette_slip_velocity() {
    for (n, tolerance) in [(3.0, 0.09), (6.0, 0.02), (12.0, 0.005)] {
        for slip in [0.1, 1.0] {
            let error = worst((0..4).map(|i| couette(n, 0.25 * f64::from(i), slip) - 1.0));
            println!(
                "Couette, {n} cells, influence length {slip}: slip velocity error {error:+.4} at worst"
            );
            assert!(error.abs() < tolerance, "{n} cells: {error}");
        }
    }
}

/// Mean pressure at depth y = 0.25 H over the middle half of a reservoir 4 H wide and 2 H deep
/// that a piston empties at unit speed into a slit of width H filled to `length` H, over
/// 12 eta V_s/H: Taylor-Hood elements (lib/studies/reference) give length + 0.343 (3.843 at 3.5 H).
fn slit_pressure(n: usize, length: f64, offset: f64) -> f64 {
    let h = n as f64;
    let (x0, top) = (1.0 + offset, 1.0 + 2.0 * h);
    let width = 4.0 * h;
    let end = top + length * h;
    let (a, b) = (x0 + 1.5 * h, x0 + 2.5 * h);
    let far = 999.0;
    let wood = vec![
        VoxelBlock::solid_box([-9.0, -9.0, 0.0], [x0, far, 1.0]),
        VoxelBlock::solid_box([x0 + width, -9.0, 0.0], [far, far, 1.0]),
        VoxelBlock::solid_box([x0, top, 0.0], [a, far, 1.0]),
        VoxelBlock::solid_box([b, top, 0.0], [x0 + width, far, 1.0]),
    ];
    let piston = vec![VoxelBlock::solid_box(
        [x0, -9.0, 0.0],
        [x0 + width, 1.0, 1.0],
    )];
    let cells = [width as usize + 3, end as usize + 4, 1];
    let mut flow = Flow::new(cells, 2, vec![wood, piston]);
    flow.speeds[1] = [0.0, 1.0, 0.0];
    let solved = flow.solve(|x| x[1] < end);
    let w = &solved.lattice.window;
    let (mut sum, mut count) = (0.0, 0);
    for index in 0..w.len() {
        let c = w.corner(w.coordinates(index));
        let centre = c[0] + 0.5;
        if c[1] == 1.0 + (0.25 * h).floor() && (centre - x0 - 2.0 * h).abs() < h {
            sum += solved.pressure[index];
            count += 1;
        }
    }
    // Slit velocity 4, in units 12 V_s/H per cell.
    sum / f64::from(count) / (12.0 * 4.0 / h)
}

#[test]
fn pressure_in_front_of_a_slit() {
    for (n, tolerance) in [(3, 0.02), (6, 0.01), (12, 0.01)] {
        for offset in [0.0, 0.25, 0.5] {
            let found = slit_pressure(n, 3.5, offset);
            println!(
                "slit of {n} cells, offset {offset}: pressure {found:.3}, finite elements 3.843"
            );
            assert!(
                (found / 3.843 - 1.0).abs() < tolerance,
                "{n} cells, offset {offset}: {found}"
            );
        }
    }
}
