//! What menisci pull: liquid at rest under them, the flow that they draw through a passage, and the forces
//! on its walls.

use physics::VoxelBlock;

use super::flow::{Flow, worst};

fn plate(low: [f64; 2], high: [f64; 2]) -> VoxelBlock {
    VoxelBlock::solid_box([low[0], low[1], -999.0], [high[0], high[1], 999.0])
}

/// Length over flux into a slit `n` cells wide, filled to `length` widths, from a reservoir 4 n wide with a
/// free surface; walls off by `offset` cells along y and the front along x. 1 in a slit alone.
fn slit(n: usize, offset: [f64; 2], length: f64) -> f64 {
    let w = n as f64;
    let (mouth, low) = (3.0 * w + 2.0, 1.5 * w + offset[0]);
    let wood = vec![
        plate([mouth, -999.0], [999.0, low]),
        plate([mouth, low + w], [999.0, 999.0]),
    ];
    let cells = [mouth as usize + (length * w) as usize + 4, 4 * n, 1];
    let mut flow = Flow::new(cells, 2, vec![wood]);
    flow.adhesion = 1.0;
    let front = mouth + length * w + offset[1];
    let solved = flow.solve(|x| x[0] > 2.0 && x[0] < front);
    // P = 2/H and a flux of P H^3/(12 L)
    w / (6.0 * solved.flux_through(mouth as usize + n))
}

/// By the resistance of two lengths: what entrance and front add is that of no slit.
#[test]
fn slits_draw_by_their_width() {
    for n in [3, 6] {
        for offset in [[0.0, 0.0], [0.25, 0.0], [0.5, 0.0], [0.0, 0.5]] {
            let [two, four] = [2.0, 4.0].map(|length| slit(n, offset, length));
            let (slope, entrance) = (0.5 * (four - two), 2.0 * two - four);
            println!(
                "slit of {n} cells, offset {offset:?}: resistance {slope:.5}, entrance and front {entrance:.3}"
            );
            assert!((slope - 1.0).abs() < 3e-3, "{n} cells, {offset:?}: {slope}");
        }
    }
}

/// A slug whose fronts cross the lattice askew, between plates of which one is a body of its own.
fn slug(offset: f64, wet: impl Fn([f64; 3]) -> bool) -> super::flow::Solved {
    let bodies = vec![
        vec![plate([-999.0, -999.0], [999.0, 2.0 + offset])],
        vec![plate([-999.0, 8.0 + offset], [999.0, 999.0])],
    ];
    let mut flow = Flow::new([40, 12, 1], 2, bodies);
    flow.adhesion = 1.0;
    flow.solve(wet)
}

#[test]
fn liquid_between_equal_menisci_is_at_rest_and_holds_the_plates() {
    for offset in [0.0, 0.3, 0.5] {
        let askew =
            |x: [f64; 3]| x[0] > 10.0 + 0.7 * (x[1] - 5.0) && x[0] < 30.0 - 0.4 * (x[1] - 5.0);
        let solved = slug(offset, askew);
        let flows = worst((12..28).map(|i| solved.flux_through(i)));
        let [bottom, top] = [0, 1].map(|body| solved.forces[body]);
        println!("offset {offset}: flux {flows:.1e}, forces {bottom:.4?} {top:.4?}");
        assert!(flows.abs() < 1e-5, "offset {offset}: {flows}");
        let pressure = solved.pressure.iter().copied().fold(0.0, f64::min);
        assert!((pressure * 6.0 / 2.0 + 1.0).abs() < 1e-5, "{pressure}");
        // The top is pulled down with 2/6 over its 16.5 wetted cells.
        assert!((top[1] * 3.0 + 16.5).abs() < 0.6, "{top:?}");
        assert!(
            (bottom[1] + top[1]).abs() < 1e-5 * top[1].abs(),
            "{bottom:?} {top:?}"
        );
        assert!(
            (bottom[0] + top[0]).abs() < 1e-5 * top[1].abs(),
            "{bottom:?} {top:?}"
        );
    }
}

/// A slug of which one end is between plates farther apart by a part of a thousandth: what it flows with is a
/// thousandth of what its menisci pull with, and as right as the solver's tolerance.
#[test]
fn a_slight_difference_of_menisci_moves_liquid_to_the_tolerance() {
    let flux = |tolerance: f64| {
        let wood = vec![
            plate([-999.0, -999.0], [999.0, 2.0]),
            plate([-999.0, 8.0], [100.0, 999.0]),
            plate([100.0, 8.006], [999.0, 999.0]),
        ];
        let mut flow = Flow::new([200, 12, 1], 2, vec![wood]);
        flow.adhesion = 1.0;
        flow.tolerance = tolerance;
        let solved = flow.solve(|x| x[0] > 10.0 && x[0] < 190.0);
        solved.flux_through(100)
    };
    let exact = 2.0 / 6.0 * 0.001 * 216.0 / (12.0 * 180.0);
    let (fine, usual) = (flux(1e-8), flux(1e-3));
    println!(
        "flux over {exact:.3e}: {:.4}; at the usual tolerance {:.4}",
        -fine / exact,
        -usual / exact
    );
    assert!((-fine / exact - 1.0).abs() < 0.02);
    assert!((usual / fine - 1.0).abs() < 5e-3);
}

#[test]
fn a_film_on_one_plate_feels_nothing_of_the_other() {
    let solved = slug(0.0, |x| x[1] < 5.0);
    assert!(solved.pressure.iter().all(|p| p.abs() < 1e-9));
    assert!(solved.forces.iter().flatten().all(|f| f.abs() < 1e-9));
}

/// Error of the pressure 2/r in a slug in a tube of six cells, of voxels of half a cell, whose axis is at `axis`
/// in a domain of `cells` cells across.
fn tube(axis: [f64; 2], cells: usize) -> f64 {
    let round = |j: usize, k: usize| {
        let at = |v: usize| 0.5 * (v as f64 + 0.5) - 8.0;
        at(j).hypot(at(k)) < 3.0
    };
    let low = axis.map(|a| a - 8.0);
    let edge = [2.0 * 999.0, 0.5, 0.5];
    let wood = VoxelBlock::from_fn([-999.0, low[0], low[1]], edge, [1, 32, 32], |_, j, k| {
        !round(j, k)
    });
    let mut flow = Flow::new([16, cells, cells], 3, vec![vec![wood]]);
    flow.adhesion = 1.0;
    let solved = flow.solve(|x| x[0] > 5.0 && x[0] < 11.0 + 0.3 * (x[1] - axis[0]));
    let wet = solved.pressure.iter().copied().filter(|p| *p != 0.0);
    worst(wet.map(|p| p * 3.0 / 2.0 + 1.0))
}

#[test]
fn tubes_pull_by_their_radius() {
    for (axis, cells) in [
        ([5.0, 5.0], 10),
        ([5.25, 5.1], 11),
        ([5.5, 5.5], 11),
        ([0.0, 0.0], 5),
    ] {
        let error = tube(axis, cells);
        println!("tube, axis at {axis:?}: pressure {error:+.4}");
        assert!(error.abs() < 0.02, "{axis:?}: {error}");
    }
}
