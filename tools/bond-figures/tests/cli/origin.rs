//! Tables whose states are others now.

use crate::workbench::Bench;

#[test]
fn what_was_made_of_other_states_is_refused_and_what_is_not_known_is_not() {
    let bench = Bench::new(env!("CARGO_BIN_EXE_bond-figures"));
    let text = "file,diameter_um,volume_fraction,up_to_fraction\na,1,0.5,0.5\na,2,0.5,1\n";
    bench.write("t.csv", text);
    let draw = || bench.run("pores t.csv -o -");
    draw().done();
    let made = |of: &[(&str, &str)]| {
        let input = |(path, text): &(&str, &str)| {
            let hash = cli::hash_reader(text.as_bytes()).unwrap();
            format!(r#"{{"path": "{path}", "xxh3": "{hash:016x}"}}"#)
        };
        let inputs: Vec<String> = of.iter().map(input).collect();
        let record = format!(
            r#"{{"tool": "shear-stats", "inputs": [{}]}}"#,
            inputs.join(", ")
        );
        bench.write("t.csv.provenance.json", record);
        draw()
    };
    for folder in ["snapshots", "fine"] {
        std::fs::create_dir(bench.path(folder)).unwrap();
    }
    bench.write("final.mpts", "new");
    bench.write("snapshots/0001.mpts", "one");
    bench.write("fine/final.mpts", "fine");
    for marked in [false, true] {
        made(&[("run/final.mpts", "new"), ("gone.mpts", "x")]).done();
        made(&[("fine/final.mpts", "fine"), ("run/final.mpts", "new")]).done();
        made(&[("run/snapshots/0001.mpts", "one")]).done();
        // What a run's folder has is of another run, which still has the state.
        let other = made(&[("fine/final.mpts", "fine")]);
        match marked {
            true => other.refused(3, "'t.csv' does not belong to the present 'final.mpts'"),
            false => other.done(),
        };
        for stale in [
            &[("run/final.mpts", "old")][..],
            &[("snapshots/0001.mpts", "old")],
            &[("fine/final.mpts", "old"), ("run/final.mpts", "new")],
        ] {
            made(stale).refused(3, ": run shear-stats again");
        }
        bench.write(particle_file::RUN_MARK, "");
    }
}
