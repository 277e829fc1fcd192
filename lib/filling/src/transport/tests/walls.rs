//! Particles pass no wall, keep clear of it, and leave through open sides only.

use physics::VoxelBlock;

use super::*;
use crate::geometry::tests::solids;
use crate::liquid::tests::sequence;

fn shell(origin: [f64; 3]) -> VoxelBlock {
    let inside = |i: usize| (1..9).contains(&i);
    VoxelBlock::from_fn(origin, [0.5; 3], [10, 10, 10], |i, j, k| {
        !(inside(i) && inside(j) && inside(k))
    })
}

/// Whatever the velocities, what is in a closed lumen with walls of one voxel stays there, and
/// what is outside stays outside, also when the lumen moves.
#[test]
fn nothing_passes_a_wall_of_one_voxel() {
    let domain = Domain {
        cells: [14, 14, 14],
        boundary: SIDES,
        axes: 3,
    };
    let mut random = sequence(9);
    let mut deepest: f64 = 0.0;
    for step in 0..20 {
        let low = [4.0 + 0.05 * f64::from(step), 4.35, 4.7];
        let rest = solids(domain, vec![vec![shell(low)]]);
        let mut y = 0.0;
        let inside = |x: [f64; 3], y: f64| {
            (0..3).all(|a| {
                (low[a] + 0.5..low[a] + 4.5).contains(&(x[a] - if a == 1 { y } else { 0.0 }))
            })
        };
        let points = (0..2000)
            .map(|_| std::array::from_fn(|_| 14.0 * random()))
            .filter(|&x| rest.at(x).is_none())
            .collect();
        let mut particles = at(points, 0.1);
        let was: Vec<bool> = particles.position.iter().map(|&x| inside(x, y)).collect();
        assert!(was.iter().filter(|&&w| w).count() > 5);
        for _ in 0..15 {
            let by = 0.8 * (random() - 0.5);
            let before = rest.displaced(&[[0.0, y, 0.0]]);
            y += by;
            let after = rest.displaced(&[[0.0, y, 0.0]]);
            let v: [f64; 3] = std::array::from_fn(|_| 3.0 * (random() - 0.5));
            let path = Path {
                before: &before,
                after: &after,
                scale: 1.0,
            };
            let moved = path.follow(&mut particles, |x, _: &mut ()| {
                [v[0], v[1] + 0.1 * x[0], v[2]]
            });
            deepest = deepest.max(moved.deepest);
            assert_eq!(moved.pinched, 0);
            for (&x, &was) in particles.position.iter().zip(&was) {
                assert!(after.at(x).is_none() && inside(x, y) == was, "{x:?}");
            }
        }
    }
    println!("deepest deflected end {deepest:.2} cells behind its wall");
    assert!(deepest > 0.5, "the walls were never tried");
}

/// Flow at speed 1 against a wall `ahead` of the face at x = 4, and its speed at `x`.
fn against_a_wall(ahead: f64, x: f64) -> f64 {
    let domain = Domain {
        cells: [8, 4, 1],
        boundary: SIDES,
        axes: 2,
    };
    let wall = VoxelBlock::solid_box([4.0 + ahead, 0.0, 0.0], [8.0, 4.0, 1.0]);
    let l = lattice(domain, vec![vec![wall]]);
    let w = &l.window;
    let known = |i: usize| l.face(0, i) == OPEN && w.face_centre(0, w.coordinates(i))[0] < 4.5;
    let active: [Vec<u32>; 3] = std::array::from_fn(|axis| {
        let of = |i: usize| if axis == 0 && known(i) { 0 } else { NONE };
        (0..w.len()).map(of).collect()
    });
    let value = std::array::from_fn(|axis| {
        let of = |&dof: &u32| if dof == NONE { f32::NAN } else { 1.0 };
        active[axis].iter().map(of).collect()
    });
    Flow::new(&l, &value, &active, &[[0.0; 3]], 0.0)
        .velocity([x, 1.5, 0.5], &mut Default::default())[0]
}

/// Less than half a cell before a wall, a face is on the line from the one behind to the wall; the
/// slope ahead of it is that over three tenths of a cell at most.
#[test]
fn a_velocity_falls_to_the_wall_ahead() {
    let near = |found: f64, wanted: f64| assert!((found - wanted).abs() < 1e-6, "{found}");
    near(against_a_wall(0.55, 4.0), 1.0);
    near(against_a_wall(0.45, 4.0), 0.45 / 1.45);
    near(against_a_wall(0.45, 4.225), 0.5 * 0.45 / 1.45);
    near(against_a_wall(0.1, 4.05), 0.1 / 1.1 * (1.0 - 0.05 / 0.3));
}

/// A particle that a wall turns back is left a fiftieth of a cell before it.
#[test]
fn a_deflected_particle_keeps_clear_of_the_wall() {
    let domain = Domain {
        cells: [8, 8, 1],
        boundary: SIDES,
        axes: 2,
    };
    let rest = solids(
        domain,
        vec![vec![VoxelBlock::solid_box(
            [5.0, 0.0, 0.0],
            [6.0, 8.0, 1.0],
        )]],
    );
    let path = Path {
        before: &rest,
        after: &rest,
        scale: 1.0,
    };
    let mut particles = at(vec![[4.8, 4.0, 0.5]], 0.25);
    let moved = path.follow(&mut particles, |_, _: &mut ()| [0.4, 0.1, 0.0]);
    let x = particles.position[0];
    assert_eq!(moved.deflected, 1);
    assert!(
        (x[0] - 4.98).abs() < 1e-3 && (x[1] - 4.1).abs() < 1e-9,
        "{x:?}"
    );
}

/// Bodies and liquid at one velocity: every particle moves by it exactly, wherever the walls are.
#[test]
fn a_common_velocity_only_translates() {
    let domain = Domain {
        cells: [12, 16, 1],
        boundary: [Boundary::Periodic, Boundary::Open, Boundary::Symmetry],
        axes: 2,
    };
    for off in [0.0, 0.2, 0.5, 0.85] {
        let floor = VoxelBlock::solid_box([0.0, 2.0 + off, 0.0], [12.0, 4.0 + off, 1.0]);
        let post = VoxelBlock::solid_box([5.3, 4.0 + off, 0.0], [6.9, 8.0, 1.0]);
        let rest = solids(domain, vec![vec![floor, post]]);
        let v = [0.4, -0.3, 0.0];
        let after = rest.displaced(&[v]);
        let middle = rest.displaced(&[v.map(|x| 0.5 * x)]);
        let l = whole(middle);
        let mut active: [Vec<u32>; 3] = std::array::from_fn(|_| vec![NONE; l.window.len()]);
        for (axis, active) in active.iter_mut().enumerate().take(2) {
            for (index, dof) in active.iter_mut().enumerate() {
                if l.face(axis, index) == OPEN {
                    *dof = axis as u32;
                }
            }
        }
        let value = extend(&l, &active, &[0.4, -0.3]);
        let flow = Flow::new(&l, &value, &active, &[v], 0.0);
        let mut random = sequence(4);
        let points: Vec<[f64; 3]> = (0..500)
            .map(|_| [12.0 * random(), 4.0 + 8.0 * random(), 0.5])
            .filter(|&x| rest.at(x).is_none())
            .collect();
        let mut particles = at(points.clone(), 0.1);
        let path = Path {
            before: &rest,
            after: &after,
            scale: 1.0,
        };
        path.follow(&mut particles, |x, near| flow.velocity(x, near));
        let mut worst: f64 = 0.0;
        for (x, y) in particles.position.iter().zip(&points) {
            worst = worst.max(((x[0] - y[0] + 6.0).rem_euclid(12.0) - 6.0 - 0.4).abs());
            worst = worst.max((x[1] - y[1] + 0.3).abs());
        }
        println!("offset {off}: translation error {worst:.1e}");
        assert!(worst < 1e-6, "{worst}");
    }
}

/// Particles cross less than two faces in a step and need one more beyond.
#[test]
fn three_layers_of_air_get_a_velocity() {
    let domain = Domain {
        cells: [12, 4, 1],
        boundary: SIDES,
        axes: 2,
    };
    let l = lattice(domain, vec![]);
    let w = &l.window;
    let solved = |index: usize| w.face_centre(0, w.coordinates(index))[0] < 4.5;
    let active = std::array::from_fn(|_| {
        (0..w.len())
            .map(|i| if solved(i) { 0 } else { NONE })
            .collect()
    });
    let value = extend(&l, &active, &[2.0]);
    let at = |x: f64| value[0][w.index(w.local([x, 1.5, 0.5]).map(|x| x as usize))];
    assert_eq!([4.0, 5.0, 6.0, 7.0].map(at), [2.0; 4]);
    assert!(at(8.0).is_nan());
}

#[test]
fn particles_leave_through_open_sides_only() {
    let domain = Domain {
        cells: [4, 4, 4],
        boundary: [Boundary::Open, Boundary::Periodic, Boundary::Symmetry],
        axes: 3,
    };
    let rest = solids(domain, vec![]);
    let mut particles = at(vec![[3.9, 2.0, 2.0], [2.0, 3.9, 2.0], [2.0, 2.0, 3.9]], 0.1);
    let path = Path {
        before: &rest,
        after: &rest,
        scale: 1.0,
    };
    let moved = path.follow(&mut particles, |_, _: &mut ()| [0.2; 3]);
    assert_eq!((moved.lost, particles.len()), (1, 2));
    assert!((particles.position[0][1] - 0.1).abs() < 1e-12);
    let short = 4.0 - particles.position[1][2];
    assert!((short / 1e-6 - 1.0).abs() < 1e-3, "{short:e}");
}
