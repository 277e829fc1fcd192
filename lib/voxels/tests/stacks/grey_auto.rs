//! Proposed thresholds do not follow hot and dark pixels, padding, rings or the number type.

use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;
use tempfile::TempDir;
use voxels::{Crop, Histogram, Phases, Stack, segment};

use crate::check::{assert_has, assert_says, stored};

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
        let phase = |_| match random.random::<f64>() {
            share if share < adhesive => 2,
            share => usize::from(share < 0.6),
        };
        let phases: Vec<usize> = (0..DIMS.iter().product()).map(phase).collect();
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
            // Whatever it becomes is right.
            (self.grey[at], self.phases[at]) = (value, 3);
        }
        self
    }

    /// Sets all outside the largest circle of each page to a value, which is void.
    fn in_circle(mut self, value: f64) -> Self {
        for i in 0..self.grey.len() {
            if from_middle(i) > 20.0 {
                (self.grey[i], self.phases[i]) = (value, 0);
            }
        }
        self
    }

    /// The stack as numbers of a type.
    fn stored(&self, kind: Kind) -> Stored {
        let data: Vec<u8> = self.grey.iter().flat_map(|&v| (kind.1)(v)).collect();
        let (folder, path) = stored("a.raw", &data);
        let dims = "40x40x12".parse().unwrap();
        Stored {
            stack: Stack::open_raw(&path, dims, kind.0.parse().unwrap()).unwrap(),
            _folder: folder,
        }
    }

    /// Share of the voxels that thresholds proposed for the stack give another phase.
    fn wrong(&self, stored: &Stored) -> f64 {
        let grey = stored.histogram().propose(false).unwrap().grey;
        let whole = Crop::whole(DIMS);
        let found = segment(&stored.stack, &Phases::Grey(grey), &whole, || {}).unwrap();
        let [nx, ny, _] = DIMS;
        let wrong = (self.phases.iter().enumerate()).filter(|&(i, &phase)| {
            let (x, y, z) = (i % nx, i / nx % ny, i / nx / ny);
            let [wood, adhesive] = [&found.wood, &found.adhesive].map(|grid| grid.get(x, y, z));
            phase < 3 && phase != usize::from(wood) + 2 * usize::from(adhesive)
        });
        wrong.count() as f64 / self.phases.len() as f64
    }
}

/// Distance of voxel `i` from the middle of its page.
fn from_middle(i: usize) -> f64 {
    let [x, y] = [i % DIMS[0], i / DIMS[0] % DIMS[1]].map(|n| n as f64 - 19.5);
    x.hypot(y)
}

struct Stored {
    stack: Stack,
    _folder: TempDir,
}

impl Stored {
    fn histogram(&self) -> Histogram {
        Histogram::of(&self.stack, &Crop::whole(DIMS)).unwrap()
    }

    fn left_out(&self) -> String {
        self.histogram().propose(false).unwrap().left_out.join("; ")
    }
}

/// A number type and the bytes of a grey value.
type Kind = (&'static str, fn(f64) -> Vec<u8>);

const U8: Kind = ("u8", |v| vec![(5.0 * v) as u8]);
const U16: Kind = ("u16", |v| {
    ((1000.0 * v).round() as u16).to_le_bytes().into()
});
/// Greys of a narrow part of their type.
const NARROW: Kind = ("u16", |v| {
    ((40_000.0 + 6.0 * v).round() as u16).to_le_bytes().into()
});
const I32: Kind = ("i32", |v| ((1e3 * v) as i32).to_le_bytes().into());
const F32: Kind = ("f32", |v| {
    ((0.002 * (v - 12.0)) as f32).to_le_bytes().into()
});

#[test]
fn grey_values_of_every_number_type() {
    let clean = Specimen::new(0.12);
    let others: [Kind; 7] = [
        ("i8", |v| vec![(5.0 * v - 110.0) as i8 as u8]),
        ("i16", |v| {
            ((900.0 * v - 20_000.0) as i16).to_le_bytes().into()
        }),
        ("u16be", |v| ((1000.0 * v) as u16).to_be_bytes().into()),
        ("u32", |v| ((1e8 * v) as u32).to_le_bytes().into()),
        ("i32", |v| ((30.0 * v - 700.0) as i32).to_le_bytes().into()),
        ("u64", |v| ((1e15 * v) as u64).to_le_bytes().into()),
        ("f64", |v| (1e-12 * v - 3e-12).to_le_bytes().into()),
    ];
    for kind in [U8, U16, NARROW, F32].into_iter().chain(others) {
        let stored = clean.stored(kind);
        let wrong = clean.wrong(&stored);
        assert!(wrong < 5e-4, "{}: {wrong}", kind.0);
        assert_eq!(stored.left_out(), "", "{}", kind.0);
    }
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
        for kind in [U16, NARROW, U8, I32, F32] {
            let wrong = specimen.wrong(&specimen.stored(kind));
            assert!(wrong < 1e-3, "{}, {hot} and {dark}: {wrong}", kind.0);
        }
        let said = specimen.stored(NARROW).left_out();
        assert_has(&said, &["hot or dark voxels", "--despeckle"]);
    }
    // Of many values, within the phases too.
    let many = (0..60).fold(Specimen::new(0.12), |specimen, value| {
        specimen.spoiled(3, f64::from(value))
    });
    assert!(many.wrong(&many.stored(U16)) < 1e-3);
}

#[test]
fn padding_around_a_round_field_of_view_is_void() {
    for value in [0.0, 65.535, 12.0, -7.0] {
        let specimen = Specimen::new(0.12).in_circle(value).spoiled(20, 60.0);
        for kind in [U16, NARROW, F32] {
            let stored = specimen.stored(kind);
            let wrong = specimen.wrong(&stored);
            assert!(wrong < 1e-3, "{}, {value}: {wrong}", kind.0);
            assert_has(&stored.left_out(), &["become void; --crop"]);
        }
    }
    // What is no number is refused by its voxel.
    let stored = Specimen::new(0.12).in_circle(f64::NAN).stored(F32);
    let grey = Phases::Grey(stored.histogram().propose(false).unwrap().grey);
    let within = |crop: &Crop| segment(&stored.stack, &grey, crop, || {});
    assert_says(within(&Crop::whole(DIMS)), &["holds NaN", "--crop"]);
    assert!(within(&"8:32,8:32,0:12".parse().unwrap()).is_ok());
}

#[test]
fn rings_move_thresholds_little() {
    let mut specimen = Specimen::new(0.12);
    for (i, grey) in specimen.grey.iter_mut().enumerate() {
        *grey += 2.5 * (1.7 * from_middle(i)).sin();
    }
    let wrong = specimen.wrong(&specimen.stored(U16));
    assert!(wrong < 0.02, "{wrong}");
}

/// Wood alone has no third phase, even where hot pixels make one.
#[test]
fn phases_that_are_not_there_are_not_proposed() {
    for hot in [0, 1, 100, 300] {
        let histogram = Specimen::new(0.0)
            .spoiled(hot, 65.0)
            .stored(U16)
            .histogram();
        assert_has(&histogram.propose(false).unwrap_err(), &["auto-wood"]);
        let wood = histogram.propose(true).unwrap().grey;
        let phase = |v| wood.phase(1000.0 * v).unwrap() as usize;
        let found = [10.0, 14.0, 18.0, 22.0].map(phase);
        assert_eq!(found, [0, 0, 1, 1], "{hot}: {wood}");
    }
}

/// Without noise void is one value, and may be at all corners: it is a phase where nothing else is.
#[test]
fn void_at_all_corners_stays_a_phase() {
    for inside in [0, 1] {
        let mut specimen = Specimen::new(0.12).in_circle(-1.0);
        for (grey, phase) in specimen.grey.iter_mut().zip(&mut specimen.phases) {
            if *phase == 0 && *grey != -1.0 {
                *phase = inside;
            }
            *grey = [0.0, 20.0, 40.0][*phase];
        }
        let stored = specimen.stored(("u8", |v| vec![v as u8]));
        assert_eq!(specimen.wrong(&stored), 0.0, "{inside}");
    }
}
