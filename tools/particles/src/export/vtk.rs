//! VTK XML files with raw appended data: <https://docs.vtk.org/en/latest/vtk_file_formats/vtkxml_file_format.html>.

use std::fs::File;
use std::io::{self, Read, Write};
use std::path::Path;

use particle_file::Element;
use voxels::LabelVolume;

use super::points::{Column, Points};

const POINTS: &str = "PolyData";
const LABELS: &str = "ImageData";

/// Writes the points of a file as PolyData, one vertex each.
pub fn write_points(points: &Points, time_s: f64, out: &mut dyn Write) -> io::Result<()> {
    let is_position = |c: &&Column| c.name == "position" && c.components == 3;
    let Some(position) = points.columns.iter().find(is_position) else {
        return Err(io::Error::other("points without positions cannot be drawn"));
    };
    let n = points.rows as u64;
    let mut document = Document::new(POINTS, time_s, "");
    document.open(&format!(
        "<Piece NumberOfPoints=\"{n}\" NumberOfVerts=\"{n}\" NumberOfLines=\"0\" \
         NumberOfStrips=\"0\" NumberOfPolys=\"0\">\n<Points>"
    ));
    document.column(position);
    document.open("</Points>\n<Verts>");
    document.array("Int64", "connectivity", 1, 8 * n);
    document.array("Int64", "offsets", 1, 8 * n);
    document.open("</Verts>\n<PointData>");
    let others = || points.columns.iter().filter(|c| !is_position(c));
    others().for_each(|column| document.column(column));
    document.open("</PointData>\n</Piece>");
    document.write_head(out)?;
    append(&position.bytes, out)?;
    for first in [0, 1] {
        out.write_all(&(8 * n).to_le_bytes())?;
        (first..first + n).try_for_each(|i| out.write_all(&i.to_le_bytes()))?;
    }
    others().try_for_each(|column| append(&column.bytes, out))?;
    write_end(out)
}

/// Writes labels as ImageData, one cell per voxel.
pub fn write_labels(labels: &LabelVolume, time_s: f64, out: &mut dyn Write) -> io::Result<()> {
    let [nx, ny, nz] = labels.dims;
    let [x, y, z] = labels.origin_m;
    let edge = labels.voxel_m;
    let extent = format!("0 {nx} 0 {ny} 0 {nz}");
    let place = format!(
        " WholeExtent=\"{extent}\" Origin=\"{x:e} {y:e} {z:e}\" Spacing=\"{edge:e} {edge:e} {edge:e}\""
    );
    let len = nx as u64 * ny as u64 * nz as u64;
    let mut document = Document::new(LABELS, time_s, &place);
    document.open(&format!(
        "<Piece Extent=\"{extent}\">\n<CellData Scalars=\"label\">"
    ));
    document.array("UInt8", "label", 1, len);
    document.open("</CellData>\n</Piece>");
    document.write_head(out)?;
    out.write_all(&len.to_le_bytes())?;
    labels.pages(|page| out.write_all(page))?;
    write_end(out)
}

/// What stands in front of the time in every file.
const TIME: &str = "<FieldData>\n<DataArray type=\"Float64\" Name=\"TimeValue\" \
                    NumberOfTuples=\"1\" format=\"ascii\">";

/// The beginning of a file, up to the attributes of its data set.
fn begin(data_set: &str) -> String {
    format!(
        "<?xml version=\"1.0\"?>\n\
         <VTKFile type=\"{data_set}\" version=\"1.0\" byte_order=\"LittleEndian\" \
         header_type=\"UInt64\">\n\
         <{data_set}"
    )
}

/// Whether the file at `path` begins as those written here do.
pub fn is_own(path: &Path) -> bool {
    let mut head = Vec::new();
    let read = File::open(path).and_then(|file| file.take(1024).read_to_end(&mut head));
    let head = String::from_utf8_lossy(&head);
    let own = |data_set| head.starts_with(&begin(data_set));
    read.is_ok() && (own(POINTS) || own(LABELS)) && head.contains(TIME)
}

/// The XML in front of the appended bytes.
struct Document {
    data_set: &'static str,
    xml: String,
    /// Bytes of the arrays declared so far, each behind its length as u64.
    offset: u64,
}

impl Document {
    fn new(data_set: &'static str, time_s: f64, attributes: &str) -> Self {
        let begin = begin(data_set);
        let xml = format!("{begin}{attributes}>\n{TIME}{time_s:e}</DataArray>\n</FieldData>\n");
        Self {
            data_set,
            xml,
            offset: 0,
        }
    }

    fn open(&mut self, tags: &str) {
        self.xml.push_str(tags);
        self.xml.push('\n');
    }

    /// Declares the next appended array, of `len` bytes.
    fn array(&mut self, kind: &str, name: &str, components: usize, len: u64) {
        self.open(&format!(
            "<DataArray type=\"{kind}\" Name=\"{}\" NumberOfComponents=\"{components}\" \
             format=\"appended\" offset=\"{}\"/>",
            super::plain(name),
            self.offset
        ));
        self.offset += size_of::<u64>() as u64 + len;
    }

    fn column(&mut self, column: &Column) {
        let kind = match column.element {
            Element::F32 => "Float32",
            Element::F64 => "Float64",
            Element::U32 => "UInt32",
            Element::U64 | Element::Bits => "UInt64",
            Element::U8 | Element::Blob => "UInt8",
        };
        let len = column.bytes.len() as u64;
        self.array(kind, column.name, column.components, len);
    }

    /// Writes the XML up to the mark behind which the arrays follow.
    fn write_head(&self, out: &mut dyn Write) -> io::Result<()> {
        let Self { xml, data_set, .. } = self;
        write!(
            out,
            "{xml}</{data_set}>\n<AppendedData encoding=\"raw\">\n_"
        )
    }
}

fn append(bytes: &[u8], out: &mut dyn Write) -> io::Result<()> {
    out.write_all(&(bytes.len() as u64).to_le_bytes())?;
    out.write_all(bytes)
}

fn write_end(out: &mut dyn Write) -> io::Result<()> {
    out.write_all(b"\n</AppendedData>\n</VTKFile>\n")
}
