//! SQLite database of a GeoPackage.

use std::borrow::Cow;
use std::path::Path;
use std::sync::Arc;

use super::connection::{guard, quote, run_watched};
use super::errors::{query_error, read_error};
use super::state::PackageState;
use crate::features::table::FeatureTable;
use crate::formats::blob::{envelope, read_blob};
use crate::layer_choice::choose_layer;
use crate::source_options::{RecordChoice, SourceOptions};
use burgeon_base::budget::Budget;
use burgeon_base::error::{Error, Result};
use burgeon_base::text::shown;
use burgeon_kit::Attribute;
use burgeon_spatial::Crs;
use rusqlite::types::ValueRef;
use rusqlite::{Connection, OptionalExtension};

/// Page cache of a connection (KiB).
const PAGES: i64 = 256;

/// Open GeoPackage.
pub struct GeoPackage {
    connection: Connection,
    state: Arc<PackageState>,
    name: String,
    layers: Vec<LayerDescription>,
    /// Tables of spatial indices that were opened.
    indices: Vec<String>,
}

/// Description of a layer from the package's own tables.
struct LayerDescription {
    table: String,
    column: String,
    crs: Result<Crs>,
}

impl GeoPackage {
    pub(crate) fn open(path: &Path, name: &str, wanted: &SourceOptions) -> Result<Self> {
        let state = PackageState::open(path, name, &wanted.budget)?;
        let (owned, budget) = (name.to_owned(), Arc::clone(&wanted.budget));
        let is_indexed = wanted.records == Some(RecordChoice::Indexed);
        run_watched(state.connect()?, &wanted.budget, move |connection| {
            Self::with(connection, state, owned, &budget, is_indexed)
        })
    }

    fn with(
        mut connection: Connection,
        state: Arc<PackageState>,
        name: String,
        budget: &Arc<Budget>,
        is_indexed: bool,
    ) -> Result<Self> {
        let error = |error: rusqlite::Error| read_error(&name, &error);
        let indices = if is_indexed { open_indices(&connection) } else { Vec::new() };
        // Rows are read once, in order, so a small page cache suffices.
        connection.pragma_update(None, "cache_size", -PAGES).map_err(error)?;
        guard(&mut connection, budget).map_err(error)?;
        let layers = match read_layers(&connection) {
            Ok(layers) => layers,
            Err(rusqlite::Error::SqliteFailure(_, Some(text))) if text.starts_with("no such table") => {
                // A GeoPackage without features, such as one of tables or images, needs no geometry columns.
                if !text.contains("gpkg_geometry_columns") {
                    return Err(Error::data(format!("{name} is an SQLite database, but not a GeoPackage"))
                        .help("a GeoPackage has the tables gpkg_contents and gpkg_geometry_columns"));
                }
                Vec::new()
            }
            Err(error) => return Err(read_error(&name, &error)),
        };
        Ok(Self { connection, state, name, layers, indices })
    }

    pub(crate) fn layers(&self) -> Vec<&str> {
        self.layers.iter().map(|layer| layer.table.as_str()).collect()
    }

    pub(crate) fn read(self, layer: &str, wanted: &SourceOptions) -> Result<FeatureTable> {
        let Self { connection, state, name, layers, indices } = self;
        let (layer, own) = (layer.to_owned(), wanted.clone());
        run_watched(connection, &wanted.budget, move |connection| {
            let opened = Self { connection, state: Arc::clone(&state), name, layers, indices };
            let read = opened.table(&layer, &own);
            // An error may be caused by reading two different states.
            state.check()?;
            read
        })
    }

    fn table(self, layer: &str, wanted: &SourceOptions) -> Result<FeatureTable> {
        let Self { connection, state: _, name, layers, indices } = self;
        let error = |error: rusqlite::Error| read_error(&name, &error);
        let Some(described) = layers.into_iter().find(|known| known.table == layer) else {
            return Err(Error::not_found("layer", layer, [], format!("{name}: no layer named `{layer}`")));
        };
        let label = format!("{name}:{}", shown(layer));
        let mut table = FeatureTable::new(layer, &label, described.crs, wanted);
        let metres = match wanted.crs {
            Some(code) => Crs::epsg(code).map_or(1.0, |crs| crs.metres()),
            None => table.crs.as_ref().map_or(1.0, Crs::metres),
        };
        let near = burgeon_spatial::wkb::NEAR / metres;
        let columns = LayerColumns::read(&connection, layer, &described.column).map_err(error)?;
        let index = format!("rtree_{layer}_{}", described.column);
        let index = indices.iter().find(|known| known.eq_ignore_ascii_case(&index));
        let sql = columns.select((layer, &described.column), index.map(String::as_str), wanted);
        let LayerColumns { names, booleans, key: _ } = columns;
        table.names = names;
        let id = match &wanted.id {
            Some(id) => Some(table.column(id)?),
            None => table.names.iter().position(|name| name.eq_ignore_ascii_case("id")),
        };
        let mut statement =
            connection.prepare(&sql).map_err(|error| query_error(&table.shown, wanted, &error))?;
        let mut rows = statement.query([]).map_err(|error| query_error(&table.shown, wanted, &error))?;
        let mut count: usize = 0;
        while let Some(row) = rows.next().map_err(|error| query_error(&table.shown, wanted, &error))? {
            count += 1;
            let first = row.get_ref(0).ok();
            if let Some(ValueRef::Integer(key)) = first {
                table.last_key = Some(key);
            }
            let key = first.and_then(id_text).unwrap_or_else(|| count.to_string());
            let id = id.and_then(|id| id_text(row.get_ref(id + 2).ok()?)).unwrap_or(key);
            let wrong = |why: &str| {
                Error::data(format!("the geometry of feature {} of {label} {why}", shown(&id))).help(
                    "supported types are points, lines, polygons, curves, surfaces and collections of these",
                )
            };
            let parts = match row.get_ref(1).map_err(error)? {
                ValueRef::Null => Vec::new(),
                ValueRef::Blob(blob) => match read_blob(blob, near, &wanted.budget) {
                    Ok(parts) => parts,
                    Err(why) => {
                        // The error may be an exceeded time limit instead of an invalid geometry.
                        wanted.budget.check()?;
                        let error = wrong(&why);
                        table.refuse_at(id, error, envelope(blob))?;
                        continue;
                    }
                },
                _ => {
                    let error = wrong("is not a GeoPackage geometry");
                    table.refuse(id, error)?;
                    continue;
                }
            };
            let mut attributes = Vec::new();
            for (index, is_boolean) in booleans.iter().enumerate() {
                let value = match row.get_ref(index + 2).map_err(error)? {
                    ValueRef::Integer(value) if *is_boolean => Attribute::Boolean(value != 0),
                    #[allow(clippy::cast_precision_loss, reason = "Lua's own numbers are f64")]
                    ValueRef::Integer(value) => Attribute::Number(value as f64),
                    ValueRef::Real(value) => Attribute::Number(value),
                    ValueRef::Text(text) => table.text(&String::from_utf8_lossy(text)),
                    ValueRef::Null | ValueRef::Blob(_) => continue,
                };
                attributes.push((index, value));
            }
            table.push(&id, parts, attributes)?;
            if table.is_full() {
                break;
            }
        }
        Ok(table)
    }
}

/// Properties of a layer's table that are known without reading its features.
#[derive(Debug)]
pub struct TableShape {
    /// Integer primary key column; `None` for a view.
    pub key: Option<String>,
    /// Geometry column.
    pub geometry: String,
    /// Names of all columns, with their declared types.
    pub columns: Vec<(String, String)>,
    /// Number of rows.
    pub rows: usize,
    /// Coordinate system, or the reason why it is unknown.
    pub crs: Result<Crs>,
}

impl GeoPackage {
    /// Returns the properties of the layer `layer` in the file at `path`, called `name` in messages.
    pub fn shape(path: &Path, name: &str, layer: &str, budget: &Arc<Budget>) -> Result<TableShape> {
        let wanted = SourceOptions { budget: Arc::clone(budget), ..SourceOptions::default() };
        let mut package = Self::open(path, name, &wanted)?;
        let layer = choose_layer(name, &package.layers(), Some(layer))?;
        let position = package.layers.iter().position(|known| known.table == layer).unwrap_or_default();
        let LayerDescription { column, crs, .. } = package.layers.swap_remove(position);
        let name = name.to_owned();
        run_watched(package.connection, budget, move |connection| {
            let read = || -> rusqlite::Result<TableShape> {
                let mut shape = TableShape { key: None, geometry: column, columns: Vec::new(), rows: 0, crs };
                let mut statement = connection.prepare(&format!("PRAGMA table_info({})", quote(&layer)))?;
                let mut rows = statement.query([])?;
                while let Some(row) = rows.next()? {
                    let (name, kind, key): (String, String, i64) = (row.get(1)?, row.get(2)?, row.get(5)?);
                    if key == 1 && kind.eq_ignore_ascii_case("integer") {
                        shape.key = Some(name.clone());
                    }
                    // Names are case-insensitive.
                    if name.eq_ignore_ascii_case(&shape.geometry) {
                        shape.geometry.clone_from(&name);
                    }
                    shape.columns.push((name, kind));
                }
                let count: i64 =
                    connection.query_row(&format!("SELECT count(*) FROM {}", quote(&layer)), [], |row| {
                        row.get(0)
                    })?;
                shape.rows = usize::try_from(count).unwrap_or(0);
                Ok(shape)
            };
            read().map_err(|error| read_error(&name, &error))
        })
    }
}

/// Opens the spatial indices of all layers, before the connection is restricted, and returns their tables. An index that
/// cannot be opened is not used.
///
/// Source: OGC 12-128r18, GeoPackage Encoding Standard, extension `gpkg_rtree_index`.
fn open_indices(connection: &Connection) -> Vec<String> {
    let find = || -> rusqlite::Result<Vec<String>> {
        let mut statement = connection.prepare(
            "SELECT 'rtree_' || table_name || '_' || column_name FROM gpkg_extensions \
             WHERE extension_name = 'gpkg_rtree_index' AND column_name IS NOT NULL",
        )?;
        statement.query_map([], |row| row.get(0))?.collect()
    };
    let mut names = find().unwrap_or_default();
    names.retain(|name| {
        let columns = format!("SELECT id, minx, maxx, miny, maxy FROM {} LIMIT 1", quote(name));
        let read = || -> rusqlite::Result<bool> {
            connection.prepare(&columns)?.query([])?.next().map(|row| row.is_some())
        };
        read().unwrap_or(false)
    });
    names
}

/// Returns the feature layers in file order.
fn read_layers(connection: &Connection) -> rusqlite::Result<Vec<LayerDescription>> {
    let mut statement = connection.prepare(
        "SELECT c.table_name, g.column_name, g.srs_id FROM gpkg_contents c \
         JOIN gpkg_geometry_columns g ON g.table_name = c.table_name \
         WHERE c.data_type = 'features' ORDER BY c.rowid",
    )?;
    let mut rows = statement.query([])?;
    let mut layers = Vec::new();
    while let Some(row) = rows.next()? {
        layers.push(LayerDescription {
            table: row.get(0)?,
            column: row.get(1)?,
            crs: system(connection, row.get(2)?)?,
        });
    }
    Ok(layers)
}

/// Returns the coordinate system with a package's own number.
fn system(connection: &Connection, number: i64) -> rusqlite::Result<Result<Crs>> {
    let found: Option<(Option<String>, Option<String>, Option<i64>)> = connection
        .query_row(
            "SELECT srs_name, organization, organization_coordsys_id FROM gpkg_spatial_ref_sys WHERE srs_id = ?1",
            [number],
            |row| Ok((row.get(0)?, row.get(1)?, row.get(2)?)),
        )
        .optional()?;
    let remedy = "specify its EPSG code: source(file, { crs = 3067 })";
    Ok(match found {
        _ if number == 0 || number == -1 => {
            Err(Error::data("the layer has no coordinate system").help(remedy))
        }
        Some((_, Some(organization), Some(code))) if organization.eq_ignore_ascii_case("epsg") => {
            Crs::epsg(u32::try_from(code).unwrap_or(0))
        }
        Some((name, ..)) => {
            let name = name.unwrap_or_default();
            Err(Error::data(format!(
                "the layer's coordinate system \"{}\" is not an EPSG system",
                shown(&name)
            ))
            .help(remedy))
        }
        None => {
            Err(Error::data(format!("the file does not describe the layer's coordinate system {number}"))
                .help(remedy))
        }
    })
}

/// Columns of a layer, with the key separate and without the geometry.
struct LayerColumns {
    names: Vec<String>,
    booleans: Vec<bool>,
    key: Option<String>,
}

impl LayerColumns {
    fn read(connection: &Connection, layer: &str, geometry: &str) -> rusqlite::Result<Self> {
        let mut columns = Self { names: Vec::new(), booleans: Vec::new(), key: None };
        let mut statement = connection.prepare(&format!("PRAGMA table_info({})", quote(layer)))?;
        let mut rows = statement.query([])?;
        while let Some(row) = rows.next()? {
            let (name, kind, key): (String, String, i64) = (row.get(1)?, row.get(2)?, row.get(5)?);
            if key == 1 && columns.key.is_none() {
                columns.key = Some(name);
            } else if !name.eq_ignore_ascii_case(geometry) {
                columns.names.push(name);
                columns.booleans.push(kind.eq_ignore_ascii_case("boolean"));
            }
        }
        Ok(columns)
    }

    /// Returns the statement that reads a layer, with its table and its geometry column, by a spatial index if there is one.
    fn select(&self, (layer, geometry): (&str, &str), index: Option<&str>, wanted: &SourceOptions) -> String {
        let key = self.key.as_deref().map_or(Cow::Borrowed("NULL"), |key| quote(key).into());
        let mut sql = format!("SELECT {key}, {}", quote(geometry));
        for name in &self.names {
            sql += &format!(", {}", quote(name));
        }
        sql += &format!(" FROM {}", quote(layer));
        let mut conditions = Vec::new();
        let (mut most, keyed) = (None, self.key.is_some());
        match (wanted.records, wanted.within, index) {
            (Some(RecordChoice::After { key: last, most: limit }), ..) if keyed => {
                conditions.push(format!("{key} > {last}"));
                most = Some(limit);
            }
            (Some(RecordChoice::Indexed), Some([west, south, east, north]), Some(index)) if keyed => {
                conditions.push(format!(
                    "{key} IN (SELECT id FROM {} WHERE maxx >= {west:?} AND minx <= {east:?} AND maxy >= {south:?} AND miny <= {north:?})",
                    quote(index)
                ));
            }
            _ => {}
        }
        // The line break ends a comment in the condition.
        conditions.extend(wanted.condition.as_ref().map(|condition| format!("(\n{condition}\n)")));
        if !conditions.is_empty() {
            sql += &format!(" WHERE {}", conditions.join(" AND "));
        }
        if keyed {
            sql += &format!(" ORDER BY {key}");
        }
        if let Some(most) = most {
            sql += &format!(" LIMIT {most}");
        }
        sql
    }
}

fn id_text(value: ValueRef<'_>) -> Option<String> {
    match value {
        ValueRef::Integer(value) => Some(value.to_string()),
        ValueRef::Real(value) => Some(value.to_string()),
        ValueRef::Text(text) if !text.is_empty() => Some(String::from_utf8_lossy(text).into_owned()),
        _ => None,
    }
}
