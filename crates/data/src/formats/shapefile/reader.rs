//! Files of a shapefile, next to each other in a folder or in a zip file.

use std::path::Path;

use super::layer::ShapeFiles;
use super::shp::MAGIC;
use crate::companions::{OF_SHAPEFILE, companion, read_text, real_companion};
use crate::content::DataFile;
use crate::features::table::FeatureTable;
use crate::formats::unpack::ZippedFiles;
use crate::layered_file::LayeredFile;
use crate::source_options::SourceOptions;
use burgeon_base::budget::Budget;
use burgeon_base::error::{Error, Result};
use burgeon_base::text::shown;

/// Open shapefiles, one per layer.
pub(crate) struct Shapefile {
    name: String,
    layers: Vec<ShapeFiles>,
}

impl Shapefile {
    /// Returns true if a file that begins with `head` is a `.shp` file.
    pub(crate) fn is_one(head: &[u8]) -> bool {
        head.starts_with(&MAGIC)
    }

    /// Opens a `.shp` file and its companion files.
    pub(crate) fn open(shp: DataFile) -> Result<Self> {
        let [dbf, prj, cpg] = OF_SHAPEFILE.map(|extension| {
            let path = companion(&shp.path, extension);
            let real = real_companion(&shp.path, extension);
            let name = Path::new(&shp.name).with_extension(extension).display().to_string();
            let (file, _) = burgeon_base::files::open(&real?).ok()?;
            Some(DataFile::new(file, &path, &name))
        });
        let (prj, cpg) = (prj.as_ref().map(prj_text), cpg.as_ref().map(cpg_text).transpose()?);
        let (name, layer) = (shp.name.clone(), shp.stem().into_owned());
        Ok(Self { name, layers: vec![ShapeFiles { layer, shp, dbf, prj, cpg }] })
    }

    /// Opens the shapefiles in a zip file, if there are any.
    pub(crate) fn in_zip(zip: &ZippedFiles, name: &str, budget: &Budget) -> Result<Option<Self>> {
        let mut layers = Vec::new();
        for shp in zip.with_extensions(&["shp"]) {
            let stem = &shp[..shp.len() - 3];
            let beside = |extension: &str| {
                let wanted = format!("{stem}{extension}");
                let found = zip.names.iter().find(|name| name.eq_ignore_ascii_case(&wanted));
                found.map(|name| zip.file(name, budget)).transpose()
            };
            let (dbf, prj, cpg) = (beside("dbf")?, beside("prj")?, beside("cpg")?);
            let (prj, cpg) = (prj.as_ref().map(prj_text), cpg.as_ref().map(cpg_text).transpose()?);
            let layer = Path::new(shp).file_stem().unwrap_or_default().to_string_lossy().into_owned();
            layers.push(ShapeFiles { layer, shp: zip.file(shp, budget)?, dbf, prj, cpg });
        }
        Ok((!layers.is_empty()).then(|| Self { name: name.to_owned(), layers }))
    }
}

/// Returns the text of a `.prj` file; an error if it cannot be read, which matters only if the text is needed.
fn prj_text(file: &DataFile) -> Result<String> {
    let remedy = "a .prj file contains the text of one coordinate system; re-export it, or specify the EPSG code: source(file, { crs = 3067 })";
    text(file, remedy)
}

/// Returns the name of an encoding in a `.cpg` file.
fn cpg_text(file: &DataFile) -> Result<String> {
    text(file, "a .cpg file contains the name of an encoding, such as UTF-8; rewrite it, or remove it")
}

fn text(file: &DataFile, remedy: &str) -> Result<String> {
    let cannot = |error| Error::file(&file.path, format!("cannot read {}: {error}", file.name));
    read_text(file.content.reader().map_err(cannot)?, &file.name, remedy)
}

impl LayeredFile for Shapefile {
    fn format(&self) -> &'static str {
        "Shapefile"
    }

    fn layers(&self) -> Vec<&str> {
        self.layers.iter().map(|layer| layer.layer.as_str()).collect()
    }

    fn read(&self, layer: &str, wanted: &SourceOptions) -> Result<FeatureTable> {
        let found = self.layers.iter().find(|known| known.layer == layer);
        let found = found.ok_or_else(|| Error::internal("a listed layer is missing"))?;
        match self.layers.len() {
            1 => found.read(&self.name, wanted),
            _ => found.read(&format!("{}:{}", self.name, shown(layer)), wanted),
        }
    }
}
