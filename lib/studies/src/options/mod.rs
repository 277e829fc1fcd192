//! `make options`: what the explicit scheme's options change on the flows it is wrong on, piston
//! into slit and channel, against the same references as `make verify`.

use crate::Result;
use crate::job::{Job, Outcome, run_all};
use crate::method::{Method, Scheme};
use crate::numbers::worst;
use crate::study::{self, Study};
use crate::verification::{self, Measured, Scene};

/// The options by name, with the keys they set.
pub(crate) const OPTIONS: [(&str, &[&str]); 5] = [
    ("cell mean", &["integrator.pressure=cell-mean"]),
    ("projection", &["integrator.density_projection=0.04cell"]),
    ("separation 0.6", &["contact.separation=0.6cell"]),
    ("separation 1.0", &["contact.separation=1.0cell"]),
    (
        "cell mean, projection",
        &[
            "integrator.pressure=cell-mean",
            "integrator.density_projection=0.04cell",
        ],
    ),
];

/// What is measured: where the paper's scheme is wrong, and flows that an option must not spoil.
const SCENES: [&str; 4] = [
    "slit n=6 off=0,0.25,0.5 up=0",
    "channel n=6 off=0,0.25,0.5",
    "squeeze n=6 off=0,0.25,0.5",
    "acoustic eta=0.001",
];

/// Methods: the paper's two, APIC, each with every option; the implicit scheme beside them.
fn methods() -> Vec<Method> {
    let mut list = Vec::new();
    for plain in ["FLIP", "XPIC(5)", "APIC"].map(Method::named) {
        list.push(plain.clone());
        list.extend(OPTIONS.map(|(name, keys)| plain.with(name, keys)));
    }
    list.push(Method::implicit());
    list
}

/// The study, on the scenes so named.
pub fn run(study: &Study) -> Result<bool> {
    let of = |words| verification::scenes(words).expect("part of the program");
    let mut scenes: Vec<Scene> = SCENES.into_iter().flat_map(of).collect();
    scenes.retain(|s| study.wants(&s.name));
    let mut jobs: Vec<Job> = Vec::new();
    for scene in &scenes {
        // The implicit scheme's usual step is as long as these runs: `make verify` has it.
        let short = scene.name.starts_with("squeeze") || scene.name.starts_with("acoustic");
        let mut methods = methods();
        methods.retain(|method| method.scheme == Scheme::Explicit || !short);
        jobs.extend(methods.into_iter().map(|method| (scene, method)));
    }
    let outcomes = run_all(&jobs, &study.folder());
    let columns = "case,method,quantity,error,steps,cpu_s,said";
    let rows = outcomes.iter().flat_map(fields);
    study.write_csv("explicit-options.csv", columns, rows)?;
    let head = study.head(outcomes.iter().map(|o| o.cpu_s));
    let values = [("head", &*head), ("table", &table(&scenes, &outcomes))];
    let page = study::filled(include_str!("page.txt"), &values);
    study.write("explicit-options.md", page)?;
    Ok(true)
}

/// The errors of a run, or why there are none.
fn fields(o: &Outcome) -> Vec<Vec<String>> {
    let row = |of: [&str; 5]| {
        let head = [&o.scene, o.method.label.as_str()].into_iter();
        head.chain(of).map(String::from).collect()
    };
    let (steps, cpu) = (o.steps.to_string(), format!("{:.1}", o.cpu_s));
    let error = |m: &Measured| row([&m.what, &format!("{:.4e}", m.error), &steps, &cpu, ""]);
    match &o.measured {
        Ok(list) => list.iter().map(error).collect(),
        Err(said) => vec![row(["", "", "", "", said])],
    }
}

/// The largest errors as a table: a row per method, a column per scene but for the sound wave.
fn table(scenes: &[Scene], outcomes: &[Outcome]) -> String {
    let names = scenes.iter().map(|s| s.name.as_str());
    let columns: Vec<&str> = names.filter(|name| !name.starts_with("acoustic")).collect();
    let row = |method: Method| {
        let cells = columns.iter().map(|scene| {
            let of = |o: &&Outcome| o.scene == **scene && o.method == method;
            outcomes.iter().find(of).map_or(String::new(), cell)
        });
        let cells: Vec<String> = cells.collect();
        format!("| {} | {} |", method.label, cells.join(" | "))
    };
    let heads = format!("| method | {} |", columns.join(" | "));
    study::table(&heads, methods().into_iter().map(row))
}

/// The largest error of what is compared, in per cent, or that the run was refused or stopped.
fn cell(outcome: &Outcome) -> String {
    let compared = ["piston force", "mean velocity", "force on the top"];
    let list = match &outcome.measured {
        Ok(list) => list,
        Err(said) if said.contains("exit Some(2)") => return "refused".into(),
        Err(_) => return "stopped".into(),
    };
    let of = list
        .iter()
        .filter(|m| compared.iter().any(|what| m.what.starts_with(what)));
    worst(of.map(|m| m.error)).map_or(String::new(), |error| format!("{:+.0}", 100.0 * error))
}
