//! Triangles of surfaces.

use glam::{DAffine3, Vec2};

use super::surface::{SplineSurface, normal};
use crate::solid::is_flat;
use burgeon_base::error::{Error, Limit, Result};
use burgeon_base::{MemoryOwner, Stop};
use burgeon_scene::{Normal, Part};

/// Approximate memory (bytes) of a vertex with its two triangles.
const VERTEX: usize = 48;

impl SplineSurface {
    /// Adds the triangles of the surface at `transform` to `part`, with `divisions` of each patch in both directions.
    ///
    /// Triangles are counter-clockwise seen from the side of the normals. Texture coordinates are u and v, so an image
    /// of 1 m by 1 m covers the surface. Triangles without area, such as at a tip, are left out. Fails if there are no
    /// divisions or the mesh would be too large.
    ///
    /// ```
    /// use burgeon_geometry::{SplineSurface, SurfaceGrid, SurfaceKind, solid};
    /// use burgeon_scene::Part;
    /// use glam::{DAffine3, DVec3};
    ///
    /// let row = |y: f64| vec![DVec3::new(0.0, y, 0.0), DVec3::new(2.0, y, 0.0)];
    /// let grid = SurfaceGrid { points: vec![row(0.0), row(4.0)], ..SurfaceGrid::default() };
    /// let mut part = Part::default();
    /// SplineSurface::new(SurfaceKind::BSpline, grid)?.draw(&mut part, &DAffine3::IDENTITY, 3)?;
    /// assert_eq!((part.triangles.len(), solid::area([&part])), (18, 8.0));
    /// # Ok::<(), burgeon_base::Error>(())
    /// ```
    pub fn draw(&self, part: &mut Part, transform: &DAffine3, divisions: usize) -> Result<()> {
        if divisions == 0 {
            return Err(Error::argument("a surface with 0 divisions cannot be drawn").help("give 1 or more"));
        }
        let [us, vs] = [0, 1].map(|direction| divided(&self.bases[direction].breaks(), divisions));
        let count = us.len().saturating_mul(vs.len());
        MemoryOwner::ensure_room(count.saturating_mul(VERTEX))?;
        let vertices = part.positions.len();
        if count.saturating_add(vertices) > u32::MAX as usize {
            return Err(Error::limit(Limit::Size, "the surface has too many vertices")
                .help("give fewer divisions, or fewer points"));
        }
        let first = vertices as u32;
        let width = us.len() as u32;
        part.make_room(count, 2 * count);
        for v in &vs {
            Stop::check_current()?;
            for u in &us {
                let [at, along_u, along_v] = self.derivatives(*u, *v);
                let [along_u, along_v] = [along_u, along_v].map(|it| transform.transform_vector3(it));
                let upright = normal(along_u, along_v).unwrap_or_else(|| {
                    // Normals turn with the inverse transpose, and a mirrored surface shows its other side.
                    let turned = transform.matrix3.inverse().transpose() * self.normal(*u, *v);
                    turned.normalize_or_zero() * transform.matrix3.determinant().signum()
                });
                part.positions.push(transform.transform_point3(at).as_vec3());
                part.normals.push(Normal::from(upright));
                part.uvs.push(Vec2::new(*u as f32, *v as f32));
            }
        }
        for row in 0..vs.len() as u32 - 1 {
            for column in 0..width - 1 {
                let a = first + row * width + column;
                for corners in [[a, a + 1, a + width + 1], [a, a + width + 1, a + width]] {
                    if !is_flat(corners.map(|corner| part.positions[corner as usize].as_dvec3())) {
                        part.triangles.push(corners);
                    }
                }
            }
        }
        Ok(())
    }
}

/// Returns the parameters at `breaks` and at the divisions between them.
fn divided(breaks: &[f64], divisions: usize) -> Vec<f64> {
    let pairs = breaks.windows(2);
    let inner = pairs.flat_map(|pair| {
        (0..divisions).map(|i| pair[0] + (pair[1] - pair[0]) * (i as f64 / divisions as f64))
    });
    inner.chain([1.0]).collect()
}
