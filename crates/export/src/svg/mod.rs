//! An architectural drawing to scale, as SVG: a plan, or an elevation of a thin upright model.
//!
//! Steps: choose the side to view the model from (`view`); project the triangles that face the viewer, round them to
//! millimetres and shade them like a relief map (`faces`); sort them from back to front into sheets of one colour each,
//! as few as cover each other correctly (`sheets`); and trace the outline of each sheet (`outline`), so that a flat
//! roof becomes one polygon regardless of its triangles. One unit is a metre, and a scale bar shows the scale.

mod drawing;
mod faces;
mod outline;
mod sheets;
mod view;

pub use drawing::svg;
pub(super) use drawing::write;
