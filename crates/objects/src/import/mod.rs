//! Models from glTF files: nodes become instances, y up becomes z up.
//!
//! Input: the bytes of a `.glb` or `.gltf` file. Output: a [`Scene`], or an error that describes the problem in the
//! file. No file content causes a panic.
//!
//! Source: Khronos Group, glTF 2.0 Specification, 2021 (ISO/IEC 12113).

mod bytes;
mod gltf_file;
mod instances;
mod look;
mod options;
mod shape;
#[cfg(test)]
mod tests;
mod tints;

pub(super) use gltf_file::kind;
