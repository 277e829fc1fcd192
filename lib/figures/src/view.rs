//! The figure of states in three dimensions.

use particle_file::ParticleFile;
use voxels::LabelVolume;

use crate::axes::{NORMAL, SMALL};
use crate::camera::Camera;
use crate::colour::BLACK;
use crate::drawing::{Anchor, Drawing, Point};
use crate::frame::Frame;
use crate::measure::{self, LINE};
use crate::page::Page;
use crate::panels::{Layout, Panels, Sheet};
use crate::section::time_of;
use crate::solid::Solids;
use crate::{Error, Labelled};

/// Specimens, bonds and states of a run in three dimensions, lit and in orthographic view, from
/// the voxels of [`LabelVolume`] (Figs. 1 and 7 of the paper).
pub struct Views {
    panels: Vec<Panel>,
    camera: Camera,
    /// x, y or z: across the bond, and up.
    normal: usize,
    /// Low and high corner of what all panels show, m; without, each shows its own voxels.
    within: Option<[[f64; 3]; 2]>,
}

/// How much of the wood is shown.
#[derive(Clone, Copy, Debug, PartialEq, Eq, strum::EnumString, strum::VariantNames)]
#[strum(serialize_all = "lowercase")]
pub enum Wood {
    /// None: the adhesive alone (Fig. 7).
    Hidden,
    /// The half away from the viewer, so that the adhesive in front stands free.
    Cut,
    /// All of it.
    Whole,
}

/// From where to look: degrees about the axis across the bond, and above the bond plane.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Direction {
    /// At 0 the front is in view, at 90 the right side.
    pub turn: f64,
    /// At 0 from the side, at 90 from above.
    pub tilt: f64,
}

impl Default for Direction {
    fn default() -> Self {
        Self {
            turn: 35.0,
            tilt: 25.0,
        }
    }
}

struct Panel {
    label: String,
    detail: String,
    /// Low corner, m.
    origin_m: [f64; 3],
    /// Edges in voxels.
    edges: [f64; 3],
    /// Voxel edge, um.
    voxel: f64,
    solids: Solids,
}

const MARGIN: f64 = 12.0;
/// Most pixels of a panel's view, however fine the page: each takes 200 bytes on the way.
const MOST_PIXELS: f64 = 2e6;
/// Height of the strip with the axes.
const STRIP: f64 = 66.0;

impl Views {
    /// Reads one panel per particle file.
    ///
    /// # Errors
    /// [`Error::Data`] for an unreadable file; [`Error::Request`] for files with different axes
    /// across the bond.
    pub fn read(files: &[Labelled], wood: Wood, from: Direction) -> Result<Self, Error> {
        let mut normals = Vec::new();
        let mut panels = Vec::new();
        for file in files {
            let opened = ParticleFile::open(&file.path)?;
            let normal = usize::from(opened.header().normal);
            let camera = Camera::new(normal, from.turn, from.tilt);
            panels.push(Panel::read(file, &opened, wood, &camera)?);
            normals.push(normal);
        }
        let normal = normals.first().copied().unwrap_or(1);
        if normals.iter().any(|other| *other != normal) {
            let said =
                "the files have different bond normals: a figure needs the same normal for all";
            return Err(Error::Request(said.into()));
        }
        Ok(Self {
            panels,
            camera: Camera::new(normal, from.turn, from.tilt),
            normal,
            within: None,
        })
    }

    /// The same with all panels of a box between these corners (m), which holds their voxels.
    pub(crate) fn within(self, corners_m: [[f64; 3]; 2]) -> Self {
        Self {
            within: Some(corners_m),
            ..self
        }
    }

    /// The figure.
    pub fn draw(&self, page: Page) -> Drawing {
        let sheets: Vec<Sheet> = (self.panels.iter().enumerate())
            .map(|(i, panel)| Sheet {
                edges: self.extent(i),
                name: &panel.label,
                detail: &panel.detail,
                axes: None,
                beside: false,
            })
            .collect();
        let layout = Layout {
            top: 8.0,
            longest: [480.0, 420.0, 340.0][self.panels.len().clamp(1, 3) - 1],
            left: 10.0,
            below: 14.0,
            right: 0.0,
        };
        let panels = Panels::place(&sheets, layout, page);
        let width = page.width().unwrap_or(panels.right.max(260.0));
        let mut drawing = Drawing::new(page, width, panels.bottom + STRIP);
        panels.draw_captions(&mut drawing);
        for (i, frame) in panels.frames.iter().enumerate() {
            self.draw_into(&mut drawing, i, frame);
        }
        let scale = panels.frames[0].width / self.extent(0)[0];
        self.draw_axes(&mut drawing, panels.bottom, scale);
        drawing
    }

    /// Width and height of a panel's view, um.
    pub(crate) fn extent(&self, panel: usize) -> [f64; 2] {
        let panel = &self.panels[panel];
        let [low, high] = self.camera.extent(self.ends(panel));
        [high[0] - low[0], high[1] - low[1]].map(|edge| edge * panel.voxel)
    }

    /// Low and high corner of what a panel shows, voxels from its own low corner.
    fn ends(&self, panel: &Panel) -> [[f64; 3]; 2] {
        let own = [[0.0; 3], panel.edges];
        self.within.map_or(own, |corners_m| {
            let voxels = |metres, origin_m| 1e6 * (metres - origin_m) / panel.voxel;
            corners_m.map(|corner| std::array::from_fn(|i| voxels(corner[i], panel.origin_m[i])))
        })
    }

    /// The axis that comes nearest to the viewer.
    pub(crate) fn front(&self) -> usize {
        self.camera.front
    }

    /// Which axis points where.
    pub(crate) fn axes(&self) -> String {
        let [right, up, front] = [2, 0, 1].map(|turn| ["x", "y", "z"][(self.normal + turn) % 3]);
        format!("{up} up, {right} right, {front} front")
    }

    /// Draws a panel's view into a frame of its shape.
    pub(crate) fn draw_into(&self, drawing: &mut Drawing, panel: usize, frame: &Frame) {
        let panel = &self.panels[panel];
        let most = (MOST_PIXELS * frame.width / frame.height).sqrt();
        let across = (frame.width * drawing.page.scale()).round().min(most) as usize;
        let (size, rgb) = self.camera.view(&panel.solids, self.ends(panel), across);
        frame.fill(drawing, size, rgb);
    }

    /// The three axes as arrows of a round length, which are the scale too.
    fn draw_axes(&self, drawing: &mut Drawing, top: f64, scale: f64) {
        let steps = (0..9).flat_map(|power| [1.0, 2.0, 5.0].map(|f| f * 10_f64.powi(power)));
        let fits = |length: &f64| length * scale <= 30.0;
        let length = steps.take_while(fits).last().unwrap_or(1.0);
        let vector = |axis: usize| std::array::from_fn(|a| f64::from(u8::from(a == axis)));
        let tips = [0, 1, 2].map(|axis| {
            let [x, y] = self.camera.place(vector(axis));
            [x * length * scale, -(y * length * scale)]
        });
        let low = |a: usize| tips.iter().map(|tip| tip[a]).fold(0.0, f64::min);
        let high = |a: usize| tips.iter().map(|tip| tip[a]).fold(0.0, f64::max);
        let room = 12.0;
        let origin = [MARGIN + room - low(0), top + STRIP - room - 4.0 - high(1)];
        for (axis, tip) in tips.iter().enumerate() {
            let end = [origin[0] + tip[0], origin[1] + tip[1]];
            arrow(drawing, origin, end);
            // An axis that points at the viewer has its name beside it.
            let away = match tip[0].hypot(tip[1]) {
                long if long > 6.0 => tip.map(|part| part / long * 10.0),
                _ => [-9.0, 9.0],
            };
            let at = [end[0] + away[0], end[1] + away[1]];
            drawing.text(["x", "y", "z"][axis], at, Anchor::Centre, SMALL);
        }
        let normal = ["x", "y", "z"][self.normal];
        let says =
            format!("arrows:\u{a0}{length:.0}\u{a0}µm; {normal}\u{a0}(up) is the bond normal");
        let left = origin[0] + high(0) + room + 14.0;
        let lines = measure::lines(&says, NORMAL, drawing.width - left - MARGIN, 4);
        let middle = top + 0.5 * STRIP - 0.5 * (lines.len() as f64 - 1.0) * LINE * NORMAL;
        drawing.lines(&lines, [left, middle], Anchor::Left, NORMAL);
    }
}

fn arrow(drawing: &mut Drawing, from: Point, to: Point) {
    drawing.line(vec![from, to], BLACK, 1.6);
    let [dx, dy] = [to[0] - from[0], to[1] - from[1]];
    let length = dx.hypot(dy);
    if length > 6.0 {
        let [ux, uy] = [dx / length, dy / length];
        let [x, y] = [to[0] - 7.0 * ux, to[1] - 7.0 * uy];
        let wings = [1.0, -1.0].map(|side| [x + side * 3.0 * uy, y - side * 3.0 * ux]);
        drawing.area(vec![to, wings[0], wings[1]], BLACK);
    }
}

impl Panel {
    fn read(
        named: &Labelled,
        file: &ParticleFile,
        wood: Wood,
        camera: &Camera,
    ) -> Result<Self, Error> {
        let labels = LabelVolume::of(file)?;
        file.fits(Solids::bytes(labels.dims), "a view of its voxels")?;
        let middle = labels.dims[camera.front] / 2;
        let solids = Solids::new(&labels, |voxel| match wood {
            Wood::Hidden => false,
            Wood::Cut => voxel[camera.front] < middle,
            Wood::Whole => true,
        });
        Ok(Self {
            label: named.label.clone(),
            detail: time_of(file).unwrap_or_default(),
            origin_m: labels.origin_m,
            edges: labels.dims.map(|n| n as f64),
            voxel: labels.voxel_m * 1e6,
            solids,
        })
    }
}
