//! Generator of synthetic cities, and the program that makes their tiles.

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};
use std::process::{Command, Output};

use rusqlite::Connection;
use serde_json::Value;

/// Footprint of a synthetic city.
#[derive(Clone)]
pub(crate) struct Building {
    pub(crate) id: i64,
    pub(crate) ring: Vec<[f64; 2]>,
    pub(crate) levels: i64,
}

/// Returns `count` footprints in rows with common walls around a place, in metres. They depend only on their number.
pub(crate) fn city(count: usize, [x, y]: [f64; 2]) -> Vec<Building> {
    let columns = (count as f64).sqrt().ceil() as usize;
    let building = |number: usize| {
        let (column, row) = (number % columns, number / columns);
        let width = 9.0 + (number * 7 % 5) as f64 * 0.5;
        let (west, south) = (x + column as f64 * 11.0, y + row as f64 * 31.0);
        let (east, north) = (west + width, south + 12.0 + (number % 3) as f64);
        let ring = vec![[west, south], [east, south], [east, north], [west, north], [west, south]];
        Building { id: number as i64 + 1, ring, levels: 1 + (number * 5 % 4) as i64 }
    };
    (0..count).map(building).collect()
}

/// Writes a GeoPackage with a spatial index. A building without points has no geometry.
pub(crate) fn write_geopackage(path: &Path, crs: i32, buildings: &[Building]) {
    let connection = Connection::open(path).unwrap();
    connection
        .execute_batch(&format!(
            "CREATE TABLE gpkg_contents(table_name TEXT PRIMARY KEY, data_type TEXT);
             CREATE TABLE gpkg_geometry_columns(table_name TEXT, column_name TEXT, srs_id INT);
             CREATE TABLE gpkg_spatial_ref_sys(srs_name TEXT, srs_id INT, organization TEXT, organization_coordsys_id INT);
             CREATE TABLE gpkg_extensions(table_name TEXT, column_name TEXT, extension_name TEXT);
             INSERT INTO gpkg_spatial_ref_sys VALUES ('a', {crs}, 'EPSG', {crs});
             INSERT INTO gpkg_contents VALUES ('buildings', 'features');
             INSERT INTO gpkg_geometry_columns VALUES ('buildings', 'geom', {crs});
             INSERT INTO gpkg_extensions VALUES ('buildings', 'geom', 'gpkg_rtree_index');
             CREATE TABLE buildings(fid INTEGER PRIMARY KEY, geom BLOB, levels INTEGER, name TEXT);
             CREATE VIRTUAL TABLE rtree_buildings_geom USING rtree(id, minx, maxx, miny, maxy);
             BEGIN"
        ))
        .unwrap();
    for Building { id, ring, levels } in buildings {
        let mut blob = b"GP\0\x01\0\0\0\0\x01".to_vec();
        blob.extend([3_u32, 1, ring.len() as u32].into_iter().flat_map(u32::to_le_bytes));
        blob.extend(ring.iter().flatten().flat_map(|value| value.to_le_bytes()));
        let blob = (!ring.is_empty()).then_some(blob);
        let name = format!("house {id}");
        connection
            .execute("INSERT INTO buildings VALUES (?1, ?2, ?3, ?4)", (id, blob, levels, name))
            .unwrap();
        let extreme = |axis: usize, choose: fn(f64, f64) -> f64| {
            ring.iter().map(|point| point[axis]).reduce(choose).unwrap_or(0.0)
        };
        if !ring.is_empty() {
            let bounds =
                (id, extreme(0, f64::min), extreme(0, f64::max), extreme(1, f64::min), extreme(1, f64::max));
            connection
                .execute("INSERT INTO rtree_buildings_geom VALUES (?1, ?2, ?3, ?4, ?5)", bounds)
                .unwrap();
        }
    }
    connection.execute_batch("COMMIT").unwrap();
    connection.close().unwrap();
}

/// Writes the same features as GeoJSON.
pub(crate) fn write_geojson(path: &Path, buildings: &[Building]) {
    let feature = |building: &Building| {
        let Building { id, ring, levels } = building;
        let geometry = serde_json::json!({ "type": "Polygon", "coordinates": [ring] });
        let geometry = if ring.is_empty() { Value::Null } else { geometry };
        let properties = serde_json::json!({ "levels": levels, "name": format!("house {id}") });
        serde_json::json!({ "type": "Feature", "id": id, "properties": properties, "geometry": geometry })
    };
    let features: Vec<Value> = buildings.iter().map(feature).collect();
    let document = serde_json::json!({ "type": "FeatureCollection", "features": features });
    std::fs::write(path, document.to_string()).unwrap();
}

/// Houses whose walls know their neighbours, with random roofs.
pub(crate) const SCRIPT: &str = r#"local Walls, Roof = module("Walls", "height"), module("Roof", "height")
local s = lsystem({ object = footprint })
s:axiom(source(SOURCE), function(feature)
  return footprint(feature.geometry), Walls(3 * feature.levels)
end)
s:rule("Walls(height)", function(this, height)
  FAULT
  return Walls(height), Roof(random(1, 3))
end)
s:interpret("Walls(height)", function(this, height) this:walls({ height = height }) end)
s:interpret("Roof(height)", function(this, height) this:roof({ kind = "hip", height = height }) end)
s:derive(1)
"#;

/// Folder with a city, a script and the tiles.
pub(crate) struct City(pub(crate) tempfile::TempDir);

impl City {
    /// Creates a city of `count` houses in a GeoPackage.
    pub(crate) fn new(count: usize) -> Self {
        let city = Self(tempfile::tempdir().unwrap());
        write_geopackage(&city.path("city.gpkg"), 2154, &self::city(count, [652_000.0, 6_862_000.0]));
        city.script("\"city.gpkg:buildings\"", "")
    }

    /// Writes the script that reads `source` and runs `fault` in a rule.
    pub(crate) fn script(self, source: &str, fault: &str) -> Self {
        let text = SCRIPT.replace("SOURCE", source).replace("FAULT", fault);
        std::fs::write(self.path("city.lua"), text).unwrap();
        self
    }

    pub(crate) fn path(&self, name: &str) -> PathBuf {
        self.0.path().join(name)
    }

    pub(crate) fn command(&self, arguments: &[&str]) -> Command {
        let mut command = Command::new(env!("CARGO_BIN_EXE_burgeon"));
        command.arg("tiles").args(arguments).current_dir(self.0.path());
        for name in ["SLURM_ARRAY_TASK_ID", "SLURM_ARRAY_TASK_MIN", "JOB_COMPLETION_INDEX"] {
            command.env_remove(name);
        }
        command
    }

    pub(crate) fn run(&self, arguments: &[&str]) -> Output {
        self.command(arguments).output().unwrap()
    }

    /// Runs a command that succeeds, and returns its JSON document.
    pub(crate) fn json(&self, arguments: &[&str]) -> Value {
        let output = self.run(&[arguments, &["--json"]].concat());
        let text = String::from_utf8_lossy(&output.stdout);
        assert!(output.status.success(), "{arguments:?}: {text} {}", String::from_utf8_lossy(&output.stderr));
        serde_json::from_str(&text).unwrap_or_else(|error| panic!("{error}: {text}"))
    }

    /// Runs a command that fails with this status, and returns its messages.
    pub(crate) fn fails(&self, arguments: &[&str], status: i32) -> String {
        let output = self.run(arguments);
        let text = String::from_utf8_lossy(&output.stderr).into_owned();
        assert_eq!(output.status.code(), Some(status), "{arguments:?}: {text}");
        assert!(!text.contains("panicked"), "{text}");
        text
    }

    pub(crate) fn plan(&self, folder: &str) -> Value {
        self.json(&[
            "plan",
            "city.lua",
            "-o",
            folder,
            "--reach",
            "2",
            "--target-features",
            "30",
            "--geoid-height",
            "44",
        ])
    }

    /// Returns all output files of a folder, without the times of people's logs.
    pub(crate) fn files(&self, folder: &str) -> BTreeMap<String, Vec<u8>> {
        let root = self.path(folder);
        let mut files = BTreeMap::new();
        let mut open = vec![root.clone()];
        while let Some(next) = open.pop() {
            for entry in std::fs::read_dir(next).unwrap() {
                let path = entry.unwrap().path();
                let name = path.strip_prefix(&root).unwrap().to_string_lossy().into_owned();
                if path.is_dir() {
                    if name != "log" {
                        open.push(path);
                    }
                } else {
                    files.insert(name, std::fs::read(&path).unwrap());
                }
            }
        }
        files
    }

    /// Asserts that two folders have the same files with the same bytes.
    pub(crate) fn assert_same(&self, a: &str, b: &str) {
        let (a, b) = (self.files(a), self.files(b));
        assert_eq!(a.keys().collect::<Vec<_>>(), b.keys().collect::<Vec<_>>());
        for (name, bytes) in &a {
            assert!(*bytes == b[name], "{name} differs");
        }
    }
}
