//! Layer of a shapefile: geometries with the rows of its table.

use super::dbf::DbfReader;
use super::shp::ShapeReader;
use crate::content::DataFile;
use crate::features::table::FeatureTable;
use crate::source_options::SourceOptions;
use burgeon_base::error::{Error, Result};
use burgeon_spatial::crs::crs_of_text;

/// Remedy for a coordinate system of a data file that is not known.
const NAME_IT: &str = "specify its EPSG code: source(file, { crs = 3067 })";

/// Files of a layer.
pub(super) struct ShapeFiles {
    /// Name of the layer.
    pub(super) layer: String,
    pub(super) shp: DataFile,
    pub(super) dbf: Option<DataFile>,
    /// Coordinate system in well-known text, or the reason why the text cannot be read.
    pub(super) prj: Option<Result<String>>,
    /// Name of the encoding.
    pub(super) cpg: Option<String>,
}

impl ShapeFiles {
    /// Reads the layer, called `label` in messages, as `wanted` specifies.
    pub(super) fn read(&self, label: &str, wanted: &SourceOptions) -> Result<FeatureTable> {
        let damaged = |why: &str| {
            Error::data(format!("{label} cannot be read: {why}"))
                .help("the file is damaged or cut short; download it again")
        };
        let crs = match &self.prj {
            _ if wanted.crs.is_some() => Err(Error::data("")),
            Some(Ok(text)) => crs_of_text(text, label, NAME_IT),
            Some(Err(error)) => Err(error.clone()),
            None => {
                Err(Error::data(format!("{label} has no .prj file, so its coordinate system is unknown"))
                    .help("specify its EPSG code: source(file, { crs = 3067 })"))
            }
        };
        let mut table = FeatureTable::new(&self.layer, label, crs, wanted);
        let cannot = |error: std::io::Error| damaged(&error.to_string());
        let mut rows = match &self.dbf {
            Some(dbf) => {
                let file = dbf.content.reader().map_err(cannot)?;
                Some(DbfReader::open(file, &dbf.name, self.cpg.as_deref(), &mut table)?)
            }
            None => None,
        };
        let mut shapes =
            ShapeReader::open(self.shp.content.reader().map_err(cannot)?).map_err(|why| damaged(&why))?;
        let id = table.names.iter().position(|name| name == "id");
        let (mut without, mut deleted) = (0, 0);
        while let Some((shape, bounds)) = shapes.next(&wanted.budget)?.map_err(|why| damaged(&why))? {
            let attributes = match rows.as_mut().map(|rows| rows.next(&mut table)) {
                Some(Some(Some(attributes))) => attributes,
                Some(Some(None)) => {
                    deleted += 1;
                    continue;
                }
                Some(None) => {
                    without += 1;
                    Vec::new()
                }
                None => Vec::new(),
            };
            if table.is_full() {
                break;
            }
            match shape {
                Ok(parts) => table.push_identified(id, parts, attributes)?,
                Err(why) => {
                    let error = Error::data(format!("record {} of {label} {why}", shapes.number));
                    let error = error.help(
                        "supported types are points, lines and polygons; repair it: ogr2ogr out.gpkg FILE",
                    );
                    table.refuse_at(shapes.number.to_string(), error, bounds)?;
                }
            }
        }
        if self.dbf.is_none() {
            table.notes.push(format!("{label} has no .dbf file, so its features have no attributes"));
        }
        if deleted > 0 {
            let are = if deleted == 1 {
                "feature is marked as deleted and was"
            } else {
                "features are marked as deleted and were"
            };
            table.notes.push(format!("{label}: {deleted} {are} skipped"));
        }
        if without > 0 {
            let (lacks, what) =
                ("its .dbf file is cut short", if without == 1 { "feature has" } else { "features have" });
            table.notes.push(format!("{label}: {without} {what} no attributes, because {lacks}"));
        }
        if let Some(rows) = rows {
            if let Some((count, first)) = rows.unread {
                let values = if count == 1 {
                    "value is neither a number nor a date and was"
                } else {
                    "values are neither numbers nor dates and were"
                };
                table.notes.push(format!("{label}: {count} {values} skipped, e.g. {first}"));
            }
            if rows.guessed {
                table.notes.push(format!(
                    "{label} does not declare the encoding of its texts, which were read as Windows-1252 (Latin-1); declare it in a .cpg file next to it"
                ));
            }
            if let Some(first) = rows.left_out.first() {
                table.notes.push(format!(
                    "{label}: the column {first} was skipped, because its values are memos in another file"
                ));
            }
        }
        Ok(table)
    }
}
