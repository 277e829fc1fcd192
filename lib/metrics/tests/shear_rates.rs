//! Shear-rate statistics of snapshots.

use metrics::{Convention, ShearRates, tube_shear_rate};
use particle_file::{Draft, Header, Kind, ParticleFile};

fn snapshot(rates: &[f32], volumes: &[f32], convention: Option<&str>) -> ParticleFile {
    let mut header = Header::new(Kind::State, 1e-6, 1, [0.0; 3], [1e-6; 3]);
    header.time_s = 2.5e-5;
    if let Some(convention) = convention {
        header.set_attribute("shear_rate_convention", convention);
    }
    let mut bytes = Vec::new();
    Draft::new(header)
        .column("volume", 1, volumes)
        .column("shear_rate", 1, rates)
        .write_to(&mut bytes)
        .unwrap();
    ParticleFile::from_bytes(&bytes).unwrap()
}

#[test]
fn quantiles_are_weighted_by_volume() {
    // Plane Poiseuille flow: the rate is proportional to the distance from the middle, so
    // each share of the volume is its own share of the largest rate.
    let n = 10_000;
    let rates: Vec<f32> = (1..=n).map(|i| 1e5 * i as f32 / n as f32).collect();
    let file = snapshot(&rates, &vec![3e-18; n], Some("rheometer"));
    let found = ShearRates::of_file(&file, None).unwrap();
    assert_eq!(found.time_s, 2.5e-5);
    for (quantile, share) in found.quantiles.iter().zip(ShearRates::SHARES) {
        assert!((quantile / 1e5 - share).abs() < 1e-6, "{share}: {quantile}");
    }
    assert!((found.max - 1e5).abs() < 1e-2 && (found.mean - 5e4).abs() < 10.0);
    assert!((found.volume_m3 / 3e-14 - 1.0).abs() < 1e-6);

    let file = snapshot(&[10.0, 20.0, 30.0], &[1.0, 8.0, 1.0], None);
    let found = ShearRates::of_file(&file, None).unwrap();
    assert_eq!(found.quantiles, [10.0, 10.0, 20.0, 20.0, 20.0, 20.0, 30.0]);
    assert_eq!(found.mean, 20.0);
    let none = ShearRates::of_file(&snapshot(&[], &[], None), None).unwrap();
    let numbers = none.quantiles.into_iter().chain([none.max, none.mean]);
    assert!(numbers.into_iter().all(f64::is_nan), "{none:?}");
}

#[test]
fn conventions_differ_by_the_root_of_two() {
    let stored = [("paper", 1.0), ("rheometer", std::f64::consts::SQRT_2)];
    for (name, factor) in stored {
        let file = snapshot(&[1000.0; 4], &[1.0; 4], Some(name));
        let max = |convention| ShearRates::of_file(&file, convention).unwrap().max;
        assert_eq!(max(None), 1000.0);
        assert!((max(Some(Convention::Paper)) - 1000.0 * factor).abs() < 1e-9);
        let rheometer = 1000.0 * factor / std::f64::consts::SQRT_2;
        assert!((max(Some(Convention::Rheometer)) - rheometer).abs() < 1e-9);
    }
    let unlabelled = snapshot(&[1.0], &[1.0], None);
    let said = ShearRates::of_file(&unlabelled, Some(Convention::Paper)).unwrap_err();
    assert!(said.is_usage(), "{said}");
}

#[test]
fn values_that_are_no_rates_are_refused() {
    for (rate, volume) in [
        (f32::NAN, 1.0),
        (-1.0, 1.0),
        (1.0, f32::INFINITY),
        (1.0, -1.0),
    ] {
        let file = snapshot(&[1.0, rate], &[1.0, volume], None);
        let said = ShearRates::of_file(&file, None).unwrap_err();
        let usage = said.is_usage();
        assert!(!usage && said.to_string().contains("point 1"), "{said}");
    }
}

#[test]
fn the_papers_lumen() {
    // Paper section 3: v = 1 m/s, d = 50 um: "on the order of 1e5 1/s".
    assert!((tube_shear_rate(1.0, 50e-6) - 1.6e5).abs() < 1e-6);
}
