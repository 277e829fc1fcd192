//! Refused cases and their messages.

use crate::plan::{CASE, IMPLICIT, plan};

const POWER: &str = "power_law = { consistency = \"1 Pa s^n\", index = 0.5, rates = [\"1 1/s\", \"1e6 1/s\"] }\nviscosity =";
const HERSCHEL: &str = "herschel_bulkley = { yield_stress = \"50 Pa\", consistency = \"10 Pa s^n\", index = 1.2, regularisation_rate = \"1 1/s\" }";
const GEL: &str = "[adhesive.cure]\ngel_time = \"1 s\"\nexponent = 2.0\n[contact]";
const WATER: &str = "[adhesive.water]\nsolids = 0.45\nuptake = \"1 um/s\"\ndiffusivity = \"1e-10 m2/s\"\nviscosity_by_solids = [[0.45, 1.0], [0.6, 30.0]]\n[contact]";
const HEATED: &str = "[adhesive.cure]\ngel_time = \"1 s\"\nexponent = 2.0\nactivation_energy = \"80 kJ/mol\"\n[contact]";

/// A ridge of the floor, beside the plate and on its way down to the floor.
const RIDGE: (&str, &str) = (
    "[boundary]",
    "[[body]]\nmaterial = \"rigid\"\nbox = { min = [\"0 um\", \"4 um\", \"0 um\"], max = [\"2 um\", \"8 um\", \"8 um\"] }\n[boundary]",
);

type Refused = (
    &'static [(&'static str, &'static str)],
    &'static [&'static str],
    &'static str,
);

/// One case per line: replaced parts of [`CASE`], changed keys, and words of the message.
#[rustfmt::skip]
const REFUSED: &[Refused] = &[
    (&[], &["grid.cell=1e-5 um"], "cells long"),
    (&[], &["grid.cell=2 voxels"], "[[body]] tables have none: give a length"),
    (&[("\"explicit\"", "\"implicit\"")], &[], "velocity_update is for scheme = \"explicit\""),
    (&[("influence_length = \"0.01 cell\"", "")], &[], "needs influence_length"),
    (&[("[contact]\nlaw = \"partial-slip\"\ninfluence_length = \"0.01 cell\"\n", "")], &[], "[contact] law is needed"),
    (&[("viscosity = \"300 cP\"\n", "")], &[], "needs viscosity"),
    (&[("viscosity =", POWER)], &[], "more than one of viscosity,"),
    (&[("viscosity = \"300 cP\"", HERSCHEL)], &[], "[adhesive] Herschel-Bulkley: index = 1.2 is not accepted"),
    (&[("[contact]", GEL)], &[], "[adhesive.cure] is for scheme"),
    (&[("[contact]", WATER)], &[], "[adhesive.water] is for scheme"),
    (&[IMPLICIT[0], IMPLICIT[1], ("[contact]", WATER)], &["adhesive.water.limit=0.9"], "[adhesive.water] limit = 0.9 is not accepted"),
    (&[IMPLICIT[0], IMPLICIT[1], ("[contact]", WATER)], &["adhesive.water.walls=[\"nobody\"]"], "[adhesive.water] walls: there is no rigid body 'nobody'"),
    (&[IMPLICIT[0], IMPLICIT[1], ("[contact]", HEATED)], &[], "temperature, reference_temperature and activation_energy"),
    (&[("travel = \"3 um\"\n", "")], &[], "travel"),
    (&[IMPLICIT[0], IMPLICIT[1], RIDGE], &["clamp.travel=4 um", "body.2.box.min.0=4 um"], "meet after 2.0000 um"),
    (&[IMPLICIT[0], IMPLICIT[1], ("[contact]", HEATED)], &["adhesive.cure.reference_temperature=1400 C"], "a temperature up to 1000 K"),
    (&[], &["grid.dimensions=2", "boundary.z=open"], "plane strain"),
    (&[("velocity = \"clamp\"\n", "")], &[], "[clamp] has nothing to move"),
    (&[], &["body.3.box.min.1=0.5 m"], "'3' is not an index of an array of 3 (counted from 0)"),
    (&[], &["body.0.box.min.3=0.5 m"], "there is no '3' to set"),
    (&[], &["clamp.stage.0.speed=1 m/s"], "the case has no entry '0' there to change"),
    (&[], &["clamp.stage.0=1"], "there is no '0' to set"),
    (&[("[\"16 um\", \"10 um\"", "[\"21 um\", \"10 um\"")], &["grid.cell=1 um"], "out of the domain"),
];

#[test]
fn what_contradicts_itself_is_refused() {
    for (replaced, changes, sentence) in REFUSED {
        match plan(replaced, changes) {
            Ok(said) => panic!("{replaced:?} {changes:?} is accepted:\n{said}"),
            Err(said) => assert!(said.contains(sentence), "{replaced:?} {changes:?}: {said}"),
        }
    }
}

/// The plate of [`CASE`] stands 6 um above the floor, and sound is 912.9 m/s fast.
#[test]
fn bodies_that_would_meet_or_outrun_sound_are_refused() {
    let unlimited = ("max_pressure = \"2.5 MPa\"\n", "");
    let low = ("[\"16 um\", \"10 um\"", "[\"16 um\", \"6 um\"");
    let into_wall = "meets 'wall' after 6.0000 um";
    let riser = "[[body]]\nmaterial = \"rigid\"\nname = \"riser\"\nvelocity = [\"0 m/s\", \"1 m/s\", \"0 m/s\"]\nbox = { min = [\"18 um\", \"5 um\", \"0 um\"], max = [\"20 um\", \"9 um\", \"8 um\"] }\n[boundary]";
    let riser = ("[boundary]", riser);
    let adhesive = "material = \"adhesive\"\n";
    let thrown = format!("{adhesive}velocity = [\"0 m/s\", \"-913 m/s\", \"0 m/s\"]\n");
    let thrown = (adhesive, thrown.as_str());
    let clamp = &CASE[CASE.find("[clamp]").unwrap()..CASE.find("[integrator]").unwrap()];
    let stop = (clamp, "[stop]\ntime = \"0.3 us\"\n");
    let free = [-20, -21, 913].map(|v| format!("velocity = [\"0 m/s\", \"{v} m/s\", \"0 m/s\"]\n"));
    let [slow, meets, fast] = free
        .each_ref()
        .map(|to| ("velocity = \"clamp\"\n", to.as_str()));
    for (replaced, change, wanted) in [
        (&[unlimited][..], "clamp.travel=6 um", ""),
        (&[unlimited], "clamp.travel=7 um", into_wall),
        (&[], "clamp.travel=7 um", into_wall),
        // If a pressure limit may hold the clamp first, the run itself checks its travel.
        (&[], "clamp.stop=3.5 us", ""),
        (&[riser], "grid.dimensions=3", "'riser' of given"),
        (&[low], "clamp.travel=3 um", ""),
        (&[low], "clamp.travel=1 um", "nothing would be pressed"),
        (&[], "clamp.closing_speed=913 m/s", "_speed is 9.1300e2"),
        (&[thrown], "grid.dimensions=3", "of an adhesive body is"),
        // 0.3 us at 20 m/s take it to the floor, and at 21 m/s into it.
        (&[slow, stop], "grid.dimensions=3", ""),
        (&[meets, stop], "grid.dimensions=3", "from 2.8571e-7 s on"),
        (&[fast, stop], "grid.dimensions=3", "of a rigid body is"),
    ] {
        match plan(replaced, &[change]) {
            Ok(said) => assert_eq!(wanted, "", "{replaced:?} {change} is accepted:\n{said}"),
            Err(said) if wanted.is_empty() => panic!("{change}: {said}"),
            Err(said) => assert!(said.contains(wanted), "{change}: {said}"),
        }
    }
}
