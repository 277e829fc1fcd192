//! Which scenes by which methods: plan.txt, described in docs/methods.md section 5.2.

use super::scenes;
use super::trial::Trial;
use crate::case_text::Viscosity;
use crate::lines::{self, Values};
use crate::method::{Method, Scheme};
use crate::options::OPTIONS;

/// Courant number where it is not what is varied.
const CFL: f64 = 0.5;

/// Methods that every value is tried with.
const USUAL: [&str; 4] = ["FLIP", "XPIC(5)", "APIC", "implicit"];

/// All trials.
pub(super) fn trials() -> Vec<Trial> {
    lines::read(include_str!("plan.txt"), of_line)
}

fn of_line(line: &'static str) -> Option<Vec<Trial>> {
    let mut parts = line.split(" | ");
    let (varied, value) = (parts.next()?, parts.next()?);
    let (scene, methods) = (Values::all(parts.next()?), named(parts.next()?));
    let more = parts.next().and_then(|more| more.split_once(' '));
    let mut trials = Vec::new();
    for of in &scene {
        let mut scene = scenes::of(of)?;
        if let Some(("law", law)) = more {
            scene.case.viscosity = Viscosity::Law(law.into());
        }
        let cfl = of.number("cfl").unwrap_or(CFL);
        for (option, method) in &methods {
            let value = of.within(value).replace("{option}", option);
            scene.case.title = format!("{varied}: {value}.");
            trials.push(Trial {
                varied,
                value,
                scene: scene.clone(),
                method: match more {
                    Some(("set", key)) => method.clone().setting(of.within(key)),
                    _ => method.clone(),
                },
                cfl,
            });
        }
        if of.stray().is_some() {
            return None;
        }
    }
    Some(trials)
}

/// The methods of a word, with the name of an option that they have.
fn named(word: &str) -> Vec<(&'static str, Method)> {
    let plain = |labels: &[&str]| -> Vec<_> {
        labels
            .iter()
            .map(|label| ("", Method::named(label)))
            .collect()
    };
    match word {
        "usual" => plain(&USUAL),
        "updates" => plain(&Method::UPDATES),
        "cell-mean" => {
            let mean = Method::named("APIC").setting("integrator.pressure=cell-mean");
            [plain(&USUAL), vec![("", mean.called("APIC, cell mean"))]].concat()
        }
        "options" => {
            let explicit = |method: &Method| method.scheme == Scheme::Explicit;
            let of = |(name, keys): (&'static str, &[&str])| {
                let with = |m: Method| keys.iter().fold(m, |m, key| m.setting(*key));
                let methods = USUAL.map(Method::named).into_iter();
                let methods = methods.filter(explicit).map(with);
                methods.map(|method| (name, method)).collect::<Vec<_>>()
            };
            OPTIONS.into_iter().flat_map(of).collect()
        }
        label => plain(&[label]),
    }
}

#[test]
fn no_trial_is_there_twice() {
    let all = trials();
    let name = |t: &Trial| (t.varied, t.value.clone(), t.method.label.clone());
    let names: std::collections::HashSet<_> = all.iter().map(name).collect();
    assert_eq!(names.len(), all.len());
}
