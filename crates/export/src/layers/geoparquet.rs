//! Writer of GeoParquet 1.1: one table of several layers, with geometries in degrees.

use std::collections::BTreeSet;
use std::sync::Arc;

use parquet::basic::{LogicalType, Repetition, Type as ColumnType};
use parquet::data_type::{BoolType, ByteArray, ByteArrayType, DataType, DoubleType, Int64Type};
use parquet::errors::ParquetError;
use parquet::file::metadata::KeyValue;
use parquet::file::properties::WriterProperties;
use parquet::file::writer::{SerializedFileWriter, SerializedRowGroupWriter};
use parquet::schema::types::{Type, TypePtr};
use serde_json::json;

use super::place::OutputPlacement;
use super::{ColumnKind, TableColumn};
use burgeon_base::error::{Error, Result};
use burgeon_spatial::{Attribute, Geometry, Record, RecordTable, ReferenceFrame};

/// Returns a GeoParquet file with a row for each record of `tables`: the columns `layer` and `id`, then `columns`, then `geometry`
/// (well-known binary in degrees of WGS 84).
///
/// All files with the same `columns` have the same schema, so programs read them as one table. If a column is called as one of the
/// others, its name gets a number. Values of another type than that of their column are written as text, or left out. Fails if a
/// position has no longitude and latitude.
pub fn write_geoparquet(
    tables: &[RecordTable],
    columns: &[TableColumn],
    frame: &ReferenceFrame,
) -> Result<Vec<u8>> {
    let rows: Vec<TableRow<'_>> = tables
        .iter()
        .flat_map(|table| table.records.iter().map(move |record| TableRow { table, record }))
        .collect();
    let geometries = Geometries::new(&rows, &OutputPlacement::degrees(frame)?)?;
    write(&rows, columns, &geometries)
        .map_err(|error| Error::internal(format!("cannot write the GeoParquet file: {error}")))
}

/// Record of a table.
struct TableRow<'a> {
    table: &'a RecordTable,
    record: &'a Record,
}

/// Geometries in degrees.
struct Geometries {
    /// Well-known binary of each row, if it has a geometry.
    binary: Vec<Option<Vec<u8>>>,
    /// Names of the types that occur.
    types: BTreeSet<String>,
    /// West, south, east and north (degrees); `None` without points.
    bounds: Option<[f64; 4]>,
}

impl Geometries {
    fn new(rows: &[TableRow<'_>], outward: &OutputPlacement<'_>) -> Result<Self> {
        let mut all = Self { binary: Vec::new(), types: BTreeSet::new(), bounds: None };
        for TableRow { table, record } in rows {
            let Some(geometry) = &record.geometry else {
                all.binary.push(None);
                continue;
            };
            let mut degrees = geometry.clone();
            for point in degrees.points_mut() {
                *point = outward.place(*point).ok_or_else(|| {
                    let id = burgeon_base::text::shown(&record.id);
                    Error::data(format!("{id} of the layer {} has no longitude and latitude", table.name))
                        .help("remove it from the data")
                })?;
                let [west, south, east, north] = all.bounds.unwrap_or([point.x, point.y, point.x, point.y]);
                all.bounds =
                    Some([west.min(point.x), south.min(point.y), east.max(point.x), north.max(point.y)]);
            }
            all.types.insert(type_name(&degrees));
            all.binary.push(Some(degrees.to_wkb()));
        }
        Ok(all)
    }

    /// Returns the description that readers of geometries need.
    fn metadata(&self) -> String {
        let mut column = json!({ "encoding": "WKB", "geometry_types": self.types });
        if let Some(bounds) = self.bounds {
            column["bbox"] = json!(bounds);
        }
        json!({ "version": "1.1.0", "primary_column": GEOMETRY, "columns": { GEOMETRY: column } }).to_string()
    }
}

/// Geometry column.
const GEOMETRY: &str = "geometry";

/// Returns the name of the type of a geometry, as GeoParquet has it.
fn type_name(geometry: &Geometry) -> String {
    let name = geometry.kind().geojson();
    if geometry.has_heights() { format!("{name} Z") } else { name.to_owned() }
}

/// Returns the names of the columns: of layers, ids, attributes and geometries, without duplicates.
fn names(columns: &[TableColumn]) -> Vec<String> {
    let mut names: Vec<String> = ["layer", "id", GEOMETRY].map(str::to_owned).to_vec();
    for column in columns {
        let mut name = column.name.clone();
        let mut number = 1;
        while names.contains(&name) {
            number += 1;
            name = format!("{}_{number}", column.name);
        }
        names.push(name);
    }
    let geometry = names.remove(2);
    names.push(geometry);
    names
}

fn schema(columns: &[TableColumn]) -> Result<TypePtr, ParquetError> {
    let text = (ColumnType::BYTE_ARRAY, Some(LogicalType::String));
    let kinds = columns.iter().map(|column| match column.kind {
        ColumnKind::Boolean => (ColumnType::BOOLEAN, None),
        ColumnKind::Integer => (ColumnType::INT64, None),
        ColumnKind::Number => (ColumnType::DOUBLE, None),
        ColumnKind::Text => (ColumnType::BYTE_ARRAY, Some(LogicalType::String)),
    });
    let kinds = [text.clone(), text].into_iter().chain(kinds).chain([(ColumnType::BYTE_ARRAY, None)]);
    let fields = names(columns).into_iter().zip(kinds).map(|(name, (kind, meaning))| {
        let field = Type::primitive_type_builder(&name, kind);
        field.with_repetition(Repetition::OPTIONAL).with_logical_type(meaning).build().map(Arc::new)
    });
    let fields = fields.collect::<Result<Vec<TypePtr>, _>>()?;
    Type::group_type_builder("schema").with_fields(fields).build().map(Arc::new)
}

fn write(
    rows: &[TableRow<'_>],
    columns: &[TableColumn],
    geometries: &Geometries,
) -> Result<Vec<u8>, ParquetError> {
    let about = vec![KeyValue::new("geo".to_owned(), geometries.metadata())];
    let maker = format!("Burgeon {}", env!("CARGO_PKG_VERSION"));
    let properties = WriterProperties::builder().set_created_by(maker).set_key_value_metadata(Some(about));
    let mut file = SerializedFileWriter::new(Vec::new(), schema(columns)?, Arc::new(properties.build()))?;
    let mut group = file.next_row_group()?;
    let text = |value: &str| Some(ByteArray::from(value.as_bytes().to_vec()));
    column::<ByteArrayType>(&mut group, rows.iter().map(|row| text(&row.table.name)))?;
    column::<ByteArrayType>(&mut group, rows.iter().map(|row| text(&row.record.id)))?;
    for TableColumn { name, kind } in columns {
        let values = rows.iter().map(|row| {
            let number = row.table.columns.iter().position(|known| known == name)?;
            row.record.value(number)
        });
        match kind {
            ColumnKind::Boolean => column::<BoolType>(&mut group, values.map(boolean))?,
            ColumnKind::Integer => column::<Int64Type>(&mut group, values.map(integer))?,
            ColumnKind::Number => column::<DoubleType>(&mut group, values.map(number))?,
            ColumnKind::Text => {
                column::<ByteArrayType>(&mut group, values.map(|value| text(&value?.text())))?;
            }
        }
    }
    column::<ByteArrayType>(&mut group, geometries.binary.iter().map(|it| it.clone().map(ByteArray::from)))?;
    group.close()?;
    file.into_inner()
}

fn boolean(value: Option<&Attribute>) -> Option<bool> {
    if let Some(Attribute::Boolean(value)) = value { Some(*value) } else { None }
}

fn number(value: Option<&Attribute>) -> Option<f64> {
    if let Some(Attribute::Number(value)) = value { Some(*value) } else { None }
}

fn integer(value: Option<&Attribute>) -> Option<i64> {
    #[allow(
        clippy::cast_possible_truncation,
        reason = "values of a column of integers are integers below 2^53"
    )]
    number(value).filter(|value| value.fract() == 0.0).map(|value| value as i64)
}

/// Writes the next column, in which values may be missing.
fn column<T: DataType>(
    group: &mut SerializedRowGroupWriter<'_, Vec<u8>>,
    values: impl Iterator<Item = Option<T::T>>,
) -> Result<(), ParquetError> {
    let values: Vec<Option<T::T>> = values.collect();
    let levels: Vec<i16> = values.iter().map(|value| i16::from(value.is_some())).collect();
    let values: Vec<T::T> = values.into_iter().flatten().collect();
    let missing = || ParquetError::General("a column is missing".to_owned());
    let mut writer = group.next_column()?.ok_or_else(missing)?;
    writer.typed::<T>().write_batch(&values, Some(&levels), None)?;
    writer.close()
}
