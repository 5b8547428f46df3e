//! An architectural drawing to scale, as SVG: a plan, or an elevation of what stands upright and thin.
//!
//! In order: the side to look from is chosen (`view`); the triangles that face the viewer are projected,
//! rounded to millimetres and shaded like a relief map (`faces`); they are sorted from the back to the front
//! into sheets of one colour each, as few as cover each other rightly (`sheets`); what a sheet covers is
//! traced (`outline`), so that a flat roof is one polygon whatever its triangles. One unit is a metre, and a
//! bar tells the scale.

mod drawing;
mod faces;
mod outline;
mod sheets;
mod view;

pub use drawing::svg;
