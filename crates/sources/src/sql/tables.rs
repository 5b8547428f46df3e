//! Layers as tables: GeoPackage layers in place or copied, and layers of other files.

use std::borrow::Cow;
use std::path::Path;
use std::sync::Arc;
use std::time::Duration;

use rusqlite::types::Value;
use rusqlite::{Connection, params_from_iter};

use crate::sql::blob;
use crate::sql::errors::{self, TableError};
use crate::sql::index::{IndexBuilder, SpatialIndex};
use crate::sql::rewrite::{SqlType, TableInfo};
use crate::sql::statement_text::quote_name;
use burgeon_base::budget::Budget;
use burgeon_base::error::{Error, Result};
use burgeon_base::text::shown;
use burgeon_data::{Attribute, GeoPackage, Layer, PackageState};
use burgeon_spatial::{Crs, Geometry, ReferenceFrame};
use glam::DVec3;

/// Maximum wait for readers before a write.
const PATIENCE: Duration = Duration::from_secs(10);

/// Maximum number of columns of a table.
const MOST_COLUMNS: usize = 1900;

/// Builds the index of a table's column.
pub(crate) fn index(
    connection: &Connection,
    table: &TableInfo,
    column: &str,
    nearest: bool,
    budget: &Arc<Budget>,
) -> std::result::Result<SpatialIndex, TableError> {
    let Some(key) = &table.key else {
        return Err(Error::internal("a table without keys has no index").into());
    };
    let sql = format!("SELECT {}, {} FROM {}", quote_name(key), quote_name(column), quote_name(&table.name));
    let mut statement = connection.prepare(&sql)?;
    let mut rows = statement.raw_query();
    let mut builder = IndexBuilder::new(nearest);
    while let Some(row) = rows.next()? {
        builder.push(row.get(0)?, row.get_ref(1)?.as_blob_or_null().unwrap_or_default(), budget)?;
    }
    Ok(builder.build())
}

/// Describes the row of a table that has these bytes as a geometry.
pub(crate) fn row_of(connection: &Connection, table: &TableInfo, bytes: &[u8]) -> Option<String> {
    let key = table.key.as_deref()?;
    table.geometries.iter().find_map(|column| {
        let sql = format!(
            "SELECT {} FROM {} WHERE {} = ?1",
            quote_name(key),
            quote_name(&table.name),
            quote_name(column)
        );
        let row: Value = connection.query_row(&sql, [bytes], |row| row.get(0)).ok()?;
        let row = match row {
            Value::Integer(number) => number.to_string(),
            Value::Text(text) => shown(&text).into_owned(),
            _ => return None,
        };
        Some(format!("{} of {} with {key} {row}", shown(column), shown(&table.name)))
    })
}

/// A layer of a GeoPackage.
pub(crate) struct FileLayer {
    /// Description of its table, under its name in the file.
    pub info: TableInfo,
    /// State of the file that is read.
    pub state: Arc<PackageState>,
    crs: Result<Crs>,
    shown: String,
    /// Declared types of the columns, which `info` names.
    kinds: Vec<String>,
}

impl FileLayer {
    /// Finds a layer in a file.
    pub(crate) fn find(path: &Path, name: &str, layer: &str, budget: &Arc<Budget>) -> Result<Self> {
        let shape = GeoPackage::shape(path, name, layer, budget)?;
        let (columns, kinds): (Vec<String>, Vec<String>) = shape.columns.into_iter().unzip();
        let info = TableInfo {
            name: layer.to_owned(),
            columns,
            kinds: kinds.iter().map(|kind| SqlType::from_declaration(kind)).collect(),
            geometries: vec![shape.geometry],
            key: shape.key,
            rows: shape.rows,
            ..TableInfo::default()
        };
        let state = PackageState::open(path, name, budget)?;
        Ok(Self { info, state, crs: shape.crs, shown: format!("{name}:{layer}"), kinds })
    }

    /// Returns true if the layer can be read in place: its coordinates are in the frame's projection, and its rows have
    /// keys.
    pub(crate) fn stays(&self, frame: Option<&ReferenceFrame>) -> Result<bool> {
        let Some(frame) = frame else { return Ok(self.info.key.is_some()) };
        let crs = self.crs.clone().map_err(|error| error.about(&self.shown))?;
        Ok(self.info.key.is_some() && frame.passage(&crs)?.stays)
    }

    /// Copies the layer as the table `name`, with coordinates in the frame's projection.
    pub(crate) fn copy(
        self,
        writer: &Connection,
        name: &str,
        frame: Option<&ReferenceFrame>,
        budget: &Arc<Budget>,
    ) -> Result<TableInfo> {
        let Self { info, state, crs, shown, kinds } = self;
        let passage = match frame {
            Some(frame) => {
                let crs = crs.map_err(|error| error.about(&shown))?;
                Some((frame.passage(&crs)?, frame.origin))
            }
            None => None,
        };
        let place = |mut geometry: Geometry| {
            if let Some((passage, origin)) = &passage {
                for point in geometry.points_mut() {
                    let [x, y] = passage.enter([point.x, point.y]);
                    *point = DVec3::new(x + origin[0], y + origin[1], point.z);
                }
            }
            geometry
        };
        let own = info.key.as_deref();
        let mut read = vec![own.map_or(Cow::Borrowed("NULL"), |key| quote_name(key).into())];
        let key = info.key.unwrap_or_else(|| free("fid", &info.columns));
        let mut columns = vec![format!("{} INTEGER PRIMARY KEY", quote_name(&key))];
        let mut names = vec![key.clone()];
        let declared = info.columns.into_iter().zip(kinds).filter(|(column, _)| *column != key);
        for (column, kind) in declared.take(MOST_COLUMNS) {
            // A custom type name would change the affinity of the column, and so the comparisons.
            let plain = ["BOOLEAN", "INTEGER", "REAL", "TEXT"]
                .into_iter()
                .find(|known| kind.eq_ignore_ascii_case(known));
            let kind = plain.unwrap_or(match kind.to_ascii_uppercase().as_str() {
                kind if kind.contains("INT") => "INTEGER",
                kind if kind.contains("CHAR") || kind.contains("TEXT") || kind.contains("DATE") => "TEXT",
                "DOUBLE" | "FLOAT" => "REAL",
                _ => "BLOB",
            });
            columns.push(format!("{} {kind}", quote_name(&column)));
            read.push(quote_name(&column).into());
            names.push(column);
        }
        let position = names.iter().position(|known| *known == info.geometries[0]);
        let declared = columns.iter().map(|column| kind_of(column)).collect();
        let work = || -> std::result::Result<usize, TableError> {
            let mut source = state.connect()?;
            let clock = Arc::clone(budget);
            source.progress_handler(1000, Some(move || clock.check().is_err()))?;
            let mut statement =
                source.prepare(&format!("SELECT {} FROM {}", read.join(", "), quote_name(&info.name)))?;
            let mut rows = statement.raw_query();
            write(writer, name, &columns, budget, || {
                let Some(row) = rows.next()? else { return Ok(None) };
                let mut values = Vec::with_capacity(names.len());
                for index in 0..names.len() {
                    let mut value: Value = row.get(index)?;
                    if let (Value::Blob(bytes), true) = (&value, Some(index) == position)
                        && let Ok(geometry) = blob::read(bytes, budget)
                    {
                        let placed = place(geometry);
                        // A geometry without a valid position in the projection becomes null.
                        value =
                            if placed.is_sound() { Value::Blob(blob::write(&placed)) } else { Value::Null };
                    }
                    values.push(value);
                }
                Ok(Some(values))
            })
        };
        let rows = work().map_err(|error| {
            errors::or_sqlite(error, |error| {
                budget.check().err().unwrap_or_else(|| {
                    Error::data(format!("cannot read {shown}: {error}"))
                        .help("the file is damaged or cut short; get it again")
                })
            })
        })?;
        state.check()?;
        Ok(TableInfo {
            name: name.to_owned(),
            key: Some(key),
            geometries: info.geometries,
            kinds: declared,
            columns: names,
            rows,
            ..TableInfo::default()
        })
    }
}

/// Returns the type of a column declaration, which starts with the name in quotes.
fn kind_of(column: &str) -> SqlType {
    SqlType::from_declaration(column.rsplit('"').next().unwrap_or_default())
}

/// Returns a name that is not in `taken`, ignoring case.
pub(crate) fn free(name: &str, taken: &[String]) -> String {
    let is_free = |name: &str| !taken.iter().any(|known| known.eq_ignore_ascii_case(name));
    if is_free(name) {
        return name.to_owned();
    }
    (2..).map(|number| format!("{name}_{number}")).find(|name| is_free(name)).unwrap_or_default()
}

/// Writes a layer, in metres relative to the run's origin, as the table `name` in the projection's coordinates.
pub(crate) fn write_layer(
    writer: &Connection,
    name: &str,
    layer: &Layer,
    budget: &Budget,
) -> Result<TableInfo> {
    let mut taken: Vec<String> = Vec::new();
    let mut is_column: Vec<bool> = Vec::new();
    for own in &layer.names {
        // Attributes that cannot be columns are skipped: those without a name, with a NUL in it, or above the limit.
        let kept = taken.len() < MOST_COLUMNS && !own.is_empty() && !own.contains('\0');
        if kept {
            taken.push(free(own, &taken));
        }
        is_column.push(kept);
    }
    let has_id = taken.iter().any(|known| known.eq_ignore_ascii_case("id"));
    let key = free("fid", &taken);
    let geometry = free("geom", &taken);
    let kinds = kinds(layer);
    let mut columns = vec![format!("{} INTEGER PRIMARY KEY", quote_name(&key))];
    let mut names = vec![key.clone()];
    if !has_id {
        columns.push("\"id\" TEXT".into());
        names.push("id".into());
    }
    let kept = kinds.into_iter().zip(&is_column).filter(|(_, is_column)| **is_column);
    for (column, (kind, _)) in taken.into_iter().zip(kept) {
        columns.push(format!("{} {kind}", quote_name(&column)));
        names.push(column);
    }
    columns.push(format!("{} BLOB", quote_name(&geometry)));
    names.push(geometry.clone());
    let declared = columns.iter().map(|column| kind_of(column)).collect();
    let [x, y] = layer.origin;
    let mut features = layer.features.iter().zip(1i64..);
    let next = || -> std::result::Result<Option<Vec<Value>>, TableError> {
        let Some((feature, number)) = features.next() else { return Ok(None) };
        let mut values = vec![Value::Integer(number)];
        if !has_id {
            values.push(Value::Text(feature.id.to_string()));
        }
        let mut own: Vec<Value> = vec![Value::Null; layer.names.len()];
        for (index, attribute) in feature.attributes.iter() {
            if let Some(place) = own.get_mut(*index) {
                *place = match attribute {
                    Attribute::Boolean(value) => Value::Integer(i64::from(*value)),
                    Attribute::Number(value) => Value::Real(*value),
                    Attribute::Text(text) => Value::Text(text.to_string()),
                    Attribute::Nested(value) => Value::Text(value.to_string()),
                };
            }
        }
        let kept = own.into_iter().zip(&is_column).filter(|(_, is_column)| **is_column);
        values.extend(kept.map(|(value, _)| value));
        let mut placed = feature.geometry.clone();
        placed.points_mut().for_each(|point| *point += DVec3::new(x, y, 0.0));
        values.push(Value::Blob(blob::write(&placed)));
        Ok(Some(values))
    };
    let rows = write(writer, name, &columns, budget, next)
        .map_err(|error| errors::or_sqlite(error, |error| errors::internal(error).about(&layer.shown)))?;
    Ok(TableInfo {
        name: name.to_owned(),
        key: Some(key),
        geometries: vec![geometry],
        kinds: declared,
        columns: names,
        rows,
        ..TableInfo::default()
    })
}

/// Returns the declared types of a layer's attribute columns: the common type of their values.
fn kinds(layer: &Layer) -> Vec<&'static str> {
    let mut kinds: Vec<Option<&'static str>> = vec![None; layer.names.len()];
    for (index, attribute) in layer.features.iter().flat_map(|feature| feature.attributes.iter()) {
        let kind = match attribute {
            Attribute::Boolean(_) => "BOOLEAN",
            Attribute::Number(number) if number.fract() == 0.0 && number.abs() < 9e15 => "INTEGER",
            Attribute::Number(_) => "REAL",
            Attribute::Text(_) | Attribute::Nested(_) => "TEXT",
        };
        let Some(known) = kinds.get_mut(*index) else { continue };
        *known = Some(match *known {
            None => kind,
            Some(known) if known == kind => kind,
            Some("INTEGER" | "REAL") if matches!(kind, "INTEGER" | "REAL") => "REAL",
            // Values of different types stay unchanged.
            Some(_) => "BLOB",
        });
    }
    kinds.into_iter().map(|kind| kind.unwrap_or("TEXT")).collect()
}

/// Creates a table with the rows that `next` returns, and returns their number.
pub(crate) fn write(
    writer: &Connection,
    name: &str,
    columns: &[String],
    budget: &Budget,
    mut next: impl FnMut() -> std::result::Result<Option<Vec<Value>>, TableError>,
) -> std::result::Result<usize, TableError> {
    writer.busy_timeout(PATIENCE)?;
    let transaction = writer.unchecked_transaction()?;
    transaction.execute_batch(&format!("CREATE TABLE {} ({})", quote_name(name), columns.join(", ")))?;
    let marks = vec!["?"; columns.len()].join(", ");
    let mut insert = transaction.prepare(&format!("INSERT INTO {} VALUES ({marks})", quote_name(name)))?;
    let mut count = 0;
    while let Some(values) = next()? {
        budget.tick()?;
        budget.take(values.iter().map(weight).sum())?;
        insert.execute(params_from_iter(values))?;
        count += 1;
    }
    drop(insert);
    transaction.commit()?;
    Ok(count)
}

fn weight(value: &Value) -> usize {
    match value {
        Value::Null => 1,
        Value::Integer(_) | Value::Real(_) => 9,
        Value::Text(text) => 4 + text.len(),
        Value::Blob(bytes) => 4 + bytes.len(),
    }
}
