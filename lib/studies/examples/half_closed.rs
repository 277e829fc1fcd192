//! Puts an explicit run that has just begun where another run of its bond has come to, so that what its steps cost
//! there can be measured without taking all steps on the way:
//!
//! ```text
//! half_closed BOND STATE RUNDIR
//! ```
//!
//! STATE is a snapshot or final state of any run of BOND, whose normal is y; RUNDIR holds the checkpoint, which is
//! replaced, of an explicit run by FLIP, PIC, XPIC or FMPM without density projection. Points take place, velocity
//! and volume of the state, and have no stress until the next step. `mpm-run --resume` goes on from there.
#![allow(clippy::print_stdout, reason = "prints for developers")]

use std::error::Error;
use std::fs::{self, File};
use std::io::BufWriter;
use std::path::PathBuf;

use particle_file::{Draft, Header, ParticleFile};

fn main() -> Result<(), Box<dyn Error>> {
    let paths: Vec<PathBuf> = std::env::args_os().skip(1).map(PathBuf::from).collect();
    let [bond, state, folder] = &paths[..] else {
        return Err("usage: half_closed BOND STATE RUNDIR".into());
    };
    let (bond, state) = (ParticleFile::open(bond)?, ParticleFile::open(state)?);
    let path = folder.join("checkpoint.mpts");
    let checkpoint = ParticleFile::open(&path)?;
    let travel = number(bond.header(), "gap_m")? - number(state.header(), "gap_m")?;
    let time = state.header().time_s;

    let ids = checkpoint.column::<u32>("id")?;
    let points = Points::of(&state, ids, checkpoint.column("place")?)?;
    let replaced = |name: &str, values: &[(usize, f64)]| -> Result<Vec<f64>, Box<dyn Error>> {
        let mut array = checkpoint.column::<f64>(name)?.to_vec();
        values.iter().for_each(|&(at, value)| array[at] = value);
        Ok(array)
    };
    let run_clock = replaced("run.clock", &[(0, time), (1, travel), (2, time)])?;
    let last = replaced("run.last_step", &[(2, travel)])?;
    let clock = replaced("clock", &[(0, time), (1, travel)])?;
    let displacement = replaced("displacement", &[(4, -travel)])?;
    let stress = vec![0.0_f32; 8 * ids.len()];

    let mut header = checkpoint.header().clone();
    header.time_s = time;
    let draft = Draft::new(header)
        .column("run.clock", 1, &run_clock)
        .column("run.last_step", 1, &last)
        .column("run.courant", 1, checkpoint.column::<f64>("run.courant")?)
        .column("id", 1, ids)
        .column("node", 1, &points.node)
        .column("place", 1, &points.place)
        .column("motion", 1, &points.motion)
        .column("stress", 1, &stress)
        .column("clock", 1, &clock)
        .column("counts", 1, checkpoint.column::<u32>("counts")?)
        .column("displacement", 1, &displacement);
    let moved = folder.join("checkpoint.moved");
    draft.write_to(&mut BufWriter::new(File::create(&moved)?))?;
    fs::rename(moved, path)?;
    let (us, um) = (1e6 * time, 1e6 * travel);
    println!("{} points at {us:.3} us, {um:.3} um of travel", ids.len());
    Ok(())
}

fn number(header: &Header, name: &str) -> Result<f64, Box<dyn Error>> {
    let text = header.attribute(name).ok_or(format!("no {name}"))?;
    Ok(text.parse()?)
}

/// Arrays of the explicit scheme's checkpoint.
#[derive(Default)]
struct Points {
    node: Vec<u32>,
    place: Vec<f32>,
    motion: Vec<f32>,
}

impl Points {
    /// Those of `state` in the order of `ids`, with the volumes at rest (cells) of `place`.
    fn of(state: &ParticleFile, ids: &[u32], place: &[f32]) -> Result<Self, Box<dyn Error>> {
        let cell = number(state.header(), "cell_m")?;
        let low = state.header().box_min_m;
        let (position, volume) = state.liquid()?;
        let velocity = state.column::<f32>("velocity")?;
        let known = |id: &u32| (*id as usize) < position.len();
        if position.len() != ids.len() || !ids.iter().all(known) {
            return Err("the state has lost points, or is of another bond".into());
        }
        let mut points = Self::default();
        for (&id, place) in ids.iter().zip(place.chunks_exact(4)) {
            let id = id as usize;
            for a in 0..3 {
                let at = (f64::from(position[id][a]) - low[a]) / cell;
                let node = at.round().max(0.0);
                points.node.push(node as u32);
                points.place.push((at - node) as f32);
            }
            points.place.push(place[3]);
            let at_rest = cell.powi(3) * f64::from(place[3]);
            let change = f64::from(volume[id]) / at_rest - 1.0;
            let v = &velocity[3 * id..3 * id + 3];
            points.motion.extend([v[0], v[1], v[2], change as f32]);
        }
        Ok(points)
    }
}
