//! Reader of shapefiles: `.shp` with its `.dbf`, `.prj` and `.cpg`, also in a zip file.
//!
//! Input: the files of one layer, or a zip file with those of several. Output: a [`FeatureTable`](crate::FeatureTable).
//!
//! Source: ESRI, "Shapefile Technical Description", 1998; the file format of dBASE III+ with the types of FoxPro.

mod dbf;
mod layer;
mod reader;
mod rings;
mod shp;
#[cfg(test)]
mod tests;

pub(crate) use reader::Shapefile;
