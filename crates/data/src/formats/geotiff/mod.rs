//! Reader of GeoTIFF: a file of heights in strips or tiles, with keys for its position and unit.
//!
//! Input: the bytes of a file. Output: a [`RasterHeader`](crate::heights::RasterHeader), which reads the heights when all
//! else is checked. Memory and time for strips, tiles and masks are limited by the budget, whatever the file declares.

mod keys;
mod lzw;
mod meaning;
mod parts;
mod reader;

pub(crate) use reader::read;
