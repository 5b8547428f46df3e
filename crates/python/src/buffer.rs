//! Arrays of a model, which NumPy reads where they are.

use std::sync::Arc;

use pyo3::prelude::*;
use pyo3::types::{PyBytes, PyDict};

use crate::model_data::ModelData;

/// Array of numbers that belongs to a model. It is read-only and in the memory of the model, which it keeps alive.
///
/// `numpy.asarray(buffer)` makes no copy; `buffer.tobytes()` makes one and needs no NumPy.
#[pyclass(frozen, module = "burgeon._burgeon")]
pub(crate) struct Buffer {
    content: BufferContent,
    #[pyo3(get)]
    shape: Vec<usize>,
    /// Type of the numbers, in the notation of NumPy's array interface.
    #[pyo3(get)]
    typestr: &'static str,
}

/// Owner of the numbers of a buffer.
enum BufferContent {
    Positions { model: Arc<ModelData>, mesh: usize, part: usize },
    TextureCoordinates { model: Arc<ModelData>, mesh: usize, part: usize },
    Floats(Vec<f32>),
    Doubles(Vec<f64>),
    Indices(Vec<u32>),
}

impl BufferContent {
    fn bytes(&self) -> &[u8] {
        match self {
            Self::Positions { model, mesh, part } => {
                model.part(*mesh, *part).map_or(&[], |part| bytemuck::cast_slice(&part.positions))
            }
            Self::TextureCoordinates { model, mesh, part } => {
                model.part(*mesh, *part).map_or(&[], |part| bytemuck::cast_slice(&part.uvs))
            }
            Self::Floats(numbers) => bytemuck::cast_slice(numbers),
            Self::Doubles(numbers) => bytemuck::cast_slice(numbers),
            Self::Indices(numbers) => bytemuck::cast_slice(numbers),
        }
    }
}

const FLOAT: &str = if cfg!(target_endian = "little") { "<f4" } else { ">f4" };
const DOUBLE: &str = if cfg!(target_endian = "little") { "<f8" } else { ">f8" };
const INDEX: &str = if cfg!(target_endian = "little") { "<u4" } else { ">u4" };

impl Buffer {
    /// Returns the positions (m) of a part; `None` if there is no such part.
    pub(crate) fn positions(model: &Arc<ModelData>, mesh: usize, part: usize) -> Option<Self> {
        let count = model.part(mesh, part)?.positions.len();
        let content = BufferContent::Positions { model: Arc::clone(model), mesh, part };
        Some(Self { content, shape: vec![count, 3], typestr: FLOAT })
    }

    /// Returns the texture coordinates (m) of a part; `None` if there is no such part.
    pub(crate) fn texture_coordinates(model: &Arc<ModelData>, mesh: usize, part: usize) -> Option<Self> {
        let count = model.part(mesh, part)?.uvs.len();
        let content = BufferContent::TextureCoordinates { model: Arc::clone(model), mesh, part };
        Some(Self { content, shape: vec![count, 2], typestr: FLOAT })
    }

    /// Returns the texture coordinates (m) of the dirt map of a part; `None` if there is no such part.
    pub(crate) fn second_texture_coordinates(model: &ModelData, mesh: usize, part: usize) -> Option<Self> {
        let part = model.part(mesh, part)?;
        let count = part.uvs.len();
        let numbers = (0..count).flat_map(|vertex| part.second_uv(vertex).to_array()).collect();
        Some(Self { content: BufferContent::Floats(numbers), shape: vec![count, 2], typestr: FLOAT })
    }

    /// Returns the unit normals of a part, which the model stores in a shorter form; `None` if there is no such part.
    pub(crate) fn normals(model: &ModelData, mesh: usize, part: usize) -> Option<Self> {
        let normals = &model.part(mesh, part)?.normals;
        let numbers: Vec<f32> = normals.iter().flat_map(|normal| normal.vector().to_array()).collect();
        Some(Self { content: BufferContent::Floats(numbers), shape: vec![normals.len(), 3], typestr: FLOAT })
    }

    /// Returns the corners of the triangles of a part, which the model stores in a shorter form; `None` if there is no
    /// such part.
    pub(crate) fn triangles(model: &ModelData, mesh: usize, part: usize) -> Option<Self> {
        let triangles = &model.part(mesh, part)?.triangles;
        let mut numbers = Vec::with_capacity(3 * triangles.len());
        triangles.iter().for_each(|corners| numbers.extend(corners));
        let shape = vec![triangles.len(), 3];
        Some(Self { content: BufferContent::Indices(numbers), shape, typestr: INDEX })
    }

    /// Returns the transforms of all instances to the world (m), as matrices row by row.
    pub(crate) fn transforms(model: &ModelData) -> Self {
        let instances = &model.run.scene.instances;
        let mut numbers = Vec::with_capacity(16 * instances.len());
        for instance in instances {
            let (matrix, origin) = (instance.transform.matrix3, instance.transform.translation);
            for row in 0..3 {
                numbers.extend([matrix.x_axis[row], matrix.y_axis[row], matrix.z_axis[row], origin[row]]);
            }
            numbers.extend([0.0, 0.0, 0.0, 1.0]);
        }
        let shape = vec![instances.len(), 4, 4];
        Self { content: BufferContent::Doubles(numbers), shape, typestr: DOUBLE }
    }
}

#[pymethods]
impl Buffer {
    /// Describes the array for NumPy: shape, type and address.
    #[getter]
    fn __array_interface__<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyDict>> {
        let interface = PyDict::new(py);
        interface.set_item("version", 3)?;
        interface.set_item("shape", pyo3::types::PyTuple::new(py, &self.shape)?)?;
        interface.set_item("typestr", self.typestr)?;
        let bytes = self.content.bytes();
        let is_read_only = true;
        interface.set_item("data", (bytes.as_ptr().addr(), is_read_only))?;
        Ok(interface)
    }

    /// Returns a copy of the numbers as bytes, row by row.
    fn tobytes<'py>(&self, py: Python<'py>) -> Bound<'py, PyBytes> {
        PyBytes::new(py, self.content.bytes())
    }

    fn __len__(&self) -> usize {
        self.shape.first().copied().unwrap_or(0)
    }

    fn __repr__(&self) -> String {
        format!("Buffer(shape={:?}, typestr={:?})", self.shape, self.typestr)
    }
}
