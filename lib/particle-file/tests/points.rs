//! The material points: order-free sum and the adhesive in both of its forms.

use particle_file::{BitGrid, Block, Draft, Header, Kind, Material, ParticleFile};

const VOXEL: f64 = 1.45e-6;

fn header(kind: Kind) -> Header {
    Header::new(kind, VOXEL, 1, [0.0; 3], [1e-3; 3])
}

fn open(draft: Draft) -> ParticleFile {
    let mut bytes = Vec::new();
    draft.write_to(&mut bytes).unwrap();
    ParticleFile::from_bytes(&bytes).unwrap()
}

/// Points in the order of `order`, columns one way round or the other.
fn liquid_sum(order: &[u32], volume_first: bool, nudge: f32) -> u64 {
    let position: Vec<f32> = (order.iter())
        .flat_map(|&p| [p as f32, (p * p) as f32 + nudge, 0.5])
        .collect();
    let volume: Vec<f32> = order.iter().map(|&p| 1.0 + p as f32).collect();
    let draft = Draft::new(header(Kind::State));
    let file = open(if volume_first {
        draft
            .column("volume", 1, &volume)
            .column("position", 3, &position)
    } else {
        draft
            .column("position", 3, &position)
            .column("volume", 1, &volume)
    });
    file.sum().unwrap()
}

#[test]
fn the_sum_does_not_know_the_order() {
    let sorted: Vec<u32> = (0..10_000).collect();
    let shuffled: Vec<u32> = (0..10_000).map(|i| i * 7919 % 10_000).collect();
    let sum = liquid_sum(&sorted, false, 0.0);
    assert_eq!(sum, liquid_sum(&shuffled, false, 0.0));
    assert_eq!(sum, liquid_sum(&shuffled, true, 0.0));
    let one = rayon_threads(1, || liquid_sum(&shuffled, false, 0.0));
    assert_eq!(sum, rayon_threads(3, || liquid_sum(&shuffled, false, 0.0)));
    assert_eq!(sum, one);
    assert_ne!(sum, liquid_sum(&sorted, false, 0.25));
    assert_ne!(sum, liquid_sum(&sorted[1..], false, 0.0));
}

fn rayon_threads<T: Send>(threads: usize, work: impl FnOnce() -> T + Send) -> T {
    let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build();
    pool.unwrap().install(work)
}

#[test]
fn the_sum_of_blocks_knows_place_and_material_but_not_their_order() {
    let wood = BitGrid::from_fn([130, 9, 5], |x, y, z| (x + 2 * y + 3 * z) % 5 == 0);
    let glue = BitGrid::from_fn([130, 9, 5], |x, y, z| (x + 2 * y + 3 * z) % 5 == 1);
    let block = |name, material, origin, grid: &BitGrid| {
        Block::new(name, material, [origin, 0.0, 0.0], VOXEL, grid)
    };
    let a = || block("wood", Material::Rigid, 0.0, &wood);
    let b = || block("adhesive", Material::Adhesive, 0.0, &glue);
    let sum = |draft: Draft| open(draft).sum().unwrap();
    let draft = || Draft::new(header(Kind::Specimen));
    let both = sum(draft().block(a(), &wood).block(b(), &glue));
    assert_eq!(both, sum(draft().block(b(), &glue).block(a(), &wood)));
    let moved = block("adhesive", Material::Adhesive, VOXEL, &glue);
    let turned = block("adhesive", Material::Rigid, 0.0, &glue);
    assert_ne!(both, sum(draft().block(a(), &wood).block(moved, &glue)));
    assert_ne!(both, sum(draft().block(a(), &wood).block(turned, &glue)));
    let mut fewer = glue.clone();
    let x = glue.view().set_in_row(4, 4).last().unwrap();
    fewer.set(x, 4, 4, false);
    assert_ne!(both, sum(draft().block(a(), &wood).block(b(), &fewer)));
}

#[test]
fn adhesive_is_the_same_as_voxels_and_as_points() {
    let dims = [70, 4, 3];
    let glue = BitGrid::from_fn(dims, |x, y, z| (x + y + z) % 3 == 0);
    let wood = BitGrid::from_fn(dims, |x, y, z| (x + y + z) % 3 == 1);
    let origin = [1e-5, -2e-5, 0.0];
    let specimen = open(
        Draft::new(header(Kind::Specimen))
            .block(
                Block::new("wood", Material::Rigid, origin, VOXEL, &wood),
                &wood,
            )
            .block(
                Block::new("adhesive", Material::Adhesive, origin, VOXEL, &glue),
                &glue,
            ),
    );
    let mut from_voxels = Vec::new();
    let push = |position, volume| from_voxels.push((position, volume));
    specimen.for_each_adhesive(push).unwrap();
    assert_eq!(from_voxels.len() as u64, glue.count());
    let first: ([f64; 3], f64) = from_voxels[0];
    for (x, low) in first.0.iter().zip(origin) {
        assert!((x - low - 0.5 * VOXEL).abs() < 1e-12);
    }
    let centroid_y = from_voxels.iter().map(|(p, _)| p[1]).sum::<f64>() / from_voxels.len() as f64;
    let layers = glue.view().counts_along(1);
    let expected = (0..4)
        .map(|y| layers[y] as f64 * (origin[1] + (y as f64 + 0.5) * VOXEL))
        .sum::<f64>();
    assert!((centroid_y - expected / glue.count() as f64).abs() < 1e-12);

    let position: Vec<f32> = from_voxels
        .iter()
        .flat_map(|(p, _)| p.map(|x| x as f32))
        .collect();
    let volume: Vec<f32> = from_voxels.iter().map(|(_, v)| *v as f32).collect();
    let state = open(
        Draft::new(header(Kind::State))
            .block(
                Block::new("wood-bottom", Material::Rigid, origin, VOXEL, &wood),
                &wood,
            )
            .column("position", 3, &position)
            .column("volume", 1, &volume),
    );
    let mut from_points = Vec::new();
    state
        .for_each_adhesive(|p, v| from_points.push((p, v)))
        .unwrap();
    assert_eq!(from_points.len(), from_voxels.len());
    for (a, b) in from_points.iter().zip(&from_voxels) {
        assert!((a.1 / b.1 - 1.0).abs() < 1e-6);
        assert!((0..3).all(|i| (a.0[i] - b.0[i]).abs() < 1e-10));
    }
}
