//! Liquid drawn into slits and tubes by its surface: rest, Lucas and Washburn, Jurin's height, angles that depend on the
//! speed.

use implicit::{Implicit, Settings};
use physics::{Motion, Points, Scene, Scheme, VoxelBlock, Wetting};

use crate::plain;
use crate::runs::{ETA, H, advance, plainly, until};

/// Surface tension, N/m.
const SIGMA: f64 = 0.05;

fn wetting(degrees: f64) -> Wetting {
    Wetting {
        tension: SIGMA,
        contact_angle: degrees.to_radians(),
    }
}

/// A passage along x.
#[derive(Clone, Copy, Debug)]
enum Passage {
    /// Between plates, in plane strain.
    Slit,
    Square,
    /// Round, of voxels of half a cell.
    Round,
}

impl Passage {
    /// Area over the square of the width.
    fn area(self, n: usize) -> f64 {
        match self {
            Self::Round => {
                let open = |v: usize| v as f64 + 0.5 - n as f64;
                let inside = |j| (0..2 * n).filter(move |&k| open(j).hypot(open(k)) < n as f64);
                (0..2 * n).flat_map(inside).count() as f64 / (2 * n).pow(2) as f64
            }
            _ => 1.0,
        }
    }

    /// Cells along z of a section so many cells across.
    fn deep(self, across: usize) -> usize {
        match self {
            Self::Slit => 1,
            _ => across,
        }
    }

    /// Perimeter over area, over 1/width.
    fn narrowness(self) -> f64 {
        match self {
            Self::Slit => 2.0,
            _ => 4.0,
        }
    }

    /// Pressure gradient of developed flow over viscosity, mean speed and width squared.
    fn resistance(self, n: usize) -> f64 {
        match self {
            Self::Slit => 12.0,
            Self::Square => 28.454,
            // By finite differences between the steps of the walls: they hold more than a circle of their area does.
            Self::Round => match n {
                4 => 34.719,
                6 => 35.944,
                12 => 34.023,
                _ => panic!("no resistance is known of a tube of {n} cells"),
            },
        }
    }
}

/// Walls of a passage of `n` cells from `mouth` on along x, in a quarter of the section, cells; and cells across.
fn walls(kind: Passage, n: usize, mouth: f64) -> (Vec<VoxelBlock>, usize) {
    let (h, w, far) = (H / n as f64, 0.5 * n as f64, 999.0);
    let block = |low: [f64; 2], high: [f64; 2]| {
        let side = |at: [f64; 2], x: f64| [x * h, at[0] * h, at[1] * h];
        VoxelBlock::solid_box(side(low, mouth), side(high, far))
    };
    let blocks = match kind {
        Passage::Slit => vec![block([w, 0.0], [far, 1.0])],
        Passage::Square => vec![block([w, 0.0], [far, far]), block([0.0, w], [w, far])],
        Passage::Round => {
            let open = |v: usize| 0.5 * (v as f64 + 0.5);
            let size = [far * h, 0.5 * h, 0.5 * h];
            let voxels = [1, 4 * n, 4 * n];
            let low = [mouth * h, 0.0, 0.0];
            let solid = |_, j, k| open(j).hypot(open(k)) >= w;
            vec![VoxelBlock::from_fn(low, size, voxels, solid)]
        }
    };
    (blocks, 2 * n)
}

/// Liquid in a box of cells, where no wall is, as points of half a cell.
fn liquid(h: f64, low: [f64; 3], cells: [usize; 3], blocks: &[VoxelBlock]) -> Points {
    let (dz, nz) = match cells[2] {
        1 => (h, 1),
        deep => (0.5 * h, 2 * deep),
    };
    let n = [2 * cells[0], 2 * cells[1], nz];
    let all = plain::fill(low.map(|x| x * h), [0.5 * h, 0.5 * h, dz], n);
    let mut points = Points::default();
    for (at, x) in all.position.iter().enumerate() {
        if !blocks.iter().any(|block| block.contains(*x)) {
            points.position.push(*x);
            points.velocity.push([0.0; 3]);
            points.volume.push(all.volume[at]);
        }
    }
    points
}

/// A quarter of a passage in so many cells, filled from a cell on over some.
fn filled(
    h: f64,
    cells: [usize; 3],
    (from, count): (f64, usize),
    blocks: Vec<VoxelBlock>,
    degrees: f64,
) -> Scene {
    let mut scene = plain::scene(h, cells);
    scene.points = liquid(h, [from, 0.0, 0.0], [count, cells[1], cells[2]], &blocks);
    scene.bodies = vec![plain::body("wood", blocks, Motion::Fixed)];
    scene.liquid.wetting = Some(wetting(degrees));
    scene
}

/// A quarter of a passage behind a reservoir four times as wide and three times as deep, with a free surface at its back; and
/// the x of its mouth, m.
fn wicking(kind: Passage, n: usize, degrees: f64) -> (Scene, f64) {
    let h = H / n as f64;
    let mouth = 3 * n + 2;
    let (blocks, across) = walls(kind, n, mouth as f64);
    let cells = [8 * n + 4, across, kind.deep(across)];
    let scene = filled(h, cells, (2.0, 3 * n), blocks, degrees);
    (scene, mouth as f64 * h)
}

/// Volume beyond a place along an axis.
fn beyond(scheme: &Implicit, axis: usize, from: f64) -> f64 {
    let liquid = scheme.liquid();
    (liquid.position.iter().zip(&liquid.volume))
        .filter(|(x, _)| f64::from(x[axis]) > from)
        .map(|(_, &v)| f64::from(v))
        .sum()
}

/// Error of the length, from one width to four, against L (L + 2 e) = t/`unit`, lengths in H; `e` is the equivalent length of
/// entrance, front and contact line.
fn length_error(kind: Passage, n: usize, degrees: f64, settings: Settings, e: f64) -> f64 {
    let (scene, mouth) = wicking(kind, n, degrees);
    let quarter = match kind {
        Passage::Slit => 0.5 * H * H * H / n as f64,
        _ => 0.25 * H.powi(3) * kind.area(n),
    };
    let pull = wetting(degrees).adhesion() * kind.narrowness() / H;
    let unit = 0.5 * kind.resistance(n) * ETA / pull;
    let mut scheme = Implicit::new(&scene, settings).unwrap();
    let (mut time, mut steps) = (0.0, 0);
    let mut course: Vec<[f64; 2]> = Vec::new();
    while course.last().is_none_or(|last| last[1] < 4.0) {
        time += advance(&mut scheme, 1.0).dt_s;
        steps += 1;
        assert!(steps < 60 * n);
        let length = beyond(&scheme, 0, mouth) / quarter;
        if length > 1.0 {
            course.push([time / unit, length]);
        }
    }
    let (first, last) = (course[0], course[course.len() - 1]);
    let exact = ((first[1] + e).powi(2) + last[0] - first[0]).sqrt() - e;
    let error = last[1] / exact - 1.0;
    println!(
        "{kind:?} of {n} cells, {degrees} degrees, k = {}: L {:+.2} % in {steps} steps",
        settings.dynamic_angle,
        100.0 * error
    );
    error
}

/// What entrance and front add, widths.
fn entrance(kind: Passage) -> f64 {
    match kind {
        Passage::Slit => 0.24,
        _ => 0.2,
    }
}

#[test]
fn lucas_and_washburn() {
    use Passage::{Round, Slit, Square};
    let slits = [(Slit, 6, 0.0), (Slit, 6, 60.0), (Slit, 3, 60.0)];
    for (kind, n, degrees) in slits.into_iter().chain([(Square, 6, 0.0), (Round, 6, 0.0)]) {
        let error = length_error(kind, n, degrees, Settings::default(), entrance(kind));
        assert!(error.abs() < 0.03);
    }
}

#[test]
#[ignore = "prints the numbers of other widths and steps"]
fn lucas_and_washburn_in_other_passages() {
    use Passage::{Round, Slit, Square};
    let slits = [(Slit, 4), (Slit, 12), (Square, 3), (Square, 4)];
    for (kind, n) in slits.into_iter().chain([(Round, 4), (Round, 12)]) {
        length_error(kind, n, 0.0, Settings::default(), entrance(kind));
    }
    for cfl in [0.5, 0.25] {
        let settings = Settings {
            cfl,
            ..Settings::default()
        };
        length_error(Slit, 6, 0.0, settings, entrance(Slit));
    }
}

/// A contact line that resists by k Ca adds k narrowness/resistance widths to the length of developed flow.
#[test]
fn an_angle_that_depends_on_the_speed_adds_a_length() {
    use Passage::{Round, Slit, Square};
    let tubes = [(Square, 90.0), (Round, 20.0), (Round, 90.0)];
    for (kind, k) in [(Slit, 5.0), (Slit, 90.0)].into_iter().chain(tubes) {
        let settings = Settings {
            dynamic_angle: k,
            ..Settings::default()
        };
        let line = k * kind.narrowness() / kind.resistance(6);
        let error = length_error(kind, 6, 0.0, settings, entrance(kind) + line);
        assert!(error.abs() < 0.03);
    }
}

/// Liquid that fills a passage between two menisci rests at minus their jump.
#[test]
fn liquid_between_two_menisci_rests() {
    for kind in [Passage::Slit, Passage::Square, Passage::Round] {
        let n = 6;
        let h = H / n as f64;
        let (blocks, across) = walls(kind, n, -1.0);
        let scene = filled(h, [20, across, kind.deep(across)], (5.0, 8), blocks, 0.0);
        let mut scheme = plainly(&scene);
        (0..5).for_each(|_| _ = advance(&mut scheme, 1e-3));
        let jump = SIGMA * kind.narrowness() / H;
        let liquid = scheme.liquid();
        let lowest = liquid
            .pressure
            .iter()
            .fold(0.0, |low: f64, &p| low.min(f64::from(p)));
        let speed = scheme.diagnostics().max_speed * ETA / SIGMA;
        println!(
            "{kind:?}: speed {speed:.1e} sigma/eta, pressure {:.6} of the jump",
            lowest / jump
        );
        assert!(speed < 1e-5 && (lowest / jump + 1.0).abs() < 1e-3);
    }
}

/// A plate half a width thick beside half a slit of H dips into a pool: the height of the liquid in the slit over that
/// beside the plate, over 2 sigma/(rho g H) = 3/2 H.
fn rise(n: usize, degrees: f64) -> (f64, f64) {
    let h = H / n as f64;
    let m = |x: usize| x as f64 * h;
    // From the middle of the slit: half a slit, the plate, one and a half widths of pool, to its mirror.
    let [left, right, low] = [n / 2, n, n];
    let plate = VoxelBlock::solid_box([m(left), m(low), 0.0], [m(right), 99.0 * H, h]);
    let mut scene = plain::scene(h, [n / 2 * 5, 5 * n, 1]);
    let plates = std::slice::from_ref(&plate);
    scene.points = liquid(h, [0.0; 3], [n / 2 * 5, 2 * n, 1], plates);
    scene.bodies = vec![plain::body("plate", vec![plate], Motion::Fixed)];
    scene.liquid.wetting = Some(wetting(degrees));
    let height = 1.5 * H;
    scene.gravity[1] = -2.0 * SIGMA / (scene.liquid.density * H * height);
    let (mut scheme, mut steps) = (plainly(&scene), 0);
    until(&mut scheme, 120.0 * ETA * H / SIGMA, |_, _| steps += 1);
    let liquid = scheme.liquid();
    let mut above = [0.0; 2];
    for (x, v) in liquid.position.iter().zip(&liquid.volume) {
        if f64::from(x[1]) > m(low) {
            above[usize::from(f64::from(x[0]) < m(left))] += f64::from(*v) / h;
        }
    }
    // The pool is one and a half widths beside half a slit, three with its mirror image.
    let found = (above[1] / (0.5 * H) - above[0] / (1.5 * H)) / height;
    let exact = degrees.to_radians().cos() * (1.0 - 1.0 / 3.0);
    println!("{n} cells, {degrees} degrees: height {found:+.4} of {exact:+.4} in {steps} steps");
    (found, exact)
}

#[test]
fn jurins_height() {
    for (n, degrees) in [(6, 0.0), (6, 60.0), (6, 120.0), (12, 0.0)] {
        let (found, exact) = rise(n, degrees);
        assert!((found / exact - 1.0).abs() < 0.05);
    }
}
