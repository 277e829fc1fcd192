//! Instructions of a run by stage.

use std::path::Path;

use super::callgrind;
use crate::Result;
use crate::case_text::CaseText;
use crate::lines;
use crate::method::{Method, Scheme};
use crate::outputs::Run;
use crate::study::{side_by_side, table, write};

/// A stage and its functions, as module and function, or type and method.
type Stage = (&'static str, Vec<&'static str>);

/// Stages in the order of a step: stages.txt.
fn stages(scheme: Scheme) -> Vec<Stage> {
    lines::read(include_str!("stages.txt"), |line| {
        let [own, stage, functions] = line.split(" | ").collect::<Vec<_>>()[..] else {
            return None;
        };
        let stage = (stage, functions.split(' ').collect());
        Some(
            (own == scheme.name())
                .then_some(stage)
                .into_iter()
                .collect(),
        )
    })
}

/// A scene, by one scheme.
pub(super) struct Scene {
    pub(super) name: &'static str,
    /// Stages that it does without.
    pub(super) without: Vec<&'static str>,
    pub(super) method: Method,
    pub(super) case: CaseText,
}

/// Instructions of scenes of one scheme.
pub(super) struct Table {
    scheme: Scheme,
    scenes: Vec<Scene>,
    /// Of each scene: millions per step of each stage, and of the whole run.
    counts: Vec<Vec<f64>>,
}

impl Table {
    /// Runs the scenes of a scheme in `folder`; an error where none has a stage, whose functions are gone then, or inlined.
    pub(super) fn measure(scheme: Scheme, folder: &Path) -> Result<Self> {
        let scenes = super::scenes::of(scheme);
        let counts: Result<Vec<Vec<f64>>> =
            side_by_side(&scenes, |scene| count(scheme, scene, folder));
        let counts = counts?;
        for (i, (stage, functions)) in stages(scheme).iter().enumerate() {
            if counts.iter().all(|of_stage| of_stage[i] == 0.0) {
                let said = format!("stage '{stage}': no run has a function {functions:?}");
                return Err(said.into());
            }
        }
        Ok(Self {
            scheme,
            scenes,
            counts,
        })
    }

    /// Whether no scene has instructions in a stage that it does without.
    pub(super) fn absent_are_zero(&self) -> bool {
        self.scenes.iter().zip(&self.counts).all(|(scene, counts)| {
            (stages(self.scheme).into_iter().zip(counts))
                .all(|((stage, _), count)| !scene.without.contains(&stage) || *count == 0.0)
        })
    }

    /// Stages and the whole run as rows, scenes as columns: the page's table.
    pub(super) fn text(&self) -> String {
        let names: Vec<&str> = self.scenes.iter().map(|scene| scene.name).collect();
        let row = |(i, name): (usize, &str)| {
            let cells: Vec<String> = self.counts.iter().map(|counts| cell(counts[i])).collect();
            format!("| {name} | {} |", cells.join(" | "))
        };
        let heads = format!("| stage | {} |", names.join(" | "));
        table(&heads, self.names().enumerate().map(row))
    }

    /// Rows of the CSV file.
    pub(super) fn rows(&self) -> impl Iterator<Item = Vec<String>> {
        let scenes = self.scenes.iter().zip(&self.counts);
        scenes.flat_map(|(scene, counts)| {
            let row = |(name, count): (&str, &f64)| {
                let words = [self.scheme.name(), scene.name, name, &cell(*count)];
                words.map(String::from).to_vec()
            };
            self.names().zip(counts).map(row).collect::<Vec<_>>()
        })
    }

    fn names(&self) -> impl Iterator<Item = &'static str> {
        let stages = stages(self.scheme).into_iter().map(|(name, _)| name);
        stages.chain(["whole run"])
    }
}

fn cell(count: f64) -> String {
    if count == 0.0 {
        "0".into()
    } else {
        format!("{count:.3}")
    }
}

/// Millions of instructions per step of each stage of a scene, and of the whole run.
fn count(scheme: Scheme, scene: &Scene, folder: &Path) -> Result<Vec<f64>> {
    let name = format!("{}-{}", scheme.name(), scene.name.replace(' ', "-"));
    let (case, run) = (folder.join(format!("{name}.toml")), folder.join(name));
    write(&case, scene.case.text(scheme.integrator()))?;
    let (total, functions) = callgrind::profile(&scene.method.command(&case, &run))?;
    let steps = Run { folder: run }.summary("steps");
    let steps = steps.ok_or("the run's summary has no steps")?;
    let of_stage = |(_, names): Stage| {
        let is = |function: &str, name: &str| function.ends_with(&format!("::{name}"));
        let own = functions
            .iter()
            .filter(|(f, _)| names.iter().any(|name| is(f, name)));
        own.map(|(_, cost)| cost).sum()
    };
    let counts = stages(scheme).into_iter().map(of_stage).chain([total]);
    Ok(counts.map(|count: f64| count / steps / 1e6).collect())
}

#[test]
fn what_scenes_do_without_are_stages() {
    for scheme in Scheme::ALL {
        let known = |name: &&str| stages(scheme).iter().any(|(stage, _)| stage == name);
        let scenes = super::scenes::of(scheme);
        assert!(scenes.iter().flat_map(|s| &s.without).all(known));
    }
}
