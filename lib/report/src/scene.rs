//! A state in 3D: the surfaces of wood and adhesive of its voxels.

use figures::{Direction, Page, Views, Wood, base64};
use particle_file::{BitGrid, ParticleFile};
use voxels::{ADHESIVE, LabelVolume, Surface, WOOD};

use crate::html::escape;
use crate::mesh::packed;
use crate::{Error, Labelled};

/// Voxels that the viewer shows; of a larger state the middle of the bond plane is.
const MOST_VOXELS: usize = 700_000;
/// The picture for those who run no scripts: at this many pixels per inch a bond fits on a screen.
const PAGE: Page = Page {
    width_mm: None,
    dpi: 150.0,
};

/// Wood and adhesive of a specimen, bond or state, the bond normal up, as HTML: a picture, the nearer half of the wood
/// cut away, and what the viewer makes of it where scripts run.
///
/// # Errors
/// An unreadable or damaged file, or one without voxels.
pub fn scene(file: &Labelled) -> Result<String, Error> {
    let from = Direction::default();
    let views = Views::read(std::slice::from_ref(file), Wood::Cut, from)?;
    let picture = base64(&views.draw(PAGE).to_png()?);
    let particles = ParticleFile::open(&file.path)?;
    let labels = LabelVolume::of(&particles)?;
    let up = usize::from(particles.header().normal);
    let window = Window::of(labels.dims, [(up + 2) % 3, up, (up + 1) % 3]);
    let pick = |label: u8| {
        BitGrid::from_fn(window.size, |i, j, k| {
            labels.label(window.voxel([i, j, k])) == label
        })
    };
    let (wood, adhesive) = (pick(WOOD), pick(ADHESIVE));
    let everywhere = BitGrid::from_fn(window.size, |_, _, _| true);
    let open = BitGrid::from_fn(window.size, |i, j, k| !wood.get(i, j, k));
    // Edges of the box in voxels: to the right, up, towards the viewer.
    let edges = window.size.map(|n| n as f32);
    let data = serde_json::json!({
        "edges": edges,
        "turn": from.turn.to_radians(),
        "tilt": from.tilt.to_radians(),
        "wood": packed(&Surface::of(&wood, &everywhere), edges),
        "adhesive": packed(&Surface::of(&adhesive, &open), edges),
    });
    // No text may end the element that holds it.
    let data = data.to_string().replace('<', "\\u003c");
    let label = escape(&file.label);
    let detail = escape(&window.told(labels.dims, labels.voxel_m));
    Ok(format!(
        "<figure class=\"scene\"><img alt=\"{label}: oblique view of the pressed bond\" src=\"data:image/png;base64,{picture}\">\n<script type=\"application/json\">{data}</script>\n<figcaption>{label}: adhesive in orange, the nearer half of the wood cut away; {detail}.</figcaption></figure>\n"
    ))
}

/// The voxels that the viewer shows.
struct Window {
    /// Axes of the file to the right, up and towards the viewer; turned, not mirrored.
    axes: [usize; 3],
    /// First voxel and number of them, along those.
    first: [usize; 3],
    size: [usize; 3],
}

impl Window {
    fn of(dims: [usize; 3], axes: [usize; 3]) -> Self {
        let along = axes.map(|a| dims[a]);
        let side = (MOST_VOXELS as f64 / along[1] as f64).sqrt().max(2.0) as usize;
        let size = match along.iter().product::<usize>() {
            all if all <= MOST_VOXELS => along,
            _ => [along[0].min(side), along[1], along[2].min(side)],
        };
        Self {
            axes,
            first: std::array::from_fn(|a| (along[a] - size[a]) / 2),
            size,
        }
    }

    /// The voxel of the file.
    fn voxel(&self, place: [usize; 3]) -> [usize; 3] {
        let mut voxel = [0; 3];
        for (i, &axis) in self.axes.iter().enumerate() {
            voxel[axis] = self.first[i] + place[i];
        }
        voxel
    }

    fn told(&self, dims: [usize; 3], voxel_m: f64) -> String {
        let um = |n: usize| format!("{:.1}", n as f64 * voxel_m * 1e6);
        let names = self.axes.map(|a| ["x", "y", "z"][a]);
        let edges: Vec<String> = (0..3)
            .map(|i| format!("{} um along {}", um(self.size[i]), names[i]))
            .collect();
        let part = match self.axes.map(|a| dims[a]) == self.size {
            true => "",
            false => "middle of the specimen in the interactive view, ",
        };
        let (edges, up) = (edges.join(", "), names[1]);
        format!("{part}{edges}; {up} is up, the bond normal")
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn of_a_large_state_the_middle_is_shown_and_none_is_mirrored() {
        let whole = Window::of([40, 96, 40], [0, 1, 2]);
        assert_eq!((whole.first, whole.size), ([0; 3], [40, 96, 40]));
        // The normal along z: x, y, z of the view are y... of the file, in the same turn.
        let axes = [1, 2, 0];
        let part = Window::of([400, 1, 700], axes);
        assert_eq!(part.size, [1, 700, 400]);
        let part = Window::of([400, 400, 700], axes);
        assert_eq!(part.size, [31, 700, 31]);
        assert_eq!(part.voxel([0, 0, 0]), [184, 184, 0]);
        assert_eq!(part.voxel([1, 2, 3]), [187, 185, 2]);
        assert!(part.told([400, 400, 700], 1e-6).starts_with(
            "middle of the specimen in the interactive view, 31.0 um along y, 700.0 um along z"
        ));
    }
}
