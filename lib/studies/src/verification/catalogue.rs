//! All verification scenes with the methods that apply to each.

use super::lumen::Section;
use super::piston::Drive;
use super::{
    Scene, acoustic, air, channel, clamp, column, couette, cure, disc, drop, duct, galilean, grain,
    incline, jurin, laws, piston, sealed, slit, spheres, squeeze, stefan, tait, taylor_green,
    washburn, water, wicking,
};
use crate::case_text::PF;
use crate::method::{Method, Scheme};

/// A scene with its methods.
pub type Entry = (Scene, Vec<Method>);

/// Courant number of flows that develop in a lumen: four steps and more from rest to the end.
const DEVELOPED: f64 = 0.001;

/// Offsets of walls from the nodes, cells.
const OFFSETS: [f64; 4] = [0.0, 0.25, 0.5, 0.75];

/// Those that the implicit scheme takes: walls on faces of cells and half way between.
const HALVES: [f64; 2] = [0.0, 0.5];

/// The methods that take walls at `offset` cells from the nodes.
fn that_take(offset: f64, methods: Vec<Method>) -> Vec<Method> {
    let takes = |method: &Method| method.scheme != Scheme::Implicit || HALVES.contains(&offset);
    methods.into_iter().filter(takes).collect()
}

/// The implicit scheme with steps short enough for what happens between rest and steady flow:
/// at the usual Courant number the first step is as long as the whole run, and its backward Euler
/// error does not fall with the cells.
fn short_steps(cfl: f64) -> Method {
    Method::implicit().setting(format!("integrator.cfl={cfl}"))
}

/// What the paper ran, and the implicit scheme at a Courant number.
fn main_methods(cfl: f64) -> Vec<Method> {
    vec![Method::flip(), Method::xpic(5), short_steps(cfl)]
}

/// The implicit scheme as a user has it, for flows that fill.
fn implicit() -> Vec<Method> {
    vec![Method::implicit()]
}

/// Every update, and the implicit scheme at a Courant number.
fn all_methods(cfl: f64) -> Vec<Method> {
    let mut list = Method::updates();
    list.push(short_steps(cfl));
    list
}

/// The scenes in the order of docs/methods.md section 5.1.
pub fn all() -> Vec<Entry> {
    [
        films(),
        channels(),
        lumens(),
        filling(),
        menisci(),
        arrays(),
        squeezing(),
        liquids(),
        invariants(),
    ]
    .into_iter()
    .flatten()
    .collect()
}

fn films() -> Vec<Entry> {
    /// Six steps and more from rest to the end.
    const FILM: f64 = 1e-4;
    let film = |offset: f64| {
        let until = if offset == 0.0 {
            incline::PAPER_TIME
        } else {
            0.1 * incline::PAPER_TIME
        };
        let methods = that_take(offset, main_methods(FILM));
        (incline::scene(6, offset, until), methods)
    };
    let mut list: Vec<Entry> = OFFSETS.into_iter().map(film).collect();
    for n in [3, 12] {
        for offset in HALVES {
            let scene = incline::scene(n, offset, 0.1 * incline::PAPER_TIME);
            list.push((scene, vec![short_steps(FILM)]));
        }
    }
    list
}

fn channels() -> Vec<Entry> {
    let mut list = Vec::new();
    for n in [3, 6, 12] {
        for offset in OFFSETS.into_iter().chain([0.95]) {
            let methods = if n == 6 {
                all_methods(DEVELOPED)
            } else {
                vec![Method::xpic(5), short_steps(DEVELOPED)]
            };
            let scene = channel::scene(n, offset, None, 3e-6);
            list.push((scene, that_take(offset, methods)));
        }
    }
    for offset in [0.0, 0.25, 0.5] {
        let scene = channel::scene(6, offset, Some(0.1), 3e-6);
        list.push((scene, that_take(offset, main_methods(DEVELOPED))));
    }
    for n in [3, 6, 12, 24] {
        let mut methods = vec![short_steps(DEVELOPED)];
        if n == 6 {
            methods.extend([Method::flip(), Method::xpic(5)]);
        }
        list.push((channel::table_scene(n, 0.0, 0.4e-6), methods));
    }
    for law in laws::LAWS {
        for n in [3, 6, 12].into_iter().filter(|&n| n >= law.coarsest) {
            let scene = laws::scene(law, n, 0.0, 0.4e-6);
            list.push((scene, vec![short_steps(DEVELOPED)]));
        }
        let scene = laws::scene(law, 12, 0.5, 0.4e-6);
        list.push((scene, vec![short_steps(DEVELOPED)]));
    }
    for offset in OFFSETS {
        let methods = that_take(offset, main_methods(0.01));
        list.push((couette::scene(6, offset, 0.1, 3e-6), methods));
    }
    for n in [3, 12] {
        list.push((couette::scene(n, 0.0, 0.1, 3e-6), vec![short_steps(0.01)]));
    }
    list
}

fn lumens() -> Vec<Entry> {
    let mut list = Vec::new();
    for section in [Section::Square, Section::Round(2)] {
        for n in [3, 6, 7, 12] {
            let methods = if n == 6 || n == 7 {
                main_methods(DEVELOPED)
            } else {
                vec![short_steps(DEVELOPED)]
            };
            list.push((duct::scene(section, n, 2e-6), methods));
        }
    }
    for n in [6, 12] {
        let methods = if n == 6 {
            main_methods(DEVELOPED)
        } else {
            vec![short_steps(DEVELOPED)]
        };
        list.push((duct::scene(Section::Round(1), n, 2e-6), methods));
    }
    list
}

fn filling() -> Vec<Entry> {
    let mut list = Vec::new();
    for n in [3, 6, 12] {
        for offset in [[0.0, 0.0], [0.25, 0.0], [0.5, 0.0], [0.0, 0.5]] {
            let mut methods = that_take(offset[0], implicit());
            if n == 6 && offset[1] == 0.0 && offset[0] < 0.4 {
                methods.extend([Method::flip(), Method::xpic(5), Method::apic()]);
            }
            list.push((slit::scene(n, offset), methods));
        }
    }
    list.retain(|(_, methods)| !methods.is_empty());
    for section in [Section::Square, Section::Round(2)] {
        for n in [3, 6, 12] {
            let mut methods = implicit();
            // The explicit scheme takes tens of seconds here.
            if n == 6 && section == Section::Square {
                methods.extend([Method::flip(), Method::xpic(5)]);
            }
            list.push((piston::scene(section, n, Drive::Speed(0.5)), methods));
        }
    }
    for n in [3, 6, 12] {
        for offset in HALVES {
            list.push((washburn::scene(n, offset), implicit()));
        }
    }
    for section in [Section::Square, Section::Round(2)] {
        for n in [3, 6] {
            list.push((piston::scene(section, n, Drive::Pressure(1e6)), implicit()));
        }
    }
    for growth in [cure::Growth::Gel, cure::Growth::Table] {
        for n in [3, 6] {
            list.push((cure::slit_scene(n, growth), implicit()));
            list.push((cure::tube_scene(n, growth), implicit()));
        }
    }
    // Three cells let 30 % more through a tube, with or without loss of water.
    let slits = [3, 6, 12].map(water::slit_scene);
    for scene in slits.into_iter().chain([6, 12].map(water::tube_scene)) {
        list.push((scene, implicit()));
    }
    for n in [6, 12] {
        list.push((air::scene(n, None), implicit()));
        list.push((air::scene(n, Some(20.0)), implicit()));
    }
    list
}

fn menisci() -> Vec<Entry> {
    let mut list = Vec::new();
    for n in [3, 6, 12] {
        for offset in [[0.0, 0.0], [0.5, 0.0], [0.0, 0.5]] {
            list.push((wicking::slit_scene(n, offset, 60.0), implicit()));
        }
    }
    for degrees in [0.0, 120.0] {
        list.push((wicking::slit_scene(6, [0.0, 0.0], degrees), implicit()));
    }
    for degrees in [0.0, 60.0, 120.0] {
        list.push((wicking::tube_scene(6, degrees), implicit()));
    }
    for n in [6, 12] {
        for (offset, degrees) in [(0.0, 0.0), (0.0, 60.0), (0.5, 120.0)] {
            list.push((jurin::scene(n, offset, degrees), implicit()));
        }
    }
    list
}

fn arrays() -> Vec<Entry> {
    let mut list = Vec::new();
    for n in [8, 16, 24] {
        for which in 0..spheres::DRAG.len() {
            let mut methods = vec![short_steps(0.005)];
            // The explicit scheme takes minutes with 24 cells.
            if n < 24 {
                methods.extend([Method::flip(), Method::xpic(5)]);
            }
            list.push((spheres::scene(n, which), methods));
        }
    }
    for n in [24, 48] {
        list.push((grain::scene(n), vec![short_steps(0.02)]));
    }
    list
}

fn squeezing() -> Vec<Entry> {
    // The film takes a third of the time to come under pressure: its compression is resolved.
    let with = |explicit: bool| {
        let mut list = vec![short_steps(0.01)];
        if explicit {
            list.extend([Method::flip(), Method::xpic(5)]);
        }
        list
    };
    let mut list = Vec::new();
    for n in [2, 3, 6] {
        for offset in OFFSETS {
            list.push((squeeze::scene(n, offset), that_take(offset, with(n == 6))));
        }
    }
    for n in [2, 3, 6] {
        for offset in HALVES {
            list.push((disc::scene(8, n, offset), with(n == 3 && offset == 0.0)));
        }
    }
    for time in [1e-6, 1e-3, 1.0, 1e3] {
        list.push((stefan::scene(6, stefan::Load::Hold, time), implicit()));
    }
    list.push((stefan::scene(6, stefan::Load::Programme, 300.0), implicit()));
    list
}

fn liquids() -> Vec<Entry> {
    let with = |more: Method| {
        let mut list = Method::updates();
        list.push(more);
        list
    };
    vec![
        (tait::scene(), with(short_steps(0.05))),
        (acoustic::scene(0.001), Method::updates()),
        (acoustic::scene(0.5), Method::updates()),
        (column::scene(0.0, 6e-6), all_methods(0.01)),
        (column::scene(0.5, 6e-6), all_methods(0.01)),
        (taylor_green::scene(6, PF[2]), with(short_steps(0.001))),
        (taylor_green::scene(12, PF[2]), with(short_steps(0.001))),
        (taylor_green::scene(24, PF[2]), with(short_steps(0.001))),
        (taylor_green::scene(12, 0.05), with(short_steps(0.005))),
    ]
}

fn invariants() -> Vec<Entry> {
    let mut list = vec![(drop::scene(0.5e-6), Method::updates())];
    for law in ["stick", "partial-slip", "frictionless"] {
        list.push((galilean::scene(law, 0.5), all_methods(0.01)));
    }
    for voxels in [1, 2] {
        for offset in OFFSETS {
            let methods = vec![Method::flip(), Method::xpic(2), Method::implicit()];
            list.push((sealed::scene(voxels, offset), that_take(offset, methods)));
        }
    }
    list.push((
        clamp::scene(3.0),
        vec![Method::flip(), Method::xpic(5), Method::implicit()],
    ));
    list
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_are_unique_and_series_known() {
        let entries = all();
        let names: std::collections::HashSet<_> = entries.iter().map(|(s, _)| &s.name).collect();
        assert_eq!(names.len(), entries.len());
        assert_eq!(
            Scene::resolution("channel-n6-off0.25"),
            ("channel-off0.25".into(), Some(6))
        );
    }
}
