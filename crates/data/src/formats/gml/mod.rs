//! Reads GML, as towns and their services hand it out: collections of features of versions 2 to 3.2, and models of CityGML 1 to 3.
//!
//! Comes in: a file of XML. Goes out: a [`FeatureTable`](crate::FeatureTable) of the features of one type. The file is read as it
//! comes, twice: once for the types of its features, and once for those of the one that is wanted.
//!
//! Nothing that a file names is fetched, and no entity of its own is followed.
//!
//! Source: OGC 02-069, 03-105r1 and 07-036, Geography Markup Language; OGC 06-103r4 for what coordinates mean.

mod axes;
mod city;
mod geometry;
mod reader;
mod system;
#[cfg(test)]
mod tests;

pub(crate) use reader::GmlFile;
