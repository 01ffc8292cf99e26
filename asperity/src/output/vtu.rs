//! The body for ParaView: one file of an unstructured grid (`.vtu`) per state, and `body.pvd`, the
//! collection of them over slip in units of a₀.

use std::ffi::OsStr;
use std::path::{Path, PathBuf};

use tables::netcdf::write_atomically;
use tables::quantity::Quantity;
use vtkio::IOBuffer;
use vtkio::model::{
    Attribute, Attributes, ByteOrder, CellType, Cells, DataArray, DataSet, ElementType,
    UnstructuredGridPiece, Version, VertexNumbers, Vtk,
};
use vtkio::xml::Compressor;

use crate::output::revolved::{Extent, PointFields, RevolvedBody};
use crate::simulate::outcome::Outcome;

/// Why files were not written.
#[derive(Debug, thiserror::Error)]
pub enum VtuError {
    #[error("the fields of the body were not recorded (see Recording)")]
    NotRecorded,
    #[error("cannot write {path}: {reason}")]
    Write { path: PathBuf, reason: String },
}

/// Name of the collection.
pub const COLLECTION: &str = "body.pvd";

/// Name of the file of a state.
fn numbered(number: usize) -> String {
    format!("body-{number:03}.vtu")
}

/// Whether a file has the name of one of a state.
pub fn is_numbered(name: &OsStr) -> bool {
    let number = name.to_str().and_then(|name| name.strip_prefix("body-")?.strip_suffix(".vtu"));
    number.is_some_and(|number| number.len() >= 3 && number.bytes().all(|digit| digit.is_ascii_digit()))
}

/// Compression level of zlib: half of what there is to gain, in a tenth of the time.
const COMPRESSION: u32 = 3;

/// Write the recorded fields of the body into a directory, which is created if it does not exist; yields
/// the collection's path.
///
/// Points lie where they were before deformation, with the apex at the origin, z upwards and x along
/// the motion of the flat, in m. Values at the points: `displacement` (m), `stress` (xx, yy, zz, xy,
/// yz, xz) and `von_mises_stress` (Pa), `plastic_strain` and `temperature` (K). At finite strain the
/// stress is the one that works on the logarithmic strain (see [`crate::loading::body_fields::BodySnapshot`]).
pub fn write(directory: &Path, outcome: &Outcome, extent: Extent) -> Result<PathBuf, VtuError> {
    let fields = outcome.body.as_ref().ok_or(VtuError::NotRecorded)?;
    let failed = |path: &Path, reason: String| VtuError::Write { path: path.to_owned(), reason };
    std::fs::create_dir_all(directory).map_err(|error| failed(directory, error.to_string()))?;
    let body = RevolvedBody::new(fields, extent);
    let mut collection = String::from(
        "<?xml version=\"1.0\"?>\n<!-- timestep: slip in contact radii, or time in s where slip does not rise -->\n\
         <VTKFile type=\"Collection\" version=\"1.0\" byte_order=\"LittleEndian\">\n  <Collection>\n",
    );
    let radius = outcome.scalars[Quantity::ContactRadius].value;
    let rises = fields.snapshots.windows(2).all(|pair| pair[1].slip > pair[0].slip);
    for (number, snapshot) in fields.snapshots.iter().enumerate() {
        let name = numbered(number);
        let path = directory.join(&name);
        write_grid(&path, &body, &body.fields(snapshot)).map_err(|reason| failed(&path, reason))?;
        let moment = if rises { snapshot.slip / radius } else { snapshot.time };
        collection += &format!("    <DataSet timestep=\"{moment}\" part=\"0\" file=\"{name}\"/>\n");
    }
    collection.push_str("  </Collection>\n</VTKFile>\n");
    let path = directory.join(COLLECTION);
    write_atomically(&path, collection.as_bytes()).map_err(|error| failed(&path, error.to_string()))?;
    Ok(path)
}

fn write_grid(path: &Path, body: &RevolvedBody, fields: &PointFields) -> Result<(), String> {
    let scalars = ElementType::Scalars { num_comp: 1, lookup_table: None };
    let array = |name: &str, elem: &ElementType, values: Vec<f64>| {
        Attribute::DataArray(DataArray { name: name.into(), elem: elem.clone(), data: IOBuffer::F64(values) })
    };
    let point = vec![
        array("displacement", &ElementType::Vectors, fields.displacement.concat()),
        array("stress", &ElementType::Generic(6), fields.stress.concat()),
        array("von_mises_stress", &scalars, fields.von_mises.clone()),
        array("plastic_strain", &scalars, fields.plastic_strain.clone()),
        array("temperature", &scalars, fields.temperature.clone()),
    ];
    let piece = UnstructuredGridPiece {
        points: IOBuffer::F64(body.points.concat()),
        cells: cells(body),
        data: Attributes { point, cell: Vec::new() },
    };
    let grid = Vtk {
        version: Version::new_xml(1, 0),
        title: String::new(),
        byte_order: ByteOrder::LittleEndian,
        file_path: None,
        data: DataSet::inline(piece),
    };
    let xml = grid.try_into_xml_format(Compressor::ZLib, COMPRESSION).map_err(|error| error.to_string())?;
    let mut bytes = Vec::new();
    xml.write(&mut bytes).map_err(|error| error.to_string())?;
    write_atomically(path, &bytes).map_err(|error| error.to_string())
}

fn cells(body: &RevolvedBody) -> Cells {
    let corners = body.hexahedra.iter().flatten().chain(body.wedges.iter().flatten());
    let sizes = body.hexahedra.iter().map(|_| 8).chain(body.wedges.iter().map(|_| 6));
    let offsets = sizes.scan(0, |end, size| {
        *end += size;
        Some(*end)
    });
    let types = [(CellType::Hexahedron, body.hexahedra.len()), (CellType::Wedge, body.wedges.len())];
    Cells {
        cell_verts: VertexNumbers::XML {
            connectivity: corners.map(|&corner| corner as u64).collect(),
            offsets: offsets.collect(),
        },
        types: types.into_iter().flat_map(|(cell, count)| vec![cell; count]).collect(),
    }
}
