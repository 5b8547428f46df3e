//! Reader of GML as municipalities and web services publish it: feature collections of versions 2 to 3.2, and CityGML 1
//! to 3 models.
//!
//! Input: an XML file. Output: a [`FeatureTable`](crate::FeatureTable) of the features of one type. The file is
//! streamed twice: once for the types of its features, and once for the features of the requested type.
//!
//! External references are not fetched, and entities defined in the file are not expanded.
//!
//! Source: OGC 02-069, 03-105r1 and 07-036, Geography Markup Language; OGC 06-103r4 for the meaning of coordinates.

mod axes;
mod city;
mod geometry;
mod reader;
mod system;
#[cfg(test)]
mod tests;

pub(crate) use reader::GmlFile;
