//! A series of states for ParaView.

use std::collections::HashMap;
use std::collections::hash_map::Entry;
use std::path::Path;

use cli::{Failure, Output, Record, StagedFolder};
use particle_file::ParticleFile;
use voxels::LabelVolume;

use super::points::Points;
use super::vtk;

/// Writes `NAME.pvd` and beside it the folder `NAME.parts` with the liquid of each file as
/// `NNNN.vtp` (part 0) and its blocks as `NNNN-BLOCK.vti` (parts 1 and up). A block that
/// stays where it was is written once. In the folder only parts of earlier series are replaced.
///
/// # Errors
/// Exit 2 for standard output and where another file has the name of a part, exit 3 when an array is damaged, exit 1 when an output cannot
/// be written.
pub fn write(files: &[ParticleFile], output: &Output, record: &Record) -> Result<(), Failure> {
    let Output::File(pvd) = output else {
        let what = "a .pvd file refers to files in its folder, so it cannot go to standard output";
        return Err(Failure::usage(what));
    };
    let folder_name = folder_name(pvd);
    let mut parts = Parts {
        folder: StagedFolder::new(&pvd.with_file_name(&folder_name))?,
        blocks: HashMap::new(),
    };
    let folder_name = escape(&folder_name);
    let mut entries = String::new();
    for (number, file) in files.iter().enumerate() {
        let time_s = file.header().time_s;
        for (part, name) in parts.write(number, file)? {
            entries.push_str(&format!(
                "<DataSet timestep=\"{time_s:e}\" part=\"{part}\" file=\"{folder_name}/{name}\"/>\n"
            ));
        }
    }
    parts.folder.put_in_place(vtk::is_own)?;
    output.write_with_record(record, |out| {
        write!(
            out,
            "<?xml version=\"1.0\"?>\n<VTKFile type=\"Collection\" version=\"1.0\" \
             byte_order=\"LittleEndian\">\n<Collection>\n{entries}</Collection>\n</VTKFile>\n"
        )
    })
}

/// Name of the folder that belongs to `pvd`; XML holds Unicode without control characters only.
fn folder_name(pvd: &Path) -> String {
    let stem = pvd.file_stem().unwrap_or_default().to_string_lossy();
    // Not `NAME` alone: that is the run's own folder where the series is called after the run.
    stem.replace(char::is_control, "_") + ".parts"
}

struct Parts {
    folder: StagedFolder,
    /// Name of the file of a block with this index, place and hash of its voxels.
    blocks: HashMap<(usize, [u64; 3], u64), String>,
}

impl Parts {
    /// Writes what is new in the file of this number; gives number and name of its parts.
    fn write(
        &mut self,
        number: usize,
        file: &ParticleFile,
    ) -> Result<Vec<(usize, String)>, Failure> {
        let time_s = file.header().time_s;
        let mut parts = Vec::new();
        if file.header().particles > 0 {
            let name = format!("{number:04}.vtp");
            let points = Points::of(file)?;
            Output::File(self.folder.path(&name))
                .write(|out| vtk::write_points(&points, time_s, out))?;
            parts.push((0, name));
        }
        for index in 0..file.header().blocks.len() {
            let (block, bits) = file.block(index).map_err(Failure::data)?;
            let place = block.origin_m.map(f64::to_bits);
            let key = (index, place, file.sections()[index].xxh3);
            let name = match self.blocks.entry(key) {
                Entry::Occupied(written) => written.get().clone(),
                Entry::Vacant(new) => {
                    let name = format!("{number:04}-{}.vti", super::plain(&block.name));
                    let labels = LabelVolume::of_block(block, bits);
                    Output::File(self.folder.path(&name))
                        .write(|out| vtk::write_labels(&labels, time_s, out))?;
                    new.insert(name).clone()
                }
            };
            parts.push((1 + index, name));
        }
        Ok(parts)
    }
}

fn escape(text: &str) -> String {
    (text.replace('&', "&amp;").replace('<', "&lt;")).replace('"', "&quot;")
}
