//! Cost of the saddle-point solver on synthetic wood.
//!
//! ```text
//! cargo run --release -p saddle-point --example solver_bench -- [tolerance [nx,ny,nz,gap ...]]
//! RAYON_NUM_THREADS=1 cargo run ...
//! ... 1e-3 32,48,48,12 64,56,64,12 128,56,128,19 128,72,200,19   # 38k, 96k, 0.54 M, 0.86 M cells
//! ```

#![allow(clippy::print_stdout, reason = "prints for developers")]

#[path = "../tests/pseudo_wood/mod.rs"]
mod pseudo_wood;

use std::error::Error;
use std::time::Instant;

use pseudo_wood::{Case, Problem};
use saddle_point::{SaddleOptions, SaddleReport, SaddleSolver};

fn main() -> Result<(), Box<dyn Error>> {
    let mut arguments = std::env::args().skip(1);
    let tolerance = arguments.next().map_or(Ok(1e-4), |text| text.parse())?;
    let mut sizes: Vec<String> = arguments.collect();
    if sizes.is_empty() {
        sizes = ["32,48,48,12", "64,56,64,12"].map(str::to_owned).into();
    }
    println!("threads {}", rayon::current_num_threads());
    println!(
        "{:>8} {:>8} {:>14} {:>7} {:>7} {:>7} {:>6}",
        "cells", "faces", "its 1e-2/3/4", "wall_s", "cpu_s", "MiB", "bound"
    );
    for size in sizes {
        let numbers = size
            .split(',')
            .map(str::parse)
            .collect::<Result<Vec<usize>, _>>()?;
        let [x, y, z, gap] = numbers[..] else {
            return Err(format!("size {size}; nx,ny,nz,gap expected").into());
        };
        let cells = [x, y, z];
        row(
            Case {
                cells,
                gap,
                ..Case::default()
            },
            tolerance,
        )?;
    }
    Ok(())
}

fn row(case: Case, tolerance: f64) -> Result<(), Box<dyn Error>> {
    let problem = Problem::new(&case)?;
    let (mut u, mut p) = problem.rest();
    let solver = SaddleSolver::new(SaddleOptions {
        tolerance,
        ..SaddleOptions::default()
    });
    let cpu_seconds = || machine::cpu_seconds().unwrap_or(f64::NAN);
    let (started, cpu) = (Instant::now(), cpu_seconds());
    let report = solver.solve(&problem.system(), &mut u, &mut p)?;
    let (wall, cpu) = (started.elapsed().as_secs_f64(), cpu_seconds() - cpu);
    println!(
        "{:8} {:8} {:>14} {:7.2} {:7.2} {:7} {:6.3}",
        p.len(),
        u.len(),
        iterations(&report),
        wall,
        cpu,
        machine::peak_memory_bytes().unwrap_or(0) >> 20,
        report.eigenvalue_bound,
    );
    Ok(())
}

/// Iterations to 1e-2, 1e-3 and 1e-4, where reached.
fn iterations(report: &SaddleReport) -> String {
    let to = |tolerance: f64| {
        (report.history.iter().position(|&r| r <= tolerance))
            .map_or("-".to_owned(), |n| n.to_string())
    };
    format!("{}/{}/{}", to(1e-2), to(1e-3), to(1e-4))
}
