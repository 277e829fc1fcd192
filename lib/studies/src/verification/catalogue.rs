//! All verification scenes with the methods that apply to each: catalogue.txt, in the order of docs/methods.md section 5.1.

use super::lumen::Section;
use super::piston::Drive;
use super::{
    Scene, acoustic, air, channel, clamp, cure, duct, galilean, grain, incline, laws, piston,
    sealed, slit, spheres, squeeze, stefan, tait, taylor_green, water, wicking,
};
use crate::lines::{self, Values};
use crate::method::{Method, Scheme};

/// The scenes of all lines.
pub(super) fn all() -> Vec<(Scene, Vec<Method>)> {
    lines::read(include_str!("catalogue.txt"), |line| {
        let (words, labels) = line.split_once(" | ")?;
        let entry = |values: Values| {
            let scene = scene_of(&values)?;
            let halves = ["0", "0.5"].contains(&values.word("off").unwrap_or("0"));
            let mut methods: Vec<Method> = labels.split(' ').flat_map(methods).collect();
            methods.retain(|m| halves || m.scheme == Scheme::Explicit);
            Some((scene, methods))
        };
        Values::all(words).into_iter().map(entry).collect()
    })
}

/// The scenes of the words of a line.
pub fn scenes(words: &'static str) -> Option<Vec<Scene>> {
    (Values::all(words).iter()).map(scene_of).collect()
}

/// The methods that a word stands for; behind each + is a key that they set.
pub fn methods(word: &str) -> Vec<Method> {
    let mut parts = word.split('+');
    let label = parts.next().unwrap_or_default();
    let (label, cfl) = label
        .split_once('@')
        .map_or((label, None), |(label, cfl)| (label, Some(cfl)));
    let plain = match label {
        "paper" => ["FLIP", "XPIC(5)"].map(Method::named).into(),
        // An order between two tells nothing more.
        "updates" => (Method::UPDATES.into_iter())
            .filter(|label| !label.contains('3'))
            .map(Method::named)
            .collect(),
        label => vec![Method::named(label)],
    };
    let cfl = cfl.map(|cfl| format!("integrator.cfl={cfl}"));
    let keys: Vec<String> = cfl.into_iter().chain(parts.map(String::from)).collect();
    let set = |method| keys.iter().fold(method, |m: Method, key| m.setting(key));
    plain.into_iter().map(set).collect()
}

fn scene_of(of: &Values) -> Option<Scene> {
    let n = || of.word("n")?.parse::<u32>().ok();
    let [off, degrees, eta] = ["off", "degrees", "eta"].map(|key| move || of.number(key));
    let section = || {
        let all = [Section::Square, Section::Round(2), Section::Round(1)];
        let name = of.word("section").filter(|name| *name != "slit")?;
        let found = all.into_iter().find(|s| s.name() == name);
        Some(found.unwrap_or_else(|| panic!("there is no section {name}")))
    };
    let or = |key, usual| of.number(key).unwrap_or(usual);
    let [depth, slowing] =
        [("depth", 1.5), ("slowing", 0.0)].map(|(key, usual)| move || or(key, usual));
    let mut scene = match of.name {
        "incline" => incline::scene(n()?, off()?, of.number("until")?),
        "channel" => channel::scene(n()?, off()?, of.number("slip"), 3e-6),
        "table" => laws::scene(laws::TABLE, n()?, 0.0, 0.4e-6),
        "law" => {
            let law = laws::LAWS
                .into_iter()
                .find(|l| of.word("name") == Some(l.name));
            laws::scene(law?, n()?, off()?, 0.4e-6)
        }
        "couette" => channel::couette_scene(n()?, off()?, 0.1, 3e-6),
        "duct" => duct::scene(section()?, n()?, 2e-6),
        "slit" => slit::scene(n()?, [off()?, of.number("up")?]),
        "piston" => piston::scene(section()?, n()?, Drive::Speed(0.5)),
        "washburn" => slit::filled_scene(n()?, off()?),
        "washburn3d" => piston::scene(section()?, n()?, Drive::Pressure(1e6)),
        "cure" => {
            let laws = [cure::GEL, cure::TABLE];
            let law = laws.into_iter().find(|l| of.word("law") == Some(l.name))?;
            match section() {
                Some(_) => cure::tube_scene(n()?, law),
                None => cure::slit_scene(n()?, law),
            }
        }
        "water" => match section() {
            Some(_) => water::tube_scene(n()?),
            None => water::slit_scene(n()?),
        },
        "air" => air::scene(n()?, of.number("leak")),
        "wicking" => match section() {
            Some(section) => wicking::tube_scene(section, n()?, depth(), degrees()?, slowing()),
            None => wicking::slit_scene(n()?, [off()?, of.number("along")?], degrees()?, slowing()),
        },
        "jurin" => wicking::jurin_scene(n()?, off()?, degrees()?),
        "spheres" => {
            let fraction = of.number("fraction")?;
            let row = spheres::DRAG.into_iter().find(|row| row.0 == fraction);
            spheres::scene(n()?, row?)
        }
        "grain" => grain::scene(n()?),
        "squeeze" => squeeze::scene(n()?, off()?),
        "disc" => squeeze::disc_scene(8, n()?, off()?),
        "stefan" => {
            let load = match of.word("load")? {
                "hold" => stefan::Load::Hold,
                _ => stefan::Load::Programme,
            };
            stefan::scene(n().unwrap_or(6), load, of.number("time")?)
        }
        "tait" => tait::scene(),
        "acoustic" => acoustic::scene(eta()?),
        "column" => tait::resting_scene(off()?, 6e-6),
        "vortex" => taylor_green::scene(n()?, eta()?),
        "drop" => galilean::drop_scene(or("until", 0.5e-6)),
        "galilean" => galilean::scene(of.word("law")?, or("off", 0.5)),
        "sealed" => sealed::scene(of.word("voxels")?.parse().ok()?, off()?),
        "clamp" => clamp::scene(3.0),
        _ => return None,
    };
    scene.case.stop = of.number("stop").or(scene.case.stop);
    of.stray().is_none().then_some(scene)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// It was passed over where the key has a default.
    #[test]
    fn a_misspelt_key_or_value_is_refused() {
        assert!(scenes("wicking n=6 off=0 along=0 degrees=60 slowing=5").is_some());
        assert!(scenes("wicking n=6 off=0 along=0 degrees=60 slow=5").is_none());
        assert!(scenes("clamp n=3").is_none());
        for words in ["air n=6 leak=nine", "water section=tubes n=6"] {
            assert!(std::panic::catch_unwind(|| scenes(words)).is_err());
        }
    }

    #[test]
    fn names_are_unique_series_known_and_every_scene_has_methods_and_goal_scenes() {
        let entries = all();
        let names: std::collections::HashSet<_> = entries.iter().map(|(s, _)| &s.name).collect();
        assert_eq!(names.len(), entries.len());
        let series = Scene::resolution("channel-n6-off0.25");
        assert_eq!(series, ("channel-off0.25".into(), Some(6)));
        assert!(entries.iter().all(|(_, methods)| !methods.is_empty()));
        for goal in crate::verification::goals::goals() {
            let about = |(scene, methods): &(Scene, Vec<Method>)| {
                methods.iter().any(|m| goal.is_about(&scene.name, &m.label))
            };
            assert!(entries.iter().any(about), "{}", goal.cases);
        }
    }
}
