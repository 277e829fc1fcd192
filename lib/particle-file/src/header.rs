//! The header of a file.

use bincode::config::{Configuration, Fixint, Limit, LittleEndian};
use bincode::{Decode, Encode};

use crate::bits::BitsRef;
use crate::error::ensure;
use crate::limits;
use crate::section::Section;

/// Largest header accepted, also the decoder's limit, so that a forged length cannot make it
/// allocate more. Long lists of input files are some 100 bytes per file.
pub(crate) const MAX_HEADER: usize = 1 << 24;

/// Fixed-width little-endian integers, lengths as u64, variants as u32: FORMAT.md.
const CODEC: Configuration<LittleEndian, Fixint, Limit<MAX_HEADER>> =
    bincode::config::legacy().with_limit::<MAX_HEADER>();

/// What a particle file holds.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Encode, Decode, strum::Display)]
pub enum Kind {
    /// A scanned or synthetic specimen: blocks "wood" and "adhesive".
    #[strum(to_string = "specimen")]
    Specimen,
    /// A bond line before pressing: blocks "wood-bottom", "wood-top" and "adhesive".
    #[strum(to_string = "bond before pressing")]
    Bond,
    /// A state of a run: blocks "wood-bottom" and "wood-top", the liquid as columns.
    #[strum(to_string = "state of a run")]
    State,
    /// Everything a run needs to go on: columns of any length and blobs.
    #[strum(to_string = "checkpoint of a run")]
    Checkpoint,
}

/// What a block is made of.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Encode, Decode, strum::Display)]
#[strum(serialize_all = "lowercase")]
pub enum Material {
    /// Wood: moves as a whole.
    Rigid,
    /// Liquid adhesive, each voxel full.
    Adhesive,
}

/// A block of equal cubic voxels, some of them set. Voxel (i, j, k) fills
/// `origin + [i, j, k] * voxel` to `origin + [i + 1, j + 1, k + 1] * voxel`.
#[derive(Clone, Debug, PartialEq, Encode, Decode)]
pub struct Block {
    /// "wood", "wood-bottom", "wood-top", "adhesive".
    pub name: String,
    /// What it is made of.
    pub material: Material,
    /// Number of voxels along x, y, z.
    pub dims: [u64; 3],
    /// Low corner, m.
    pub origin_m: [f64; 3],
    /// Voxel edge, m.
    pub voxel_m: f64,
    /// Number of set voxels.
    pub count: u64,
}

/// One tool that had a hand in a file; the last entry wrote it.
#[derive(Clone, Debug, Default, PartialEq, Eq, Encode, Decode)]
pub struct Provenance {
    /// Name of the tool.
    pub tool: String,
    /// Its version.
    pub version: String,
    /// The command line as given.
    pub command: Vec<String>,
    /// Path of each input as given and XXH3-64 of its content.
    pub inputs: Vec<(String, u64)>,
}

/// What a particle file says about itself.
#[derive(Clone, Debug, PartialEq, Encode, Decode)]
pub struct Header {
    /// What the file holds.
    pub kind: Kind,
    /// Voxel edge of the specimen, m.
    pub voxel_m: f64,
    /// Axis of the bond normal: 0 = x, 1 = y, 2 = z.
    pub normal: u8,
    /// Low corner of the specimen's box, m.
    pub box_min_m: [f64; 3],
    /// High corner of the specimen's box, m.
    pub box_max_m: [f64; 3],
    /// Time since the start of the run, s.
    pub time_s: f64,
    /// Steps since the start of the run.
    pub step: u64,
    /// The blocks, in the order of their data.
    pub blocks: Vec<Block>,
    /// Liquid material points, i.e. rows of the columns (of "position" in a checkpoint).
    pub particles: u64,
    /// Small named values: bond plane, gap, case.
    pub attributes: Vec<(String, String)>,
    /// The tools that made the file, oldest first.
    pub provenance: Vec<Provenance>,
}

impl Block {
    /// A block that describes `bits`.
    pub fn new<'a>(
        name: &str,
        material: Material,
        origin_m: [f64; 3],
        voxel_m: f64,
        bits: impl Into<BitsRef<'a>>,
    ) -> Self {
        let bits = bits.into();
        Self {
            name: name.into(),
            material,
            dims: bits.dims().map(|n| n as u64),
            origin_m,
            voxel_m,
            count: bits.count(),
        }
    }

    /// High corner, m.
    pub fn max_m(&self) -> [f64; 3] {
        std::array::from_fn(|a| self.origin_m[a] + self.dims[a] as f64 * self.voxel_m)
    }

    /// Volume of the set voxels, m3.
    pub fn volume_m3(&self) -> f64 {
        self.count as f64 * self.voxel_m.powi(3)
    }
}

impl Provenance {
    /// The record of this process: its command line and the `inputs` it read.
    pub fn of_process(tool: &str, version: &str, inputs: Vec<(String, u64)>) -> Self {
        Self {
            tool: tool.into(),
            version: version.into(),
            command: std::env::args_os()
                .map(|a| a.to_string_lossy().into_owned())
                .collect(),
            inputs,
        }
    }
}

impl Header {
    /// A header at time zero; blocks and particles are filled in by the [`crate::Draft`].
    pub fn new(
        kind: Kind,
        voxel_m: f64,
        normal: u8,
        box_min_m: [f64; 3],
        box_max_m: [f64; 3],
    ) -> Self {
        Self {
            kind,
            voxel_m,
            normal,
            box_min_m,
            box_max_m,
            time_s: 0.0,
            step: 0,
            blocks: Vec::new(),
            particles: 0,
            attributes: Vec::new(),
            provenance: Vec::new(),
        }
    }

    /// The attribute `name`.
    pub fn attribute(&self, name: &str) -> Option<&str> {
        let found = self.attributes.iter().find(|(n, _)| n == name);
        found.map(|(_, value)| value.as_str())
    }

    /// Sets attribute `name`, replacing an older value.
    pub fn set_attribute(&mut self, name: &str, value: impl ToString) {
        self.attributes.retain(|(n, _)| n != name);
        self.attributes.push((name.into(), value.to_string()));
    }

    /// Voxels along x, y, z of the box around the file's box and its blocks.
    pub fn span(&self) -> [u64; 3] {
        let [low, high] = self.bounds_m();
        std::array::from_fn(|a| ((high[a] - low[a]) / self.voxel_m).round().max(1.0) as u64)
    }

    /// Low and high corner of the box around the file's box and its blocks, m.
    pub fn bounds_m(&self) -> [[f64; 3]; 2] {
        let around = |[low, high]: [[f64; 3]; 2], block: &Block| {
            let (from, to) = (block.origin_m, block.max_m());
            [
                std::array::from_fn(|a| low[a].min(from[a])),
                std::array::from_fn(|a| high[a].max(to[a])),
            ]
        };
        let own = [self.box_min_m, self.box_max_m];
        self.blocks.iter().fold(own, around)
    }

    /// Whether these values can be those of a particle file; else why not.
    pub(crate) fn check(&self) -> Result<(), String> {
        let (edges, edge) = (limits::VOXEL_M, self.voxel_m);
        ensure(edges.contains(&edge), || {
            let [least, most] = [edges.start(), edges.end()];
            format!("voxel edge {edge:e} m is not from {least:e} to {most:e} m")
        })?;
        let (normal, time_s) = (self.normal, self.time_s);
        ensure(normal <= 2, || {
            format!("bond normal {normal} is not 0, 1 or 2")
        })?;
        let mut corners = self.box_min_m.iter().zip(&self.box_max_m);
        ensure(corners.all(|(a, b)| (b - a).is_finite() && a <= b), || {
            "the corners of the box are not in order".into()
        })?;
        ensure(time_s.is_finite() && time_s >= 0.0, || {
            format!("time {time_s} s is not 0 or positive")
        })?;
        for block in &self.blocks {
            self.check_block(block)
                .map_err(|fault| format!("the {fault} in block '{}'", block.name))?;
        }
        let most = limits::FROM_ZERO;
        let near = |x: &f64| x.abs() <= most * edge;
        ensure(self.bounds_m().iter().flatten().all(near), || {
            format!("a corner is further than {most:e} voxels from zero")
        })?;
        let ([x, y, z], most) = (self.span(), limits::SPAN_PER_AXIS);
        ensure(x.max(y).max(z) <= most, || {
            format!(
                "its box and blocks span {x} x {y} x {z} voxels, more than {most} along an axis"
            )
        })
    }

    fn check_block(&self, block: &Block) -> Result<(), String> {
        ensure(!block.dims.contains(&0), || {
            "number of voxels is zero".into()
        })?;
        let most = limits::PER_AXIS;
        ensure(block.dims.iter().all(|&n| n <= most), || {
            format!("number of voxels is above {most} along an axis")
        })?;
        ensure(block.origin_m.iter().all(|x| x.is_finite()), || {
            "low corner is not finite".into()
        })?;
        let edge = self.voxel_m;
        ensure((block.voxel_m / edge - 1.0).abs() < 1e-6, || {
            format!("voxel edge is not the file's, {edge:e} m,")
        })
    }
}

/// The header as stored: with the table of sections.
#[derive(Clone, Debug, PartialEq, Encode, Decode)]
pub(crate) struct Stored {
    pub(crate) header: Header,
    pub(crate) sections: Vec<Section>,
}

impl Stored {
    pub(crate) fn encode(&self) -> Result<Vec<u8>, String> {
        bincode::encode_to_vec(self, CODEC).map_err(|e| e.to_string())
    }

    /// Decodes a header that is followed by zeros only.
    pub(crate) fn decode(bytes: &[u8]) -> Result<Self, String> {
        let (stored, used) = bincode::decode_from_slice::<Self, _>(bytes, CODEC)
            .map_err(|e| format!("cannot be decoded ({e})"))?;
        match bytes.get(used..) {
            Some(rest) if rest.iter().all(|&b| b == 0) => Ok(stored),
            _ => Err("is followed by bytes that are not zero".into()),
        }
    }
}
