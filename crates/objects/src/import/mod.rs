//! Models from glTF files: nodes become instances, y up becomes z up.
//!
//! Comes in: the bytes of a `.glb` or `.gltf` file. Goes out: a [`Scene`], or an error that says what is wrong with
//! the file. Nothing in a file makes this panic.
//!
//! Source: Khronos Group, glTF 2.0 Specification, 2021 (ISO/IEC 12113).

mod bytes;
mod gltf_file;
mod instances;
mod look;
mod shape;
#[cfg(test)]
mod tests;
mod tints;

pub(super) use gltf_file::kind;
