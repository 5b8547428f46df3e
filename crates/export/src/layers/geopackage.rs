//! Writer of GeoPackages: SQLite databases of layers according to OGC 12-128r18, with R-trees.

use std::borrow::Cow;

use glam::DVec3;
use rusqlite::types::Value as Cell;
use rusqlite::{Connection, params, params_from_iter};

use super::{ColumnKind, OutputPlacement, column_kinds};
use burgeon_base::error::{Error, Result};
use burgeon_base::stop::Stop;
use burgeon_spatial::crs::definition;
use burgeon_spatial::{Attribute, Geometry, Record, RecordTable, ReferenceFrame};

/// Tables of every GeoPackage. The time of change is constant, so the same layers yield the same bytes.
const SCHEMA: &str = "
PRAGMA application_id = 1196444487;
PRAGMA user_version = 10300;
CREATE TABLE gpkg_spatial_ref_sys (
  srs_name TEXT NOT NULL, srs_id INTEGER NOT NULL PRIMARY KEY, organization TEXT NOT NULL,
  organization_coordsys_id INTEGER NOT NULL, definition TEXT NOT NULL, description TEXT);
CREATE TABLE gpkg_contents (
  table_name TEXT NOT NULL PRIMARY KEY, data_type TEXT NOT NULL, identifier TEXT UNIQUE, description TEXT DEFAULT '',
  last_change DATETIME NOT NULL DEFAULT (strftime('%Y-%m-%dT%H:%M:%fZ','now')),
  min_x DOUBLE, min_y DOUBLE, max_x DOUBLE, max_y DOUBLE, srs_id INTEGER,
  CONSTRAINT fk_gc_r_srs_id FOREIGN KEY (srs_id) REFERENCES gpkg_spatial_ref_sys(srs_id));
CREATE TABLE gpkg_geometry_columns (
  table_name TEXT NOT NULL, column_name TEXT NOT NULL, geometry_type_name TEXT NOT NULL, srs_id INTEGER NOT NULL,
  z TINYINT NOT NULL, m TINYINT NOT NULL,
  CONSTRAINT pk_geom_cols PRIMARY KEY (table_name, column_name), CONSTRAINT uk_gc_table_name UNIQUE (table_name),
  CONSTRAINT fk_gc_tn FOREIGN KEY (table_name) REFERENCES gpkg_contents(table_name),
  CONSTRAINT fk_gc_srs FOREIGN KEY (srs_id) REFERENCES gpkg_spatial_ref_sys (srs_id));
CREATE TABLE gpkg_extensions (
  table_name TEXT, column_name TEXT, extension_name TEXT NOT NULL, definition TEXT NOT NULL, scope TEXT NOT NULL,
  CONSTRAINT ge_tce UNIQUE (table_name, column_name, extension_name));
INSERT INTO gpkg_spatial_ref_sys VALUES
  ('Undefined cartesian SRS', -1, 'NONE', -1, 'undefined', 'undefined cartesian coordinate reference system'),
  ('Undefined geographic SRS', 0, 'NONE', 0, 'undefined', 'undefined geographic coordinate reference system');
";

/// Time of the last change of every layer.
const CHANGED: &str = "1970-01-01T00:00:00.000Z";

/// Geometry column.
const GEOMETRY: &str = "geom";

/// Accepts GeoPackages; fails in programs built without them.
pub fn check_geopackage() -> Result<()> {
    Ok(())
}

/// Returns a GeoPackage with a layer for each of `tables`, in the projection of `frame`; in degrees if that projection
/// is specific to the run.
///
/// Fails if a position cannot be transformed, and if `stop` was requested.
pub fn write_geopackage(
    tables: &[RecordTable],
    frame: Option<&ReferenceFrame>,
    stop: &Stop,
) -> Result<Vec<u8>> {
    let outward = OutputPlacement::native(frame)?;
    let mut package = PackageWriter {
        database: Connection::open_in_memory().map_err(output_error)?,
        outward,
        names: Vec::new(),
    };
    package.database.execute_batch(SCHEMA).map_err(output_error)?;
    package.write_systems()?;
    for table in tables {
        package.write_layer(table, stop)?;
    }
    package.database.execute_batch("VACUUM").map_err(output_error)?;
    Ok(package.database.serialize("main").map_err(output_error)?.to_vec())
}

#[allow(clippy::needless_pass_by_value, reason = "as map_err gives it")]
fn output_error(error: rusqlite::Error) -> Error {
    Error::internal(format!("cannot write the GeoPackage: {error}"))
}

/// GeoPackage that is being written.
struct PackageWriter<'a> {
    database: Connection,
    outward: OutputPlacement<'a>,
    names: Vec<String>,
}

/// Bounding box: minimum x and y, then maximum x and y.
type LayerBox = [f64; 4];

const NOWHERE: LayerBox = [f64::INFINITY, f64::INFINITY, f64::NEG_INFINITY, f64::NEG_INFINITY];

impl PackageWriter<'_> {
    /// Returns the code of the coordinate system; -1 for undefined Cartesian coordinates.
    fn system(&self) -> i32 {
        self.outward.code.map_or(-1, i32::from)
    }

    fn write_systems(&self) -> Result<()> {
        let mut codes = vec![4326];
        codes.extend(self.outward.code.filter(|code| *code != 4326));
        for code in codes {
            let Some(definition) = definition(code)? else { continue };
            let name = definition.split('"').nth(1).unwrap_or_default();
            let insert = "INSERT INTO gpkg_spatial_ref_sys VALUES (?1, ?2, 'EPSG', ?2, ?3, NULL)";
            self.database.execute(insert, params![name, code, definition]).map_err(output_error)?;
        }
        Ok(())
    }

    fn write_layer(&mut self, table: &RecordTable, stop: &Stop) -> Result<()> {
        let name = self.table_name(&table.name);
        let (columns, kinds) = (column_names(table), column_kinds(table));
        let high =
            table.records.iter().filter_map(|record| record.geometry.as_ref()).any(Geometry::has_heights);
        let kind = kind_name(table);
        let mut create =
            format!("CREATE TABLE {} (fid INTEGER PRIMARY KEY NOT NULL, {GEOMETRY} {kind}", quote(&name));
        for (column, kind) in columns.iter().zip(std::iter::once(&ColumnKind::Text).chain(&kinds)) {
            let kind = match kind {
                ColumnKind::Boolean => "BOOLEAN",
                ColumnKind::Integer => "INTEGER",
                ColumnKind::Number => "REAL",
                ColumnKind::Text => "TEXT",
            };
            create.push_str(&format!(", {} {kind}", quote(column)));
        }
        create.push(')');
        self.database.execute_batch(&format!("{create}; BEGIN")).map_err(output_error)?;
        let bounds = self.write_records(table, &name, &kinds, high, stop)?;
        let [min_x, min_y, max_x, max_y] = bounds.map(|it| it.is_finite().then_some(it));
        let insert = "INSERT INTO gpkg_contents VALUES (?1, 'features', ?2, '', ?3, ?4, ?5, ?6, ?7, ?8)";
        let row = params![name, table.name, CHANGED, min_x, min_y, max_x, max_y, self.system()];
        self.database.execute(insert, row).map_err(output_error)?;
        let insert = "INSERT INTO gpkg_geometry_columns VALUES (?1, ?2, ?3, ?4, ?5, 0)";
        self.database
            .execute(insert, params![name, GEOMETRY, kind, self.system(), i32::from(high)])
            .map_err(output_error)?;
        let insert = "INSERT INTO gpkg_extensions VALUES (?1, ?2, 'gpkg_rtree_index', \
                      'http://www.geopackage.org/spec120/#extension_rtree', 'write-only')";
        self.database.execute(insert, params![name, GEOMETRY]).map_err(output_error)?;
        self.database.execute_batch(&format!("{} COMMIT", triggers(&name))).map_err(output_error)
    }

    /// Writes the records and their R-tree. Returns the bounding box of all records.
    fn write_records(
        &self,
        table: &RecordTable,
        name: &str,
        kinds: &[ColumnKind],
        high: bool,
        stop: &Stop,
    ) -> Result<LayerBox> {
        let tree = quote(&format!("rtree_{name}_{GEOMETRY}"));
        let create = format!("CREATE VIRTUAL TABLE {tree} USING rtree(id, minx, maxx, miny, maxy)");
        self.database.execute_batch(&create).map_err(output_error)?;
        let places = vec!["?"; 3 + kinds.len()].join(", ");
        let insert = format!("INSERT INTO {} VALUES ({places})", quote(name));
        let mut insert = self.database.prepare(&insert).map_err(output_error)?;
        let mut index = self
            .database
            .prepare(&format!("INSERT INTO {tree} VALUES (?, ?, ?, ?, ?)"))
            .map_err(output_error)?;
        let mut all = NOWHERE;
        for (number, record) in (1_i64..).zip(&table.records) {
            stop.check()?;
            let mut cells = vec![Cell::Integer(number), Cell::Null, Cell::Text(record.id.clone())];
            if let Some(geometry) = &record.geometry {
                let mut writer = BlobWriter { outward: &self.outward, high, bounds: NOWHERE };
                let mut turned = geometry.clone();
                turned.turn();
                let blob =
                    writer.blob(&turned, self.system()).ok_or_else(|| position_error(record, table))?;
                let bounds @ [low_x, low_y, high_x, high_y] = writer.bounds;
                if low_x <= high_x {
                    index.execute(params![number, low_x, high_x, low_y, high_y]).map_err(output_error)?;
                    all = join_boxes(all, bounds);
                }
                cells[1] = Cell::Blob(blob);
            }
            cells.extend(kinds.iter().enumerate().map(|(column, kind)| cell(record.value(column), *kind)));
            insert.execute(params_from_iter(cells)).map_err(output_error)?;
        }
        Ok(all)
    }

    /// Returns the table name of a layer called `name`, because some names are reserved.
    fn table_name(&mut self, name: &str) -> String {
        let lower = name.to_lowercase();
        let means = ["gpkg_", "rtree_", "sqlite_"].iter().any(|prefix| lower.starts_with(prefix));
        let plain: String =
            name.chars().map(|letter| if letter.is_control() { '_' } else { letter }).collect();
        let plain = if means || plain.is_empty() { format!("layer_{plain}") } else { plain };
        let name = unique_name(&plain, &self.names).into_owned();
        self.names.push(name.clone());
        name
    }
}

fn position_error(record: &Record, table: &RecordTable) -> Error {
    let id = burgeon_base::text::shown(&record.id);
    Error::data(format!(
        "{id} of the layer {} cannot be converted to the coordinate system of the data",
        table.name
    ))
    .help("remove it")
}

fn cell(value: Option<&Attribute>, kind: ColumnKind) -> Cell {
    #[allow(clippy::cast_possible_truncation, reason = "known to be whole and small")]
    match (value, kind) {
        (None, _) => Cell::Null,
        (Some(Attribute::Boolean(value)), ColumnKind::Boolean) => Cell::Integer(i64::from(*value)),
        (Some(Attribute::Number(number)), ColumnKind::Integer) => Cell::Integer(*number as i64),
        (Some(Attribute::Number(number)), ColumnKind::Number) => Cell::Real(*number),
        (Some(value), _) => Cell::Text(value.text()),
    }
}

/// Returns the names of the columns after the geometry column: the id, then the attributes.
fn column_names(table: &RecordTable) -> Vec<Cow<'static, str>> {
    let mut names = vec![Cow::Borrowed("fid"), Cow::Borrowed(GEOMETRY), Cow::Borrowed("id")];
    for column in &table.columns {
        let plain: String =
            column.chars().map(|letter| if letter.is_control() { '_' } else { letter }).collect();
        let name = unique_name(if plain.is_empty() { "_" } else { &plain }, &names).into_owned();
        names.push(Cow::Owned(name));
    }
    names.split_off(2)
}

/// Returns the GeoPackage name of the common geometry type of a table.
fn kind_name(table: &RecordTable) -> &'static str {
    let mut kinds =
        table.records.iter().filter_map(|record| record.geometry.as_ref()).map(|geometry| match geometry {
            Geometry::Point(_) => "POINT",
            Geometry::Line(_) => "LINESTRING",
            Geometry::Polygon(_) => "POLYGON",
            Geometry::MultiPoint(_) => "MULTIPOINT",
            Geometry::MultiLine(_) => "MULTILINESTRING",
            Geometry::MultiPolygon(_) => "MULTIPOLYGON",
            Geometry::Collection(_) => "GEOMETRYCOLLECTION",
        });
    let Some(first) = kinds.next() else { return "GEOMETRY" };
    if kinds.all(|kind| kind == first) { first } else { "GEOMETRY" }
}

/// Returns `name`, with a number appended if it is in `taken`; database names are case-insensitive.
fn unique_name<'a>(name: &'a str, taken: &[impl AsRef<str>]) -> Cow<'a, str> {
    let is_taken =
        |name: &str| taken.iter().any(|known| known.as_ref().to_lowercase() == name.to_lowercase());
    let mut free = Cow::Borrowed(name);
    let mut count = 1;
    while is_taken(&free) {
        count += 1;
        free = Cow::Owned(format!("{name}_{count}"));
    }
    free
}

fn join_boxes(a: LayerBox, b: LayerBox) -> LayerBox {
    [a[0].min(b[0]), a[1].min(b[1]), a[2].max(b[2]), a[3].max(b[3])]
}

/// Returns a name as SQL writes it, in double quotes.
fn quote(name: &str) -> String {
    format!("\"{}\"", name.replace('"', "\"\""))
}

/// Returns the triggers that update the R-tree of a layer when other programs change it, as the standard requires.
fn triggers(name: &str) -> String {
    let (table, tree) = (quote(name), quote(&format!("rtree_{name}_{GEOMETRY}")));
    let geometry = GEOMETRY;
    let trigger = |kind: &str| quote(&format!("rtree_{name}_{GEOMETRY}_{kind}"));
    let there = format!("(NEW.{geometry} NOTNULL AND NOT ST_IsEmpty(NEW.{geometry}))");
    let gone = format!("(NEW.{geometry} ISNULL OR ST_IsEmpty(NEW.{geometry}))");
    let add = format!(
        "INSERT OR REPLACE INTO {tree} VALUES (NEW.fid, ST_MinX(NEW.{geometry}), ST_MaxX(NEW.{geometry}), \
         ST_MinY(NEW.{geometry}), ST_MaxY(NEW.{geometry}));"
    );
    let remove = format!("DELETE FROM {tree} WHERE id = OLD.fid;");
    [
        format!("CREATE TRIGGER {} AFTER INSERT ON {table} WHEN {there} BEGIN {add} END;", trigger("insert")),
        format!(
            "CREATE TRIGGER {} AFTER UPDATE OF {geometry} ON {table} WHEN OLD.fid = NEW.fid AND {there} BEGIN {add} END;",
            trigger("update1")
        ),
        format!(
            "CREATE TRIGGER {} AFTER UPDATE OF {geometry} ON {table} WHEN OLD.fid = NEW.fid AND {gone} BEGIN {remove} END;",
            trigger("update2")
        ),
        format!(
            "CREATE TRIGGER {} AFTER UPDATE ON {table} WHEN OLD.fid != NEW.fid AND {there} BEGIN {remove} {add} END;",
            trigger("update3")
        ),
        format!(
            "CREATE TRIGGER {} AFTER UPDATE ON {table} WHEN OLD.fid != NEW.fid AND {gone} BEGIN \
             DELETE FROM {tree} WHERE id IN (OLD.fid, NEW.fid); END;",
            trigger("update4")
        ),
        format!(
            "CREATE TRIGGER {} AFTER DELETE ON {table} WHEN OLD.{geometry} NOT NULL BEGIN {remove} END;",
            trigger("delete")
        ),
    ]
    .join(" ")
}

/// Writer of the geometries of a layer.
struct BlobWriter<'a> {
    outward: &'a OutputPlacement<'a>,
    /// Set if the layer has heights.
    high: bool,
    /// Bounding box of the written geometry.
    bounds: LayerBox,
}

impl BlobWriter<'_> {
    /// Encodes a geometry as a GeoPackage blob: a header with its bounding box, and well-known binary. Returns `None`
    /// if it cannot be transformed.
    fn blob(&mut self, geometry: &Geometry, system: i32) -> Option<Vec<u8>> {
        let mut body = Vec::new();
        self.geometry(geometry, &mut body)?;
        let empty = self.bounds[0] > self.bounds[2];
        let is_point = matches!(geometry, Geometry::Point(_));
        // Little-endian, with a bounding box in x and y except for points.
        let flags = 1 | if empty { 1 << 4 } else { 0 } | if empty || is_point { 0 } else { 1 << 1 };
        let mut blob = vec![b'G', b'P', 0, flags];
        blob.extend(system.to_le_bytes());
        if flags & 2 != 0 {
            let [low_x, low_y, high_x, high_y] = self.bounds;
            [low_x, high_x, low_y, high_y].iter().for_each(|number| blob.extend(number.to_le_bytes()));
        }
        blob.extend(body);
        Some(blob)
    }

    fn geometry(&mut self, geometry: &Geometry, out: &mut Vec<u8>) -> Option<()> {
        match geometry {
            Geometry::Point(point) => self.one(*point, out),
            Geometry::Line(points) => self.line(points, out),
            Geometry::Polygon(rings) => self.polygon(rings, out),
            Geometry::MultiPoint(points) => {
                self.head(4, out);
                count(points.len(), out);
                points.iter().try_for_each(|point| self.one(Some(*point), out))
            }
            Geometry::MultiLine(lines) => {
                self.head(5, out);
                count(lines.len(), out);
                lines.iter().try_for_each(|line| self.line(line, out))
            }
            Geometry::MultiPolygon(polygons) => {
                self.head(6, out);
                count(polygons.len(), out);
                polygons.iter().try_for_each(|rings| self.polygon(rings, out))
            }
            Geometry::Collection(parts) => {
                self.head(7, out);
                count(parts.len(), out);
                parts.iter().try_for_each(|part| self.geometry(part, out))
            }
        }
    }

    fn one(&mut self, point: Option<DVec3>, out: &mut Vec<u8>) -> Option<()> {
        self.head(1, out);
        let Some(point) = point else {
            // An empty point has NaN coordinates.
            (0..if self.high { 3 } else { 2 }).for_each(|_| out.extend(f64::NAN.to_le_bytes()));
            return Some(());
        };
        self.point(point, out)
    }

    fn line(&mut self, points: &[DVec3], out: &mut Vec<u8>) -> Option<()> {
        self.head(2, out);
        self.points(points, false, out)
    }

    fn polygon(&mut self, rings: &[Vec<DVec3>], out: &mut Vec<u8>) -> Option<()> {
        self.head(3, out);
        count(rings.len(), out);
        rings.iter().try_for_each(|ring| self.points(ring, true, out))
    }

    fn head(&self, kind: u32, out: &mut Vec<u8>) {
        out.push(1);
        out.extend((kind + if self.high { 1000 } else { 0 }).to_le_bytes());
    }

    fn points(&mut self, points: &[DVec3], closed: bool, out: &mut Vec<u8>) -> Option<()> {
        let again = points.first().filter(|_| closed);
        count(points.len() + usize::from(again.is_some()), out);
        points.iter().chain(again).try_for_each(|point| self.point(*point, out))
    }

    fn point(&mut self, point: DVec3, out: &mut Vec<u8>) -> Option<()> {
        let DVec3 { x, y, z } = self.outward.place(point)?;
        self.bounds = join_boxes(self.bounds, [x, y, x, y]);
        out.extend(x.to_le_bytes());
        out.extend(y.to_le_bytes());
        if self.high {
            out.extend(z.to_le_bytes());
        }
        Some(())
    }
}

#[allow(clippy::cast_possible_truncation, reason = "as many points as memory has are fewer")]
fn count(items: usize, out: &mut Vec<u8>) {
    out.extend((items as u32).to_le_bytes());
}
