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

/// Wood with a lumen over the whole height: 12 layers of room.
fn through(x: usize, _: usize, _: usize) -> u8 {
    if (4..10).contains(&x) { VOID } else { WOOD }
}

/// The bond of a stack, and what was said of it.
fn bench(label: impl Fn(usize, usize, usize) -> u8, options: &str) -> (Workbench, String) {
    let bench = Workbench::with_bond();
    bench.write("stack.npy", npy([16, 32, 16], label));
    let labels = "--labels void=0,wood=128,adhesive=255";
    bench.done(&format!(
        "xct2particles -q stack.npy --voxel 1.45um {labels} -o stack.mpts"
    ));
    let said = bench.ends(
        0,
        &format!("build-bondline stack.mpts {options} -o bond.mpts"),
        "",
    );
    (bench, said)
}

/// Four of six layers of 1.45 um stay in the gap. Once nothing said so, and three times the time was advised.
#[test]
fn a_press_without_room_says_so_before_and_after() {
    let room = "room for 33 % of the adhesive: at least 5.8 um of the gap will remain";
    let (bench, said) = bench(shut, "");
    assert!(said.contains(room), "{said}");
    let explain = format!("{} --explain", press("run", &[IMPLICIT], ""));
    let plan = bench.done(&explain);
    assert!(plan.contains(room), "{plan}");
    let open = bench.done(&format!("{explain} --set boundary.x=open"));
    assert!(!open.contains("room for"), "{open}");
    let said = bench.ends(0, &press("run", &[IMPLICIT], "").replace("-q ", ""), FULL);
    assert!(said.contains(room), "{said}");
    assert!((bench.summary("run", "gap_m") - 5.8e-6).abs() < 0.05e-6);
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
    let (bench, said) = bench(through, "--plane 23.2um --slab 5.8um");
    assert!(said.contains("room for 300 % of the adhesive"), "{said}");
    bench.press("run", &[IMPLICIT, "clamp.time_limit=0.4 us"], "");
    bench.done("wp-metrics run/final.mpts --pressure -o run/wp.csv");
    let table = bench.done("bond-figures table2 --run pf:implicit=run/wp.csv -o table2.csv");
    let limit = table.split("--set \"").nth(1).unwrap();
    let limit = limit.split('"').next().unwrap();
    bench.press("longer", &[IMPLICIT, limit], "");
    assert_eq!(bench.summary("longer", "gap_m"), 0.0);
    let rows = bench.measured("run/final.mpts longer/final.mpts");
    let [shares, depths] = ["entered_share", "mean_depth_um"].map(|name| rows.column(name));
    assert!(
        shares[2] < 0.6 * shares[5] && depths[2] < depths[5],
        "{shares:?} {depths:?}"
    );
}
