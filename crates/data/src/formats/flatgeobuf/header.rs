//! FlatGeobuf header: columns, number of features, and coordinate system.

use super::buffer::{BufferDamage, BufferTable};
use burgeon_base::error::{Error, Result as Checked};
use burgeon_base::text::shown;
use burgeon_spatial::Crs;

/// Header of the file.
pub(super) struct LayerHeader {
    pub(super) name: String,
    /// West, south, east and north, if present.
    pub(super) bounds: Option<[f64; 4]>,
    /// Type of all geometries; 0 if each geometry contains its own type.
    pub(super) kind: u8,
    pub(super) columns: Vec<Column>,
    /// Number of features; 0 if unknown.
    pub(super) count: u64,
    /// Number of entries per node of the index; 0 without an index.
    pub(super) fan: u64,
    pub(super) crs: Checked<Crs>,
}

/// Attribute column.
#[derive(Clone)]
pub(super) struct Column {
    pub(super) name: String,
    pub(super) kind: u8,
    /// Marks an id column.
    pub(super) is_key: bool,
}

/// Converts eight bytes to a number.
pub(super) fn double(bytes: [u8; 8]) -> f64 {
    f64::from_le_bytes(bytes)
}

/// Returns the numbers in a list.
pub(super) fn doubles(bytes: &[u8]) -> impl ExactSizeIterator<Item = f64> {
    bytes.as_chunks().0.iter().copied().map(double)
}

impl LayerHeader {
    pub(super) fn read(bytes: &[u8]) -> Result<Self, BufferDamage> {
        let table = BufferTable::root(bytes)?;
        let bounds: Vec<f64> = doubles(table.list(1, 8)?).collect();
        // With heights, there may be more of them.
        let bounds = match bounds[..] {
            [west, south, east, north] => Some([west, south, east, north]),
            [west, south, _, east, north, _] => Some([west, south, east, north]),
            _ => None,
        };
        let bounds = bounds.filter(|bounds| bounds.iter().all(|value| value.is_finite()));
        let bounds = bounds.filter(|[west, south, east, north]| west <= east && south <= north);
        Ok(Self {
            name: table.text(0)?.unwrap_or_default(),
            bounds,
            kind: table.field_bytes(2)?.map_or(0, |[kind]| kind),
            columns: columns(&table, 7)?,
            count: table.field_bytes(8)?.map_or(0, u64::from_le_bytes),
            fan: table.field_bytes(9)?.map_or(16, u16::from_le_bytes).into(),
            crs: system(table.table(10)?)?,
        })
    }
}

/// Returns the columns in a field of a table.
pub(super) fn columns(table: &BufferTable<'_>, number: usize) -> Result<Vec<Column>, BufferDamage> {
    let column = |table: Result<BufferTable<'_>, BufferDamage>| -> Result<Column, BufferDamage> {
        let table = table?;
        Ok(Column {
            name: table.text(0)?.ok_or("has a column without a name")?,
            kind: table.field_bytes(1)?.map_or(0, |[kind]| kind),
            is_key: table.field_bytes(9)? == Some([1]),
        })
    };
    table.tables(number)?.map(column).collect()
}

/// Returns the coordinate system that a table describes, or the reason why it is unknown.
fn system(table: Option<BufferTable<'_>>) -> Result<Checked<Crs>, BufferDamage> {
    let remedy = "specify its EPSG code: source(file, { crs = 3067 })";
    let none = Err(Error::data("the layer has no coordinate system").help(remedy));
    let Some(table) = table else { return Ok(none) };
    let organization = table.text(0)?.unwrap_or_default();
    let code = table.field_bytes(1)?.map_or(0, i32::from_le_bytes);
    let code = match (u32::try_from(code), table.text(5)?.and_then(|text| text.parse().ok())) {
        (Ok(0) | Err(_), other) => other.unwrap_or(0),
        (Ok(code), _) => code,
    };
    let name = table.text(2)?.or(table.text(3)?).unwrap_or_default();
    Ok(match code {
        0 if name.is_empty() && table.text(4)?.is_none() => none,
        1.. if organization.is_empty() || organization.eq_ignore_ascii_case("epsg") => Crs::epsg(code),
        _ => {
            let name = shown(&name);
            Err(Error::data(format!("the layer's coordinate system \"{name}\" is not an EPSG system"))
                .help(remedy))
        }
    })
}
