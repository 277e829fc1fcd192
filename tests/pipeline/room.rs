//! Presses whose adhesive has no room in the wood, and presses that were cut short.

use crate::workbench::{ADHESIVE, IMPLICIT, VOID, WOOD, Workbench, npy, press};

const FULL: &str =
    "every lumen that the adhesive can reach is full: a longer press changes nothing";

/// Two layers of adhesive, and twice four in lumens without a way to them: six in all, for which those two layers have room.
fn shut(x: usize, y: usize, _: usize) -> u8 {
    match y {
        15..17 => ADHESIVE,
        3..11 | 21..29 if (4..8).contains(&x) => ADHESIVE,
        _ => WOOD,
    }
}

/// A lumen that opens to the bond, two layers of room; one that leads to it across the side alone, two layers; a sealed one.
fn pockets(x: usize, y: usize, _: usize) -> u8 {
    match (x, y) {
        (0..4, 8..16) | (12..16, 6..14) | (2..14, 18..30) => VOID,
        _ => WOOD,
    }
}

const LABELS: &str = "--voxel 1.45um --labels void=0,wood=128,adhesive=255";

/// The bond of a stack, and what was said of it.
fn bench(stack: Vec<u8>, options: &str) -> (Workbench, String) {
    let bench = Workbench::with_bond();
    bench.write("stack.npy", stack);
    bench.done(&format!(
        "xct2particles -q stack.npy {LABELS} -o stack.mpts"
    ));
    let build = format!("build-bondline stack.mpts {options} -o bond.mpts");
    let said = bench.ends(0, &build, "");
    (bench, said)
}

/// Four of six layers of 1.45 um stay in the gap. Once nothing said so, and three times the time was advised.
#[test]
fn a_press_without_room_says_so_before_and_after() {
    let room = "room for 33 % of the adhesive: at least 5.8 um of the gap will remain";
    let (bench, said) = bench(npy([16, 32, 16], shut), "");
    assert!(said.contains(room), "{said}");
    let slow = [IMPLICIT, "clamp.closing_speed=1 m/s"];
    let explain = format!("{} --explain", press("run", &slow, ""));
    let plan = bench.done(&explain);
    assert!(plan.contains(room), "{plan}");
    let open = bench.done(&format!("{explain} --set boundary.x=open"));
    assert!(!open.contains("room for"), "{open}");
    let said = bench.ends(0, &press("run", &slow, "").replace("-q ", ""), FULL);
    assert!(said.contains(room), "{said}");
    assert!((bench.summary("run", "gap_m") - 5.655e-6).abs() < 0.05e-6);
    bench.done("wp-metrics run/final.mpts --pressure -o run/wp.csv");
    let table = bench.done("bond-figures table2 --run pf:implicit=run/wp.csv -o table2.csv");
    bench.done("bond-report --run run -o page.html");
    for told in [table, bench.text("page.html")] {
        assert!(told.contains(room) && told.contains(FULL), "{told}");
        assert!(!told.contains("time_limit=\""), "{told}");
    }
}

/// A press that was cut short closes within the time that it is advised; all of its adhesive is then in the wood.
#[test]
fn the_time_that_is_advised_would_do() {
    let case = include_str!("../../pipelines/cases/pf-implicit.toml");
    let specimen = "--adhesive pf --size 40x96x40 --slab 14.5um --seed 1";
    let bench = Workbench::with_wood(specimen, case);
    let pressure = "clamp.max_pressure=0.3 MPa";
    bench.press("run", &[pressure, "clamp.time_limit=5 us"], "");
    bench.done("wp-metrics run/final.mpts --pressure -o run/wp.csv");
    let table = bench.done("bond-figures table2 --run pf:implicit=run/wp.csv -o table2.csv");
    let limit = table.split("--set \"").nth(1).unwrap();
    let limit = limit.split('"').next().unwrap();
    bench.press("longer", &[pressure, limit], "");
    assert_eq!(bench.summary("longer", "gap_m"), 0.0);
    let rows = bench.measured("run/final.mpts longer/final.mpts");
    let [shares, depths] = ["entered_share", "mean_depth_um"].map(|name| rows.column(name));
    assert!(
        shares[2] < 0.3 && shares[5] > 0.7 && depths[2] < depths[5],
        "{shares:?} {depths:?}"
    );
}

/// Voids count that are connected through faces of voxels, by the sides of the case, along any normal.
#[test]
fn the_room_is_that_of_the_voids_that_can_be_reached() {
    let along_y = npy([16, 32, 16], pockets);
    let along_x = npy([32, 16, 16], |x, y, z| pockets(y, x, z));
    for (stack, normal) in [(along_y, "y"), (along_x, "x")] {
        let options = format!("--normal {normal} --plane 23.2um --slab 11.6um");
        let (bench, said) = bench(stack, &options);
        let quarter = "room for 25 % of the adhesive: at least 8.7 um of the gap will remain";
        assert!(said.contains(quarter), "{said}");
        for (sides, told) in [
            ("x=\"symmetry\"", Some(quarter)),
            ("y=\"open\"", Some(quarter)),
            (
                "x=\"periodic\"",
                Some("room for 50 % of the adhesive: at least 5.8 um of the gap will remain"),
            ),
            ("x=\"open\"", None),
            ("z=\"open\"", None),
        ] {
            for scheme in [IMPLICIT, "integrator.scheme=explicit"] {
                let explain = press("run", &[scheme, &format!("boundary.{sides}")], "--explain");
                let plan = bench.done(&explain);
                assert!(
                    told.is_none_or(|told| plan.contains(told)),
                    "{sides}: {plan}"
                );
                assert_eq!(plan.contains("room for"), told.is_some(), "{sides}: {plan}");
            }
        }
    }
}

/// Of a slab, with half of the columns full to eight layers below it and an eighth to two above, 4 and 0.25 layers have
/// entered, 4 and 1 layers deep on average, however thick the slab and wherever depths are measured from.
#[test]
fn adhesive_in_lumens_has_entered_whatever_the_slab() {
    let bench = Workbench::with_bond();
    for (slab, reference) in [(4, "mid"), (12, "mid"), (12, "plane=20um"), (4, "adherend")] {
        let label = |x: usize, y: usize, _: usize| match y {
            12..20 if x.is_multiple_of(2) => ADHESIVE,
            y if (20..20 + slab).contains(&y) => ADHESIVE,
            y if (20..22 + slab).contains(&y) && x == 1 => ADHESIVE,
            _ => WOOD,
        };
        bench.write("slab.npy", npy([8, 60, 8], label));
        let found = bench.measured(&format!("slab.npy {LABELS} --reference {reference}"));
        let columns = ["entered_share", "mean_depth_um"].map(|name| found.column(name));
        let all = slab as f64 + 4.25;
        let shares = [4.0, 0.25, 4.25].map(|volume| volume / all);
        let depths = [4.0, 1.0, 16.25 / 4.25].map(|layers| 1.45 * layers);
        for (found, wanted) in columns
            .iter()
            .flatten()
            .zip([shares, depths].as_flattened())
        {
            assert!((found - wanted).abs() < 2e-6, "{slab}: {columns:?}");
        }
        assert_eq!(found.header[11..], ["entered_share", "mean_depth_um"]);
    }
}

/// WP of slabs that did not close fell with penetration, and only those that ended at a time limit had rings.
#[test]
fn a_sweep_draws_what_grows_with_penetration_and_rings_what_is_open() {
    let bench = Workbench::new();
    bench.write(
        "t.csv",
        "row,mu_cP,status,end,wp_um,entered_share,mean_depth_um,gap_share\n\
         1,200,sound,time-limit,20.38,0.35,7.5,0.38\n2,900,sound,programme,20.5,0.2,5,0.41\n\
         3,5000,sound,programme,20.6,0,NaN,0\n",
    );
    for (options, drawn, axes) in [
        ("", true, ["entered share", "mean depth"]),
        ("--result wp_um", false, ["WP", "WP"]),
    ] {
        bench.done(&format!("bond-figures response t.csv {options} -o r.svg"));
        let figure = bench.text("r.svg");
        assert!(figure.contains("rings: 2 did not close"), "{figure}");
        assert!(axes.iter().all(|axis| figure.contains(axis)), "{figure}");
        assert_eq!(figure.contains("entered share"), drawn);
    }
}
