//! The order-free sum of material points and blocks.

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
    for threads in [1, 3] {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build();
        let again = pool.unwrap().install(|| liquid_sum(&shuffled, false, 0.0));
        assert_eq!(sum, again);
    }
    assert_ne!(sum, liquid_sum(&sorted, false, 0.25));
    assert_ne!(sum, liquid_sum(&sorted[1..], false, 0.0));
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
