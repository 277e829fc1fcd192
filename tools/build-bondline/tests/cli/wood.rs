//! Bonds of undamaged wood: what is written, refused and said.

use std::fs::{self, File};
use std::path::{Path, PathBuf};
use std::process::Stdio;

use particle_file::{BitGrid, Header, Kind, ParticleFile};
use tempfile::TempDir;

use crate::{VOXEL, said, tool};

/// A grooved piece of wood alone, or with a voxel of adhesive.
struct Piece {
    dims: [usize; 3],
    voxel_m: f64,
    normal: u8,
    adhesive: bool,
}

const PIECE: Piece = Piece {
    dims: [24, 40, 16],
    voxel_m: VOXEL,
    normal: 1,
    adhesive: false,
};

impl Piece {
    fn write(&self, folder: &Path, name: &str) -> PathBuf {
        let wood = BitGrid::from_fn(self.dims, |x, y, _| x % 4 != 1 || y == 0);
        let adhesive = BitGrid::from_fn(self.dims, |x, y, z| {
            self.adhesive && (x, y, z) == (1, 20, 3)
        });
        let max = self.dims.map(|n| n as f64 * self.voxel_m);
        let header = Header::new(Kind::Specimen, self.voxel_m, self.normal, [0.0; 3], max);
        crate::write(folder, name, header, &wood, &adhesive)
    }
}

fn number(file: &ParticleFile, name: &str) -> f64 {
    file.header().attribute(name).unwrap().parse().unwrap()
}

#[test]
fn one_piece_cut_and_two_pieces_are_bonds() {
    let folder = TempDir::new().unwrap();
    PIECE.write(folder.path(), "a.mpts");
    PIECE.write(folder.path(), "b.mpts");
    let run = tool(
        folder.path(),
        Stdio::null(),
        "a.mpts --plane 29um --slab 11.6um -o cut.mpts",
    );
    assert!(run.status.success(), "{}", said(&run));
    assert!(said(&run).contains("bottom face"), "{}", said(&run));
    assert!(
        said(&run).contains("asked for 11.6000 um"),
        "{}",
        said(&run)
    );
    let cut = ParticleFile::open(folder.path().join("cut.mpts")).unwrap();
    assert_eq!(cut.header().kind, Kind::Bond);
    assert_eq!(number(&cut, "slab_cells"), 4.0);
    assert!((number(&cut, "bond_plane_m") - 20.0 * VOXEL).abs() < 1e-12);
    assert!((number(&cut, "gap_m") - 8.0 * VOXEL).abs() < 1e-12);

    // 13.92 g/m2 of 1.2 g/cm3 are 11.6 um.
    let run = tool(
        folder.path(),
        Stdio::null(),
        "--bottom a.mpts --top b.mpts --spread 13.92g/m2 --density 1.2g/cm3 -o two.mpts",
    );
    assert!(run.status.success(), "{}", said(&run));
    let two = ParticleFile::open(folder.path().join("two.mpts")).unwrap();
    assert_eq!(number(&two, "slab_cells"), 4.0);
    assert!((number(&two, "effective_penetration_m") - 11.6e-6).abs() < 1e-12);
    // The low side of the top piece is a closed sheet, level with the bottom's grooves' rims.
    assert_eq!(two.block_named("wood-top").unwrap().0.dims, [24, 40, 16]);
    let inputs = &two.header().provenance.last().unwrap().inputs;
    assert_eq!(inputs[0].0, "a.mpts");
    assert_eq!(inputs[1].0, "b.mpts");
}

#[test]
fn one_piece_may_come_from_a_pipe() {
    let folder = TempDir::new().unwrap();
    let path = PIECE.write(folder.path(), "a.mpts");
    let line = "--bottom a.mpts --top a.mpts --slab 11.6um -o -";
    let direct = tool(folder.path(), Stdio::null(), line);
    assert!(direct.status.success(), "{}", said(&direct));
    let line = line.replace("--top a.mpts", "--top -");
    let piped = tool(folder.path(), File::open(path).unwrap(), &line);
    assert!(piped.status.success(), "{}", said(&piped));
    let voxels = |bytes: &[u8], name: &str| {
        let path = folder.path().join(name);
        fs::write(&path, bytes).unwrap();
        let file = ParticleFile::open(&path).unwrap();
        file.block_named("wood-top").unwrap().1.words().to_vec()
    };
    assert_eq!(
        voxels(&direct.stdout, "direct.mpts"),
        voxels(&piped.stdout, "piped.mpts")
    );
}

#[test]
fn refusals_are_a_sentence_and_leave_no_file() {
    let folder = TempDir::new().unwrap();
    let write = |piece: Piece, name: &str| piece.write(folder.path(), name);
    write(PIECE, "a.mpts");
    write(
        Piece {
            voxel_m: 1.5e-6,
            ..PIECE
        },
        "coarse.mpts",
    );
    write(Piece { normal: 0, ..PIECE }, "x.mpts");
    write(
        Piece {
            adhesive: true,
            ..PIECE
        },
        "bonded.mpts",
    );
    fs::write(folder.path().join("empty.mpts"), "").unwrap();
    for (line, status, sentence) in [
        ("a.mpts", 3, "--slab or --spread"),
        ("a.mpts --slab 11.6um", 2, "say where to cut it by --plane"),
        (
            "a.mpts --slab 11.6um --plane 0um",
            2,
            "outside the specimen",
        ),
        (
            "a.mpts --slab 11.6um --plane 58um",
            2,
            "outside the specimen",
        ),
        ("a.mpts --slab 0um --plane 29um", 2, "greater than zero"),
        ("a.mpts --slab -1um --plane 29um", 2, "greater than zero"),
        ("a.mpts --slab 11.6 --plane 29um", 2, "has no unit"),
        ("a.mpts --slab 0.1um --plane 29um", 2, "rounded to 0"),
        ("a.mpts --slab 1m --plane 29um", 2, "could never close"),
        ("a.mpts --slab 29um --plane 29um", 2, "could never close"),
        ("a.mpts --slab 11.6um --plane 29um --gap 5um", 2, "no room"),
        ("a.mpts --spread 14g/m2 --plane 29um", 2, "--density"),
        (
            "a.mpts --spread 14g/cm3 --density 1.2g/cm3 --plane 29um",
            2,
            "unit of a spread rate",
        ),
        (
            "a.mpts --slab 11.6um --spread 14g/m2 --density 1.2g/cm3 --plane 29um",
            2,
            "cannot be used with",
        ),
        ("a.mpts --turn-top 90", 2, "for undamaged wood"),
        (
            "a.mpts --plane 29um --slab 11.6um --turn-top 90",
            2,
            "--crop-to-fit",
        ),
        (
            "a.mpts --plane 29um --slab 11.6um --turn-top 45",
            2,
            "0, 90, 180, 270",
        ),
        (
            "bonded.mpts --plane 29um --slab 11.6um",
            2,
            "holds adhesive",
        ),
        ("--bottom a.mpts --top a.mpts", 2, "hold no adhesive"),
        ("--bottom a.mpts --slab 11.6um", 2, "--top"),
        (
            "--bottom a.mpts --top a.mpts --slab 11.6um --plane 29um",
            2,
            "--plane cuts one piece",
        ),
        (
            "a.mpts --bottom a.mpts --top a.mpts --slab 11.6um",
            2,
            "cannot be used with",
        ),
        ("--bottom - --top - --slab 11.6um", 2, "both pieces"),
        (
            "--bottom a.mpts --top x.mpts --slab 11.6um",
            2,
            "not the same axis",
        ),
        (
            "--bottom a.mpts --top coarse.mpts --slab 11.6um",
            2,
            "scale one stack",
        ),
        (
            "--bottom a.mpts --top bonded.mpts --slab 11.6um",
            2,
            "holds adhesive",
        ),
        ("--bottom a.mpts --top empty.mpts --slab 11.6um", 3, "empty"),
    ] {
        let run = tool(
            folder.path(),
            Stdio::null(),
            &format!("{line} -o bond.mpts"),
        );
        assert_eq!(run.status.code(), Some(status), "{line}: {}", said(&run));
        assert!(said(&run).contains(sentence), "{line}: {}", said(&run));
        assert!(!folder.path().join("bond.mpts").exists(), "{line}");
    }
}
