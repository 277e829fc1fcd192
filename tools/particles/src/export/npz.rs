//! Every array for NumPy.

use std::io::{self, Write};

use cli::{Failure, Output, Record};
use particle_file::{BitsRef, Block, Element, ParticleFile};
use zip::write::SimpleFileOptions;
use zip::{CompressionMethod, ZipWriter};

use super::points;

/// Writes every array under its name: blocks as booleans (nz, ny, nx) with `NAME_origin_m`
/// and `NAME_voxel_m` beside, columns as (rows, components), and the header's numbers.
pub fn write(file: &ParticleFile, output: &Output, record: &Record) -> Result<(), Failure> {
    let blocks = (0..file.header().blocks.len())
        .map(|i| file.block(i).map_err(Failure::data))
        .collect::<Result<Vec<_>, _>>()?;
    let columns = (file.sections().iter())
        .filter(|section| section.element != Element::Bits)
        .map(|section| points::column(file, section))
        .collect::<Result<Vec<_>, _>>()?;
    output.write_with_record(record, |out| {
        let mut npz = Npz(ZipWriter::new_stream(out));
        let header = file.header();
        npz.numbers("voxel_m", "()", &[header.voxel_m])?;
        npz.numbers("time_s", "()", &[header.time_s])?;
        npz.numbers(
            "box_m",
            "(2, 3)",
            &[header.box_min_m, header.box_max_m].concat(),
        )?;
        npz.entry("normal", "u1", "()", false)?
            .write_all(&[header.normal])?;
        for (block, bits) in &blocks {
            npz.block(block, *bits)?;
        }
        for column in &columns {
            let descr = match column.element {
                Element::F32 => "<f4",
                Element::F64 => "<f8",
                Element::U32 => "<u4",
                Element::U64 | Element::Bits => "<u8",
                Element::U8 | Element::Blob => "|u1",
            };
            let values = column.bytes.len() / column.element.size() as usize;
            let shape = match column.components {
                1 => format!("({values},)"),
                n => format!("({}, {n})", values / n),
            };
            let entry = npz.entry(column.name, descr, &shape, false)?;
            entry.write_all(&column.bytes)?;
        }
        npz.0.finish().map(drop).map_err(io::Error::from)
    })
}

struct Npz<W: Write>(ZipWriter<zip::write::StreamWriter<W>>);

impl<W: Write> Npz<W> {
    /// Starts array `name`: its zip entry and its .npy header (NumPy's format 1.0).
    fn entry(
        &mut self,
        name: &str,
        descr: &str,
        shape: &str,
        deflate: bool,
    ) -> io::Result<&mut dyn Write> {
        let method = match deflate {
            true => CompressionMethod::Deflated,
            false => CompressionMethod::Stored,
        };
        let options = SimpleFileOptions::default()
            .large_file(true)
            .compression_method(method);
        let name = super::plain(name);
        self.0.start_file(format!("{name}.npy"), options)?;
        let dictionary =
            format!("{{'descr': '{descr}', 'fortran_order': False, 'shape': {shape}, }}");
        // Magic, version and length take 10 bytes; data start at a multiple of 64.
        let len = (10 + dictionary.len() + 1).next_multiple_of(64) - 10;
        self.0.write_all(b"\x93NUMPY\x01\x00")?;
        self.0.write_all(&(len as u16).to_le_bytes())?;
        writeln!(self.0, "{dictionary:<0$}", len - 1)?;
        Ok(&mut self.0)
    }

    fn numbers(&mut self, name: &str, shape: &str, numbers: &[f64]) -> io::Result<()> {
        let entry = self.entry(name, "<f8", shape, false)?;
        entry.write_all(bytemuck::cast_slice(numbers))
    }

    fn block(&mut self, block: &Block, bits: BitsRef) -> io::Result<()> {
        let name = &block.name;
        self.numbers(&format!("{name}_origin_m"), "(3,)", &block.origin_m)?;
        self.numbers(&format!("{name}_voxel_m"), "()", &[block.voxel_m])?;
        let [nx, ny, nz] = bits.dims();
        let out = self.entry(name, "|b1", &format!("({nz}, {ny}, {nx})"), true)?;
        let mut row = vec![0; nx];
        for z in 0..nz {
            for y in 0..ny {
                row.fill(0);
                bits.set_in_row(y, z).for_each(|x| row[x] = 1);
                out.write_all(&row)?;
            }
        }
        Ok(())
    }
}
