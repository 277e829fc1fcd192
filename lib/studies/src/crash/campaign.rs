//! A fault at every call of a run that is new, stopped, continued, or replaces another.

use std::os::unix::process::ExitStatusExt;

use super::faults::{self, Fault, Point};
use super::scene::{Place, Scene, same};
use super::{Row, all_wrong};
use crate::Result;
use crate::study::said;

/// A run as it is started, interrupted, and recovered.
struct Series {
    name: &'static str,
    /// Arguments of the run and of its recovery.
    more: &'static [&'static str],
    /// What its folder holds before.
    before: Before,
    /// Whether it is told to stop in the middle.
    stopped: bool,
}

/// What a run folder holds before a run.
#[derive(Clone, Copy, PartialEq)]
enum Before {
    Nothing,
    /// The run, stopped after this part of its steps.
    Stopped(f64),
    /// The end of another run.
    Other,
}

const SERIES: [Series; 6] = [
    Series {
        name: "new run",
        more: &["--resume"],
        before: Before::Nothing,
        stopped: false,
    },
    Series {
        name: "run told to stop half way",
        more: &["--resume"],
        before: Before::Nothing,
        stopped: true,
    },
    Series {
        name: "run continued from half way",
        more: &["--resume"],
        before: Before::Stopped(0.5),
        stopped: false,
    },
    Series {
        name: "run continued from its last step",
        more: &["--resume"],
        before: Before::Stopped(1.0),
        stopped: false,
    },
    Series {
        name: "run in place of another",
        more: &["--overwrite"],
        before: Before::Other,
        stopped: false,
    },
    Series {
        name: "run in place of another, continued",
        more: &["--resume", "--overwrite"],
        before: Before::Other,
        stopped: false,
    },
];

/// Trials of one series for one scene.
struct Trials<'a> {
    series: &'a Series,
    scene: Scene,
    /// The run in one piece.
    whole: Place,
    /// A folder like that each trial starts from.
    before: Option<Place>,
    /// Where it is told to stop, by different calls: strace knows one fault for each.
    stops: Vec<Point>,
}

/// Kills, and failing calls, at every `stride`-th point of all series; a row for each.
///
/// # Errors
/// What keeps the campaign from being made.
pub fn rows(stride: usize, mut tell: impl FnMut(&Row)) -> Result<Vec<Row>> {
    let mut rows = Vec::new();
    for series in &SERIES {
        for scene in Scene::ALL {
            let trials = Trials::new(series, scene)?;
            for fault in [Fault::Kill, Fault::Fail] {
                let row = trials.row(fault, stride)?;
                tell(&row);
                rows.push(row);
            }
        }
    }
    Ok(rows)
}

impl<'a> Trials<'a> {
    fn new(series: &'a Series, scene: Scene) -> Result<Self> {
        let whole = Place::new(scene)?;
        let points = faults::points(&whole, series.more, &[])?;
        // Rows are the writes that begin with the number of their step.
        let rows: Vec<&Point> = (points.iter())
            .filter(|(_, wrote)| {
                wrote
                    .split_once(", \"")
                    .is_some_and(|(_, text)| text.starts_with(|c: char| c.is_ascii_digit()))
            })
            .map(|(point, _)| point)
            .collect();
        let renames: Vec<&Point> = (points.iter())
            .filter(|(point, wrote)| {
                point.call.starts_with("rename") && wrote.contains("snapshots/")
            })
            .map(|(point, _)| point)
            .collect();
        if rows.len() < 20 || renames.len() < 3 {
            return Err(format!("only {} rows and {} snapshots", rows.len(), renames.len()).into());
        }
        let stops = [rows[rows.len() / 2], renames[renames.len() / 2]].map(Clone::clone);
        let before = match series.before {
            Before::Nothing => None,
            Before::Stopped(part) => {
                let place = Place::new(scene)?;
                let at = rows[(part * (rows.len() - 1) as f64) as usize];
                let output = faults::run(&place, series.more, &[(at, Fault::Terminate)])?;
                if output.status.code() != Some(75) {
                    return Err(
                        format!("not stopped: {:?}, {}", output.status, said(&output)).into(),
                    );
                }
                Some(place)
            }
            Before::Other => {
                let place = Place::new(scene)?;
                place.done(&[
                    "--set",
                    "adhesive.viscosity=\"2 Pa s\"",
                    "--set",
                    "output.snapshots=6",
                ])?;
                Some(place)
            }
        };
        Ok(Self {
            series,
            scene,
            whole,
            before,
            stops: if series.stopped {
                stops.into()
            } else {
                Vec::new()
            },
        })
    }

    fn place(&self) -> Result<Place> {
        match &self.before {
            Some(before) => Place::with_run_of(self.scene, before),
            None => Place::new(self.scene),
        }
    }

    /// Where else than at `call` the run is told to stop.
    fn stop(&self, call: &str) -> Option<&Point> {
        self.stops.iter().find(|stop| stop.call != call)
    }

    /// The points of `fault`.
    fn points(&self, fault: Fault) -> Result<Vec<Point>> {
        let mut all: Vec<Point> = Vec::new();
        let ways: Vec<Vec<(&Point, Fault)>> = match self.stops.as_slice() {
            [] => vec![Vec::new()],
            stops => stops
                .iter()
                .map(|stop| vec![(stop, Fault::Terminate)])
                .collect(),
        };
        for way in &ways {
            let found = faults::points(&self.place()?, self.series.more, way)?;
            let reached =
                |point: &Point| self.stop(&point.call) == way.first().map(|(stop, _)| *stop);
            // Standard error is no part of the folder, and libraries that cannot be opened say nothing.
            let found = found.into_iter().filter(|(point, arguments)| {
                let ours = point.call != "openat" || arguments.contains("\"run");
                !arguments.starts_with("2, ") && (fault == Fault::Kill || ours)
            });
            all.extend(found.map(|(point, _)| point).filter(reached));
        }
        Ok(all)
    }

    fn row(&self, fault: Fault, stride: usize) -> Result<Row> {
        let points: Vec<Point> = (self.points(fault)?.into_iter()).step_by(stride).collect();
        Ok(Row {
            series: self.series.name,
            scheme: self.scene.name(),
            fault: match fault {
                Fault::Kill => "kill",
                _ => "failing call",
            },
            trials: points.len(),
            wrong: all_wrong(&points, |point| {
                self.trial(point, fault)
                    .map_err(|said| format!("{point}: {said}").into())
            }),
        })
    }

    fn trial(&self, point: &Point, fault: Fault) -> Result<()> {
        let place = self.place()?;
        let mut faults = vec![(point, fault)];
        faults.extend(self.stop(&point.call).map(|stop| (stop, Fault::Terminate)));
        let output = faults::run(&place, self.series.more, &faults)?;
        match (fault, output.status.code()) {
            (Fault::Kill, None) if output.status.signal() == Some(9) => {}
            // What cannot be opened may be taken for what is not there, or not sound.
            (Fault::Fail, Some(2 | 3)) if point.call == "openat" => {}
            (Fault::Fail, Some(0 | 1 | 75)) => {}
            (_, code) => return Err(format!("ended with {code:?}: {}", said(&output)).into()),
        }
        place
            .done(self.series.more)
            .map_err(|said| format!("then {said}"))?;
        same(&self.whole.run_folder(), &place.run_folder())
    }
}
