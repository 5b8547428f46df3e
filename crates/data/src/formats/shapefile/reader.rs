//! Files of a shapefile, next to each other in a folder or in a zip file.

use std::io::Read;
use std::path::Path;

use super::layer::ShapeFiles;
use super::shp::MAGIC;
use crate::companions::{LARGEST_TEXT, OF_SHAPEFILE, companion, real_companion};
use crate::content::{DataFile, LayeredFile};
use crate::formats::unpack::ZippedFiles;
use crate::{FeatureTable, SourceOptions};
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
        let [prj, cpg] = [prj, cpg].map(|file| file.and_then(|file| text(&file)));
        let (name, layer) = (shp.name.clone(), shp.stem());
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
            let [prj, cpg] = [prj, cpg].map(|file| file.and_then(|file| text(&file)));
            let layer = Path::new(shp).file_stem().unwrap_or_default().to_string_lossy().into_owned();
            layers.push(ShapeFiles { layer, shp: zip.file(shp, budget)?, dbf, prj, cpg });
        }
        Ok((!layers.is_empty()).then(|| Self { name: name.to_owned(), layers }))
    }
}

/// Returns the text of a small file.
fn text(file: &DataFile) -> Option<String> {
    let mut bytes = Vec::new();
    file.content.reader().ok()?.take(LARGEST_TEXT).read_to_end(&mut bytes).ok()?;
    Some(String::from_utf8_lossy(&bytes).trim_start_matches('\u{feff}').to_owned())
}

impl LayeredFile for Shapefile {
    fn format(&self) -> &'static str {
        "Shapefile"
    }

    fn layers(&self) -> Vec<String> {
        self.layers.iter().map(|layer| layer.layer.clone()).collect()
    }

    fn read(&self, layer: &str, wanted: &SourceOptions) -> Result<FeatureTable> {
        let found = self.layers.iter().find(|known| known.layer == layer);
        let found = found.ok_or_else(|| Error::internal("a layer that was listed is not there"))?;
        match self.layers.len() {
            1 => found.read(&self.name, wanted),
            _ => found.read(&format!("{}:{}", self.name, shown(layer)), wanted),
        }
    }
}
