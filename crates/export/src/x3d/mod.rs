//! X3D 3.3 in XML (ISO/IEC 19775-1:2013, 19776-1:2015), which browsers show with x3dom and which GIS and CAD programs
//! read.
//!
//! X3D is y up, as glTF is: a point (x, y, z) of the scene is (x, z, -y) in the file. Shared parts are written once:
//! the mesh of a placed model is a prototype (`ProtoDeclare`) whose parameters are its transform and its feature. Other
//! shared meshes and all materials are named (`DEF`) at their first occurrence and referred to (`USE`) afterwards.
//! Textures are next to the file.

mod document;
mod shape;
#[cfg(test)]
mod tests;

pub(super) use document::write;
