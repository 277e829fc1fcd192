//! Bonds of undamaged wood: what is written, refused and said.

use particle_file::{BitGrid, Kind, ParticleFile};

use crate::workbench::Bench;
use crate::{VOXEL, header, number, open};

/// A folder with a grooved piece of wood, `a.mpts`, and others that differ from it.
fn bench() -> Bench {
    let bench = crate::bench();
    let dims = [24, 40, 16];
    let wood = BitGrid::from_fn(dims, |x, y, _| x % 4 != 1 || y == 0);
    let none = BitGrid::new(dims);
    let mut across_x = header(dims);
    across_x.normal = 0;
    bench.write_specimen("a.mpts", header(dims), &wood, &none);
    bench.write_specimen("x.mpts", across_x, &wood, &none);
    bench
}

#[test]
fn one_piece_cut_and_two_pieces_are_bonds() {
    let bench = bench();
    let said = bench
        .run("a.mpts --plane 29um --slab 11.6um -o cut.mpts")
        .done()
        .said;
    assert!(said.contains("bottom face"), "{said}");
    assert!(said.contains("asked for 11.6000 um"), "{said}");
    let cut = open(&bench, "cut.mpts");
    assert_eq!(cut.header().kind, Kind::Bond);
    assert_eq!(number(&cut, "slab_cells"), 4.0);
    assert!((number(&cut, "bond_plane_m") - 20.0 * VOXEL).abs() < 1e-12);
    assert!((number(&cut, "gap_m") - 8.0 * VOXEL).abs() < 1e-12);

    // 13.92 g/m2 of 1.2 g/cm3 are 11.6 um.
    let line = "--bottom a.mpts --top a.mpts --spread 13.92g/m2 --density 1.2g/cm3 -o two.mpts";
    bench.run(line).done();
    let two = open(&bench, "two.mpts");
    assert_eq!(number(&two, "slab_cells"), 4.0);
    assert!((number(&two, "effective_penetration_m") - 11.6e-6).abs() < 1e-12);
    // The low side of the top piece is a closed sheet, level with the bottom's grooves' rims.
    assert_eq!(two.block_named("wood-top").unwrap().0.dims, [24, 40, 16]);
    let inputs = &two.header().provenance.last().unwrap().inputs;
    assert!(inputs.iter().map(|(name, _)| name).eq(["a.mpts", "a.mpts"]));

    let line = "cat a.mpts | $TOOL --bottom a.mpts --top - --slab 11.6um -o -";
    let piped = ParticleFile::from_bytes(&bench.shell(line).done().stdout).unwrap();
    assert_eq!(piped.sum().unwrap(), two.sum().unwrap());
}

/// Arguments, exit status and part of the sentence, as in `tests/pipeline/refusals.txt`.
const REFUSALS: &str = "
a.mpts --slab 0um --plane 29um | 2 | greater than zero
a.mpts --slab 11.6 --plane 29um | 2 | has no unit
a.mpts --slab 29um --plane 29um | 2 | could never close
a.mpts --spread 14g/m2 --plane 29um | 2 | --density
a.mpts --spread 14g/cm3 --density 1.2g/cm3 --plane 29um | 2 | unit of a spread rate
a.mpts --slab 11.6um --spread 14g/m2 --density 1.2g/cm3 --plane 29um | 2 | cannot be used with
a.mpts --turn-top 90 | 2 | for undamaged wood
a.mpts --plane 29um --slab 11.6um --turn-top 90 | 2 | --crop-to-fit
a.mpts --plane 29um --slab 11.6um --turn-top 45 | 2 | 0, 90, 180, 270
--bottom a.mpts --top a.mpts | 2 | two pieces of wood have no adhesive
--bottom a.mpts --slab 11.6um | 2 | --top
--bottom a.mpts --top a.mpts --slab 11.6um --plane 29um | 2 | --plane cuts one piece
a.mpts --bottom a.mpts --top a.mpts --slab 11.6um | 2 | cannot be used with
--bottom - --top - --slab 11.6um | 2 | only one piece
--bottom a.mpts --top x.mpts --slab 11.6um | 2 | not the same axis
";

#[test]
fn refusals_are_a_sentence_and_leave_no_file() {
    let bench = bench();
    for line in REFUSALS.trim().lines() {
        let [arguments, status, sentence] = line.split(" | ").collect::<Vec<_>>()[..] else {
            panic!("{line}");
        };
        let run = bench.run(&format!("{arguments} -o bond.mpts"));
        run.refused(status.parse().unwrap(), sentence);
        assert!(!bench.path("bond.mpts").exists(), "{arguments}");
    }
}
