//! Agreement of a state with an experiment.

mod specimens;

use metrics::{Agreement, compare};
use particle_file::BitGrid;
use specimens::{Run, Stack, VOXEL, close};
use units::Axis;

/// Grooved wood below 30 and from 36; adhesive between and in the grooves, deeper where z is
/// larger, from `bottom` voxels deep at z = 0, and on the top side 5 deep.
fn experiment(bottom: usize) -> Stack {
    Stack::new([32, 66, 16], move |x, y, z| {
        let groove = x % 8 < 4;
        match y {
            30..36 => 'a',
            _ if !groove => 'w',
            0..30 if y + bottom + z / 2 >= 30 => 'a',
            36..41 => 'a',
            _ => ' ',
        }
    })
}

/// A run whose points are the adhesive voxels of `stack`, the top side moved by `gap`.
fn run_of(stack: &Stack, gap: f64) -> Run {
    let mut run = Run::new(stack, 33, gap);
    let lift = gap / VOXEL;
    let [nx, ny, nz] = stack.adhesive.dims();
    for z in 0..nz {
        for y in 0..ny {
            for x in 0..nx {
                if stack.adhesive.get(x, y, z) {
                    let mut place = [x, y, z].map(|i| i as f64 + 0.5);
                    place[1] += if y >= 33 { lift } else { 0.0 };
                    run.add(place);
                }
            }
        }
    }
    run
}

fn all_near_one(agreement: &[Agreement; 3]) -> bool {
    agreement.iter().all(|a| a.dice > 0.9999)
}

#[test]
fn a_state_that_is_the_experiment_agrees_fully_closed_or_parted() {
    let stack = experiment(6);
    let measured = stack.state(Axis::Y);
    let itself = compare(&measured, &measured).unwrap();
    assert!(
        itself
            .iter()
            .all(|a| a.dice == 1.0 && close(a.map_correlation, 1.0, 1e-12))
    );
    for gap in [0.0, 4.0 * VOXEL, 3.37 * VOXEL] {
        let run = run_of(&stack, gap);
        let found = compare(&run.state(), &measured).unwrap();
        println!("gap {:.2} voxels: {found:?}", gap / VOXEL);
        assert!(all_near_one(&found));
        assert!(found[0].map_correlation > 0.999);
    }
}

#[test]
fn dice_is_the_share_in_common() {
    // Two layers deeper in every groove on the bottom side: half of the columns.
    let (shallow, deep) = (experiment(6), experiment(8));
    let (a, b) = (
        shallow.adhesive.count() as f64,
        deep.adhesive.count() as f64,
    );
    assert_eq!(b - a, (2 * 16 * 16) as f64);
    let run = run_of(&shallow, 0.0);
    let found = compare(&run.state(), &deep.state(Axis::Y)).unwrap();
    assert!(close(found[2].dice, 2.0 * a / (a + b), 1e-9), "{found:?}");
    assert!(
        close(found[1].dice, 1.0, 1e-12),
        "the top sides are the same"
    );
    assert!(found[0].dice < found[2].dice);
    assert!(
        found[0].map_correlation > 0.99,
        "deeper everywhere, but alike"
    );
}

#[test]
fn a_map_the_other_way_round_correlates_negatively() {
    let stack = experiment(6);
    let [nx, ny, nz] = stack.adhesive.dims();
    let reversed = Stack {
        wood: stack.wood.clone(),
        adhesive: BitGrid::from_fn([nx, ny, nz], |x, y, z| stack.adhesive.get(x, y, nz - 1 - z)),
    };
    let run = run_of(&reversed, 0.0);
    let found = compare(&run.state(), &stack.state(Axis::Y)).unwrap();
    // Grooved columns are deeper than the rest in both maps; only the bottom's depth varies
    // along z.
    let same = compare(&run_of(&stack, 0.0).state(), &stack.state(Axis::Y)).unwrap();
    assert!(
        found[0].map_correlation < same[0].map_correlation - 0.05,
        "{found:?}"
    );
    assert!(found[0].dice < 0.95);
}

#[test]
fn a_trimmed_bond_is_compared_over_its_own_width() {
    let stack = experiment(6);
    let [_, ny, _] = stack.wood.dims();
    let narrow = |bits: &BitGrid| BitGrid::from_fn([30, ny, 14], |x, y, z| bits.get(x, y, z));
    let trimmed = Stack {
        wood: narrow(&stack.wood),
        adhesive: narrow(&stack.adhesive),
    };
    let run = run_of(&trimmed, 2.0 * VOXEL);
    let found = compare(&run.state(), &stack.state(Axis::Y)).unwrap();
    assert!(all_near_one(&found), "{found:?}");
}

#[test]
fn other_voxels_are_refused() {
    let stack = experiment(6);
    let other = Stack::new([30, 66, 16], |_, y, _| if y == 30 { 'a' } else { 'w' });
    let run = run_of(&stack, 0.0);
    let said = compare(&run.state(), &other.state(Axis::Y)).unwrap_err();
    assert!(
        said.is_usage() && said.to_string().contains("[30, 16]"),
        "{said}"
    );
    let cropped = Stack::new([32, 50, 16], |_, y, _| if y == 30 { 'a' } else { 'w' });
    let said = compare(&cropped.state(Axis::Y), &stack.state(Axis::Y)).unwrap_err();
    assert!(said.to_string().contains("50 layers"), "{said}");
    let said = compare(&stack.state(Axis::Y), &run.state()).unwrap_err();
    assert!(said.to_string().contains("no specimen"), "{said}");
}
