//! X3D 3.3 in XML (ISO/IEC 19775-1:2013, 19776-1:2015), which browsers show with x3dom and which GIS and CAD read.
//!
//! X3D is y up, as glTF is: a point (x, y, z) of the scene is (x, z, -y) in the file. What is shared is written once:
//! a placed model's mesh is a prototype (`ProtoDeclare`) whose parameters are where it stands and whose it is, other
//! shared meshes and all materials are named (`DEF`) where they come first and used (`USE`) from there on. Textures lie
//! beside the file.

mod document;
mod shape;
#[cfg(test)]
mod tests;
mod xml;

pub(super) use document::write;
