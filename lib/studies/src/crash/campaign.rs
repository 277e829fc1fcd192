//! A fault at every call of a run that is new, stopped, continued, or replaces another; and runs killed or told to
//! stop several times in a row.

use std::os::unix::process::ExitStatusExt;

use super::Row;
use super::faults::{self, Fault, Point};
use super::place::Place;
use crate::Result;
use crate::method::Scheme;
use crate::study::said;

/// How a run comes to where faults begin.
#[derive(Clone, Copy, PartialEq)]
enum Way {
    New,
    /// New, and told to stop in the middle.
    Stopped,
    /// Continued after this part of its steps.
    Continued(f64),
    /// In place of the end of another run.
    Replacing,
}

/// Name of a series, arguments of the run and of its recovery, and how it comes to be.
type Series = (&'static str, &'static [&'static str], Way);

const SERIES: [Series; 6] = [
    ("new run", &["--resume"], Way::New),
    ("run stopped half way", &["--resume"], Way::Stopped),
    (
        "run continued from half way",
        &["--resume"],
        Way::Continued(0.5),
    ),
    (
        "run continued from its last step",
        &["--resume"],
        Way::Continued(1.0),
    ),
    ("run replacing another", &["--overwrite"], Way::Replacing),
    (
        "run replacing another, continued",
        &["--resume", "--overwrite"],
        Way::Replacing,
    ),
];

/// Trials of one series by one scheme.
struct Trials {
    series: Series,
    scheme: Scheme,
    /// The run in one piece.
    whole: Place,
    /// A folder like that each trial starts from.
    before: Option<Place>,
    /// Where it is told to stop, by different calls: strace knows one fault for each.
    stops: Vec<Point>,
}

/// Kills, and failing calls, at every `stride`-th point of all series; a row for each.
pub fn rows(stride: usize) -> Result<Vec<Row>> {
    let mut rows = Vec::new();
    for series in SERIES {
        for scheme in Scheme::ALL {
            let trials = Trials::new(series, scheme)?;
            for (fault, name) in [(Fault::Kill, "kill"), (Fault::Fail, "failing call")] {
                let points = trials.points(fault)?.into_iter().step_by(stride);
                let trial = |point: &Point| trials.trial(point, fault);
                let points: Vec<Point> = points.collect();
                rows.push(Row::new(series.0, scheme, name, &points, trial));
            }
        }
    }
    Ok(rows)
}

/// Faults before a run is let go to its end.
const FAULTS: usize = 6;

/// `count` runs of each scheme, named by their seeds, that are killed or told to stop each time somewhere else.
pub fn interrupted(count: u64) -> Result<Vec<Row>> {
    let more = ["--resume"];
    let seeds: Vec<u64> = (0..count).collect();
    let of_scheme = |scheme| {
        let whole = Place::new(scheme)?;
        let points = faults::points(&whole, &more, &[])?;
        let trial = |&seed: &u64| {
            let (place, mut random) = (Place::new(scheme)?, seed);
            for _ in 0..FAULTS {
                // Knuth's linear congruential generator; its high bits are good enough to choose points.
                random = (random.wrapping_mul(6_364_136_223_846_793_005))
                    .wrapping_add(1_442_695_040_888_963_407);
                let (point, _) = &points[(random >> 33) as usize % points.len()];
                let fault = [Fault::Kill, Fault::Terminate][(random >> 32 & 1) as usize];
                let output = faults::run(&place, &more, &[(point, fault)])?;
                let status = output.status;
                match (status.code(), status.signal()) {
                    // SIGTERM kills a process that has only begun.
                    (Some(0 | 75), _) | (None, Some(9 | 15)) => {}
                    _ => return Err(format!("{point}: {status:?}, {}", said(&output)).into()),
                }
            }
            place.ends_like(&whole, &more)
        };
        let (series, fault) = ("run interrupted six times", "kill or stop");
        Ok(Row::new(series, scheme, fault, &seeds, trial))
    };
    Scheme::ALL.into_iter().map(of_scheme).collect()
}

impl Trials {
    fn new(series: Series, scheme: Scheme) -> Result<Self> {
        let (_, more, way) = series;
        let whole = Place::new(scheme)?;
        let points = faults::points(&whole, more, &[])?;
        let at = |wanted: fn(&Point, &str) -> bool| -> Vec<&Point> {
            let found = points.iter().filter(|(point, wrote)| wanted(point, wrote));
            found.map(|(point, _)| point).collect()
        };
        // Rows are the writes that begin with the number of their step.
        let rows = at(|_, wrote| {
            let text = wrote.split_once(", \"").map_or("", |(_, text)| text);
            text.starts_with(|c: char| c.is_ascii_digit())
        });
        let renames =
            at(|point, wrote| point.call.starts_with("rename") && wrote.contains("snapshots/"));
        if rows.len() < 20 || renames.len() < 3 {
            return Err(format!("only {} rows and {} snapshots", rows.len(), renames.len()).into());
        }
        let stops = match way {
            Way::Stopped => vec![
                rows[rows.len() / 2].clone(),
                renames[renames.len() / 2].clone(),
            ],
            _ => Vec::new(),
        };
        let before = match way {
            Way::New | Way::Stopped => None,
            Way::Continued(part) => {
                let place = Place::new(scheme)?;
                let at = rows[(part * (rows.len() - 1) as f64) as usize];
                let output = faults::run(&place, more, &[(at, Fault::Terminate)])?;
                if output.status.code() != Some(75) {
                    let (status, said) = (output.status, said(&output));
                    return Err(format!("not stopped: {status:?}, {said}").into());
                }
                Some(place)
            }
            Way::Replacing => {
                let place = Place::new(scheme)?;
                let (viscosity, snapshots) =
                    ("adhesive.viscosity=\"2 Pa s\"", "output.snapshots=6");
                place.done(&["--set", viscosity, "--set", snapshots])?;
                Some(place)
            }
        };
        Ok(Self {
            series,
            scheme,
            whole,
            before,
            stops,
        })
    }

    fn place(&self) -> Result<Place> {
        match &self.before {
            Some(before) => before.copied(self.scheme),
            None => Place::new(self.scheme),
        }
    }

    /// Where else than at `call` the run is told to stop.
    fn stop(&self, call: &str) -> Option<&Point> {
        self.stops.iter().find(|stop| stop.call != call)
    }

    /// The points of `fault`.
    fn points(&self, fault: Fault) -> Result<Vec<Point>> {
        let mut stops: Vec<Option<&Point>> = self.stops.iter().map(Some).collect();
        if stops.is_empty() {
            stops.push(None);
        }
        let mut all = Vec::new();
        for stop in stops {
            let told: Vec<_> = stop.iter().map(|stop| (*stop, Fault::Terminate)).collect();
            let found = faults::points(&self.place()?, self.series.1, &told)?;
            // Standard error is no part of the folder, and libraries that cannot be opened say nothing.
            let found = found.into_iter().filter(|(point, arguments)| {
                let ours = point.call != "openat" || arguments.contains("\"run");
                !arguments.starts_with("2, ") && (fault == Fault::Kill || ours)
            });
            let found = found.map(|(point, _)| point);
            all.extend(found.filter(|point| self.stop(&point.call) == stop));
        }
        Ok(all)
    }

    fn trial(&self, point: &Point, fault: Fault) -> Result<()> {
        let place = self.place()?;
        let mut faults = vec![(point, fault)];
        faults.extend(self.stop(&point.call).map(|stop| (stop, Fault::Terminate)));
        let output = faults::run(&place, self.series.1, &faults)?;
        match (fault, output.status.code()) {
            (Fault::Kill, None) if output.status.signal() == Some(9) => {}
            // What cannot be opened may be taken for what is not there, or not sound.
            (Fault::Fail, Some(2 | 3)) if point.call == "openat" => {}
            (Fault::Fail, Some(0 | 1 | 75)) => {}
            (_, code) => return Err(format!("ended with {code:?}: {}", said(&output)).into()),
        }
        place.ends_like(&self.whole, self.series.1)
    }
}
