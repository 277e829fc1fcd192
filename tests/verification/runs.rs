//! A scene by a method, and mistakes in it that must show.

use studies::case_text::Viscosity;
use studies::job::{Job, run_one};
use studies::method::Method;
use studies::outputs;
use studies::verification::Scene;

/// A scene by a method.
pub struct Run<'a>(pub &'a dyn Fn() -> Scene, pub Method);

pub type Mistake = fn(Scene) -> Scene;

impl Run<'_> {
    /// Columns of the history of a run of a method whose label is the part of a file name as it is.
    pub fn columns<const N: usize>(&self, names: [&str; N]) -> [Vec<f64>; N] {
        let (scene, folder) = ((self.0)(), tempfile::tempdir().unwrap());
        _ = run_one(&self.job(&scene), folder.path());
        let run = outputs::Run {
            folder: folder
                .path()
                .join(format!("{}-{}", scene.name, self.1.label)),
        };
        names.map(|name| run.history(name).unwrap())
    }

    fn job<'a>(&self, scene: &'a Scene) -> Job<'a> {
        let method = self.1.clone();
        Job { scene, method }
    }

    /// Errors of the quantities whose names begin with `what`.
    pub fn errors(&self, scene: &Scene, what: &str) -> Vec<f64> {
        let folder = tempfile::tempdir().unwrap();
        let outcome = run_one(&self.job(scene), folder.path());
        let list = outcome.measured.unwrap_or_else(|said| panic!("{said}"));
        let of = list.iter().filter(|m| m.what.starts_with(what));
        of.map(|m| m.error).collect()
    }

    /// The largest of them by magnitude.
    pub fn error(&self, scene: &Scene, what: &str) -> f64 {
        let errors = self.errors(scene, what).into_iter().map(f64::abs);
        let worst = errors.max_by(f64::total_cmp);
        let worst = worst.unwrap_or_else(|| panic!("{}: nothing named {what}", scene.name));
        println!("{} {}: {what} {worst:.3e}", scene.name, self.1.label);
        worst
    }

    pub fn within(&self, tolerance: f64, what: &str) -> &Self {
        let scene = (self.0)();
        let found = self.error(&scene, what);
        assert!(
            found <= tolerance,
            "{}: {what} is off by {found:e}",
            scene.name
        );
        self
    }

    /// Within the tolerance, and beyond it with any of these mistakes in the scene.
    pub fn notices(&self, mistakes: &[Mistake], tolerance: f64, what: &str) -> &Self {
        for mistake in mistakes {
            let scene = mistake((self.0)());
            let found = self.error(&scene, what);
            assert!(
                found > tolerance,
                "{}: mutated, off by {found:e}",
                scene.name
            );
        }
        self.within(tolerance, what)
    }
}

/// The implicit scheme with several steps from rest to a developed flow.
pub fn short_steps() -> Method {
    Method::implicit().setting("integrator.cfl=0.001")
}

/// A viscosity so many times as large.
pub fn times(mut scene: Scene, factor: f64) -> Scene {
    match &mut scene.case.viscosity {
        Viscosity::Newtonian(eta) => *eta *= factor,
        Viscosity::Table(rows) => rows.iter_mut().for_each(|[_, eta]| *eta *= factor),
        // A body force as much lower does the same.
        Viscosity::Law(_) => scene.case.gravity[0] /= factor,
    }
    scene
}

pub const THICKER: Mistake = |scene| times(scene, 1.05);
pub const A_QUARTER_THICKER: Mistake = |scene| times(scene, 1.25);

/// The scene with the wall of this index half a cell higher at its low side.
pub fn lifted(mut scene: Scene, wall: usize) -> Scene {
    scene.case.bodies[wall].min[1] += 0.5 * scene.case.cell;
    scene
}
