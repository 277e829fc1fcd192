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
type Entry = (Scene, Vec<Method>);

/// Courant number of flows that develop in a lumen: four steps and more from rest to the end.
const DEVELOPED: f64 = 0.001;

/// Offsets of walls from the nodes, cells.
const OFFSETS: [f64; 4] = [0.0, 0.25, 0.5, 0.75];

/// Those that the implicit scheme takes: walls on faces of cells and half way between.
const HALVES: [f64; 2] = [0.0, 0.5];

/// The methods that take walls at `offset` cells from the nodes.
fn that_take(offset: f64, mut methods: Vec<Method>) -> Vec<Method> {
    methods.retain(|m| m.scheme != Scheme::Implicit || HALVES.contains(&offset));
    methods
}

/// The implicit scheme with steps short enough for what happens between rest and steady flow:
/// at the usual Courant number the first step is as long as the whole run, and its backward Euler
/// error does not fall with the cells.
fn short_steps(cfl: f64) -> Vec<Method> {
    vec![Method::implicit().setting(format!("integrator.cfl={cfl}"))]
}

/// What the paper ran.
fn paper() -> Vec<Method> {
    vec![Method::flip(), Method::xpic(5)]
}

/// What the paper ran, and the implicit scheme at a Courant number.
fn main_methods(cfl: f64) -> Vec<Method> {
    [paper(), short_steps(cfl)].concat()
}

/// Every update, and the implicit scheme at a Courant number.
fn all_methods(cfl: f64) -> Vec<Method> {
    [Method::updates(), short_steps(cfl)].concat()
}

/// The scenes in the order of docs/methods.md section 5.1.
pub(super) fn all() -> Vec<Entry> {
    let mut list = Vec::new();
    films(&mut list);
    channels(&mut list);
    lumens(&mut list);
    filling(&mut list);
    menisci(&mut list);
    arrays(&mut list);
    squeezing(&mut list);
    liquids(&mut list);
    invariants(&mut list);
    list
}

fn films(list: &mut Vec<Entry>) {
    /// Six steps and more from rest to the end.
    const FILM: f64 = 1e-4;
    const SHORT: f64 = 0.1 * incline::PAPER_TIME;
    for offset in OFFSETS {
        let until = match offset {
            0.0 => incline::PAPER_TIME,
            _ => SHORT,
        };
        let methods = that_take(offset, main_methods(FILM));
        list.push((incline::scene(6, offset, until), methods));
    }
    for n in [3, 12] {
        list.extend(HALVES.map(|offset| (incline::scene(n, offset, SHORT), short_steps(FILM))));
    }
}

fn channels(list: &mut Vec<Entry>) {
    for n in [3, 6, 12] {
        for offset in OFFSETS.into_iter().chain([0.95]) {
            let methods = match n {
                6 => all_methods(DEVELOPED),
                _ => [vec![Method::xpic(5)], short_steps(DEVELOPED)].concat(),
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
        let mut methods = short_steps(DEVELOPED);
        if n == 6 {
            methods.extend(paper());
        }
        list.push((laws::scene(laws::TABLE, n, 0.0, 0.4e-6), methods));
    }
    for law in laws::LAWS {
        for (n, offset) in [(3, 0.0), (6, 0.0), (12, 0.0), (12, 0.5)] {
            if n >= law.coarsest {
                let scene = laws::scene(law, n, offset, 0.4e-6);
                list.push((scene, short_steps(DEVELOPED)));
            }
        }
    }
    for offset in OFFSETS {
        let methods = that_take(offset, main_methods(0.01));
        list.push((couette::scene(6, offset, 0.1, 3e-6), methods));
    }
    list.extend([3, 12].map(|n| (couette::scene(n, 0.0, 0.1, 3e-6), short_steps(0.01))));
}

fn lumens(list: &mut Vec<Entry>) {
    for (section, cells) in [
        (Section::Square, &[3, 6, 7, 12][..]),
        (Section::Round(2), &[3, 6, 7, 12]),
        (Section::Round(1), &[6, 12]),
    ] {
        for &n in cells {
            let methods = match n {
                6 | 7 => main_methods(DEVELOPED),
                _ => short_steps(DEVELOPED),
            };
            list.push((duct::scene(section, n, 2e-6), methods));
        }
    }
}

fn filling(list: &mut Vec<Entry>) {
    // As a user has it.
    let implicit = || vec![Method::implicit()];
    for n in [3, 6, 12] {
        for offset in [[0.0, 0.0], [0.25, 0.0], [0.5, 0.0], [0.0, 0.5]] {
            let mut methods = that_take(offset[0], implicit());
            if n == 6 && offset[1] == 0.0 && offset[0] < 0.4 {
                methods.extend([paper(), vec![Method::apic()]].concat());
            }
            if !methods.is_empty() {
                list.push((slit::scene(n, offset), methods));
            }
        }
    }
    for section in [Section::Square, Section::Round(2)] {
        for n in [3, 6, 12] {
            let mut methods = implicit();
            // The explicit scheme takes tens of seconds here.
            if n == 6 && section == Section::Square {
                methods.extend(paper());
            }
            list.push((piston::scene(section, n, Drive::Speed(0.5)), methods));
        }
    }
    let mut add = |scene| list.push((scene, implicit()));
    for n in [3, 6, 12] {
        for offset in HALVES {
            add(washburn::scene(n, offset));
        }
    }
    for section in [Section::Square, Section::Round(2)] {
        for n in [3, 6] {
            add(piston::scene(section, n, Drive::Pressure(1e6)));
        }
    }
    for growth in [cure::GEL, cure::TABLE] {
        for n in [3, 6] {
            add(cure::slit_scene(n, growth));
            add(cure::tube_scene(n, growth));
        }
    }
    for n in [3, 6, 12] {
        add(water::slit_scene(n));
    }
    // Three cells let 30 % more through a tube, with or without loss of water.
    for n in [6, 12] {
        add(water::tube_scene(n));
    }
    for n in [6, 12] {
        for leak_time in [None, Some(20.0)] {
            add(air::scene(n, leak_time));
        }
    }
}

fn menisci(list: &mut Vec<Entry>) {
    let mut add = |scene| list.push((scene, vec![Method::implicit()]));
    for n in [3, 6, 12] {
        for offset in [[0.0, 0.0], [0.5, 0.0], [0.0, 0.5]] {
            add(wicking::slit_scene(n, offset, 60.0, 0.0));
        }
    }
    for degrees in [0.0, 120.0] {
        add(wicking::slit_scene(6, [0.0, 0.0], degrees, 0.0));
    }
    for degrees in [0.0, 60.0, 120.0] {
        add(wicking::tube_scene(Section::Round(2), 6, 1.5, degrees, 0.0));
    }
    for n in [6, 12] {
        for (offset, degrees) in [(0.0, 0.0), (0.0, 60.0), (0.5, 120.0)] {
            add(jurin::scene(n, offset, degrees));
        }
    }
}

fn arrays(list: &mut Vec<Entry>) {
    for n in [8, 16, 24] {
        for drag in spheres::DRAG {
            let mut methods = short_steps(0.005);
            // The explicit scheme takes minutes with 24 cells.
            if n < 24 {
                methods.extend(paper());
            }
            list.push((spheres::scene(n, drag), methods));
        }
    }
    list.extend([24, 48].map(|n| (grain::scene(n), short_steps(0.02))));
}

fn squeezing(list: &mut Vec<Entry>) {
    // The film takes a third of the time to come under pressure: its compression is resolved.
    let with = |explicit: bool| match explicit {
        true => [short_steps(0.01), paper()].concat(),
        false => short_steps(0.01),
    };
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
    let holds = [1e-6, 1e-3, 1.0, 1e3].map(|time| (stefan::Load::Hold, time));
    for (load, time) in holds.into_iter().chain([(stefan::Load::Programme, 300.0)]) {
        list.push((stefan::scene(6, load, time), vec![Method::implicit()]));
    }
}

fn liquids(list: &mut Vec<Entry>) {
    list.push((tait::scene(), all_methods(0.05)));
    list.extend([0.001, 0.5].map(|eta| (acoustic::scene(eta), Method::updates())));
    list.extend([0.0, 0.5].map(|offset| (column::scene(offset, 6e-6), all_methods(0.01))));
    for (n, eta, cfl) in [
        (6, PF[2], 0.001),
        (12, PF[2], 0.001),
        (24, PF[2], 0.001),
        (12, 0.05, 0.005),
    ] {
        list.push((taylor_green::scene(n, eta), all_methods(cfl)));
    }
}

fn invariants(list: &mut Vec<Entry>) {
    list.push((drop::scene(0.5e-6), Method::updates()));
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
        [paper(), vec![Method::implicit()]].concat(),
    ));
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_are_unique_and_series_known() {
        let entries = all();
        let names: std::collections::HashSet<_> = entries.iter().map(|(s, _)| &s.name).collect();
        assert_eq!(names.len(), entries.len());
        let series = Scene::resolution("channel-n6-off0.25");
        assert_eq!(series, ("channel-off0.25".into(), Some(6)));
    }
}
