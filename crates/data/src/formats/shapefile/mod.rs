//! Reads shapefiles: `.shp` with its `.dbf`, `.prj` and `.cpg`, also in a zip.
//!
//! Comes in: the files of one layer, or a zip with those of several. Goes out: a [`FeatureTable`](crate::FeatureTable).
//!
//! Source: ESRI, "Shapefile Technical Description", 1998; the file format of dBASE III+ with the types of FoxPro.

mod dbf;
mod layer;
mod prj;
mod reader;
mod rings;
mod shp;
#[cfg(test)]
mod tests;

pub(crate) use reader::Shapefile;
