//! Proposed thresholds do not follow hot and dark pixels, padding, rings or the number type.

mod common;

use common::stored;
use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;
use voxels::{Crop, Histogram, Phases, RawType, Stack, segment};

const DIMS: [usize; 3] = [40, 40, 12];

/// Grey values of a specimen and the phase of each voxel: void, wood and adhesive with means of 10,
/// 22 and 34 and a deviation of 1.5.
struct Specimen {
    phases: Vec<usize>,
    grey: Vec<f64>,
    random: ChaCha8Rng,
}

impl Specimen {
    fn new(adhesive: f64) -> Self {
        let mut random = ChaCha8Rng::seed_from_u64(39);
        let voxels = DIMS.iter().product();
        let phases: Vec<usize> = (0..voxels)
            .map(|_| match random.random::<f64>() {
                share if share < adhesive => 2,
                share => usize::from(share < 0.6),
            })
            .collect();
        let mut bell = || {
            let u: [f64; 2] = [1.0 - random.random::<f64>(), random.random()];
            (-2.0 * u[0].ln()).sqrt() * (std::f64::consts::TAU * u[1]).cos()
        };
        let grey = phases
            .iter()
            .map(|&phase| 10.0 + 12.0 * phase as f64 + 1.5 * bell());
        Self {
            grey: grey.collect(),
            phases,
            random,
        }
    }

    /// Sets so many voxels to a value.
    fn spoiled(mut self, voxels: usize, value: f64) -> Self {
        for _ in 0..voxels {
            let at = self.random.random_range(0..self.grey.len());
            self.grey[at] = value;
            // Whatever it becomes is right.
            self.phases[at] = 3;
        }
        self
    }

    /// Sets all outside the largest circle of each page to a value, which is void.
    fn in_circle(mut self, value: f64) -> Self {
        let [nx, ny, _] = DIMS;
        for i in 0..self.grey.len() {
            let [x, y] = [i % nx, i / nx % ny].map(|n| n as f64 - 19.5);
            if x.hypot(y) > 20.0 {
                (self.grey[i], self.phases[i]) = (value, 0);
            }
        }
        self
    }

    fn with_rings(mut self) -> Self {
        let [nx, ny, _] = DIMS;
        for i in 0..self.grey.len() {
            let [x, y] = [i % nx, i / nx % ny].map(|n| n as f64 - 19.5);
            self.grey[i] += 2.5 * (1.7 * x.hypot(y)).sin();
        }
        self
    }

    /// The stack as numbers of a type, each grey value through `scale`.
    fn stored<const N: usize>(&self, kind: &str, bytes: impl Fn(f64) -> [u8; N]) -> Stored {
        let data: Vec<u8> = self.grey.iter().flat_map(|&v| bytes(v)).collect();
        let (folder, path) = stored("a.raw", &data);
        let kind: RawType = kind.parse().unwrap();
        let dims = "40x40x12".parse().unwrap();
        let stack = Stack::open_raw(&path, dims, kind).unwrap();
        Stored {
            stack,
            _folder: folder,
        }
    }

    /// Share of the voxels that thresholds proposed for the stack give another phase.
    fn wrong(&self, stored: &Stored) -> f64 {
        let grey = stored.histogram().otsu().unwrap().grey;
        let whole = Crop::whole(DIMS);
        let found = segment(&stored.stack, &Phases::Grey(grey), &whole, || {}).unwrap();
        let [nx, ny, _] = DIMS;
        let wrong = (self.phases.iter().enumerate()).filter(|&(i, &phase)| {
            let (x, y, z) = (i % nx, i / nx % ny, i / nx / ny);
            let is =
                usize::from(found.wood.get(x, y, z)) + 2 * usize::from(found.adhesive.get(x, y, z));
            phase < 3 && is != phase
        });
        wrong.count() as f64 / self.phases.len() as f64
    }
}

struct Stored {
    stack: Stack,
    _folder: tempfile::TempDir,
}

impl Stored {
    fn histogram(&self) -> Histogram {
        Histogram::of(&self.stack, &Crop::whole(DIMS)).unwrap()
    }

    fn left_out(&self) -> String {
        self.histogram().otsu().unwrap().left_out.join("; ")
    }
}

fn as_u16(grey: f64) -> [u8; 2] {
    ((1000.0 * grey).round().clamp(0.0, 65535.0) as u16).to_le_bytes()
}

/// Greys of a narrow part of their type.
fn as_narrow_u16(grey: f64) -> [u8; 2] {
    ((40_000.0 + 6.0 * grey).round().clamp(0.0, 65535.0) as u16).to_le_bytes()
}

fn as_f32(grey: f64) -> [u8; 4] {
    ((0.002 * (grey - 12.0)) as f32).to_le_bytes()
}

#[test]
fn grey_values_of_every_number_type() {
    let clean = Specimen::new(0.12);
    let check = |kind: &str, stored: Stored| {
        let wrong = clean.wrong(&stored);
        assert!(wrong < 5e-4, "{kind}: {wrong}");
        assert_eq!(stored.left_out(), "", "{kind}");
    };
    check("u8", clean.stored("u8", |v| [(5.0 * v) as u8]));
    check(
        "i8",
        clean.stored("i8", |v| ((5.0 * v - 110.0) as i8).to_le_bytes()),
    );
    check("u16", clean.stored("u16", as_u16));
    check("narrow u16", clean.stored("u16", as_narrow_u16));
    check(
        "i16",
        clean.stored("i16", |v| ((900.0 * v - 20_000.0) as i16).to_le_bytes()),
    );
    check(
        "u16be",
        clean.stored("u16be", |v| ((1000.0 * v) as u16).to_be_bytes()),
    );
    check(
        "u32",
        clean.stored("u32", |v| ((1e8 * v) as u32).to_le_bytes()),
    );
    check(
        "i32",
        clean.stored("i32", |v| ((30.0 * v - 700.0) as i32).to_le_bytes()),
    );
    check(
        "u64",
        clean.stored("u64", |v| ((1e15 * v) as u64).to_le_bytes()),
    );
    check("f32", clean.stored("f32", as_f32));
    check(
        "f64",
        clean.stored("f64", |v| (1e-12 * v - 3e-12).to_le_bytes()),
    );
}

#[test]
fn hot_and_dark_pixels_do_not_decide() {
    for (hot, dark) in [
        (1, 0),
        (0, 1),
        (1, 1),
        (40, 0),
        (0, 40),
        (150, 150),
        (380, 0),
    ] {
        let specimen = (Specimen::new(0.12).spoiled(hot, 1e6)).spoiled(dark, -1e6);
        let check = |kind: &str, stored: Stored| {
            let wrong = specimen.wrong(&stored);
            assert!(wrong < 1e-3, "{kind}, {hot} and {dark}: {wrong}");
        };
        check("u16", specimen.stored("u16", as_u16));
        check("narrow u16", specimen.stored("u16", as_narrow_u16));
        check("u8", specimen.stored("u8", |v| [(5.0 * v) as u8]));
        check(
            "i32",
            specimen.stored("i32", |v| ((1e3 * v) as i32).to_le_bytes()),
        );
        check("f32", specimen.stored("f32", as_f32));
        let said = specimen.stored("u16", as_narrow_u16).left_out();
        assert!(
            said.contains("hot or dark voxels") && said.contains("--despeckle"),
            "{said}"
        );
    }
    // Of many values, within the phases too.
    let mut specimen = Specimen::new(0.12);
    for value in 0..60 {
        specimen = specimen.spoiled(3, f64::from(value));
    }
    assert!(specimen.wrong(&specimen.stored("u16", as_u16)) < 1e-3);
}

#[test]
fn padding_around_a_round_field_of_view_is_void() {
    for value in [0.0, 65.535, 12.0, -7.0] {
        let specimen = Specimen::new(0.12).in_circle(value).spoiled(20, 60.0);
        for (kind, stored) in [
            ("u16", specimen.stored("u16", as_u16)),
            ("narrow u16", specimen.stored("u16", as_narrow_u16)),
            ("f32", specimen.stored("f32", as_f32)),
        ] {
            let wrong = specimen.wrong(&stored);
            assert!(wrong < 1e-3, "{kind}, {value}: {wrong}");
            let said = stored.left_out();
            assert!(
                said.contains("become void; --crop"),
                "{kind}, {value}: {said}"
            );
        }
    }
    // What is no number is refused by its voxel.
    let specimen = Specimen::new(0.12).in_circle(f64::NAN);
    let stored = specimen.stored("f32", as_f32);
    let grey = Phases::Grey(stored.histogram().otsu().unwrap().grey);
    let said = segment(&stored.stack, &grey, &Crop::whole(DIMS), || {})
        .unwrap_err()
        .to_string();
    assert!(
        said.contains("holds NaN") && said.contains("--crop"),
        "{said}"
    );
    let inside: Crop = "8:32,8:32,0:12".parse().unwrap();
    assert!(segment(&stored.stack, &grey, &inside, || {}).is_ok());
}

#[test]
fn rings_move_thresholds_little() {
    let specimen = Specimen::new(0.12).with_rings();
    let wrong = specimen.wrong(&specimen.stored("u16", as_u16));
    assert!(wrong < 0.02, "{wrong}");
}

/// Wood alone has no third phase, even where hot pixels make one.
#[test]
fn phases_that_are_not_there_are_not_proposed() {
    for hot in [0, 1, 100, 300] {
        let bare = Specimen::new(0.0).spoiled(hot, 65.0);
        let stored = bare.stored("u16", as_u16);
        let said = stored.histogram().otsu().unwrap_err();
        assert!(said.contains("auto-wood"), "{hot}: {said}");
        let wood = stored.histogram().otsu_of_wood().unwrap().grey;
        let voids = [10.0, 14.0].map(|v| wood.phase(1000.0 * v).unwrap() as usize);
        let woods = [18.0, 22.0].map(|v| wood.phase(1000.0 * v).unwrap() as usize);
        assert_eq!((voids, woods), ([0, 0], [1, 1]), "{hot}: {wood}");
    }
}

/// Without noise void is one value, and may be at all corners: it is a phase where nothing else is.
#[test]
fn void_at_all_corners_stays_a_phase() {
    for inside in [0.0, 20.0] {
        let mut specimen = Specimen::new(0.12).in_circle(-1.0);
        for (grey, phase) in specimen.grey.iter_mut().zip(&mut specimen.phases) {
            let around = *grey == -1.0;
            *phase = if *phase == 0 && !around && inside > 0.0 {
                1
            } else {
                *phase
            };
            *grey = [0.0, 20.0, 40.0][*phase];
        }
        let stored = specimen.stored("u8", |v| [v as u8]);
        assert_eq!(specimen.wrong(&stored), 0.0, "{inside}");
    }
}
