//! Choice of the side from which a drawing shows the model.

use super::super::check::{SceneCheck, shown_parts, triangles};
use glam::{DMat3, DVec3};

/// Position of the viewer.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum DrawingSide {
    /// View from above, with north at the top of the paper.
    Plan,
    South,
    East,
    North,
    West,
}

impl DrawingSide {
    const ALL: [Self; 5] = [Self::Plan, Self::South, Self::East, Self::North, Self::West];

    /// Chooses the view that shows most: the plan, or an elevation if the model is thin and upright or if nothing is
    /// visible from above.
    pub(super) fn of(checked: &SceneCheck<'_>) -> Self {
        let areas = facing_areas(checked);
        let thin = checked.scene.bounds().and_then(|(low, high)| {
            let size = high - low;
            if size.y < 0.05 * size.x.min(size.z) {
                Some([Self::South, Self::North])
            } else if size.x < 0.05 * size.y.min(size.z) {
                Some([Self::East, Self::West])
            } else {
                None
            }
        });
        let best = |among: &[Self]| {
            // The first view wins unless another shows visibly more, because a closed shape looks the same from both
            // sides.
            among
                .iter()
                .copied()
                .reduce(|best, it| if areas[it as usize] > areas[best as usize] * 1.01 { it } else { best })
        };
        if let Some(sides) = thin {
            return best(&sides).unwrap_or(Self::Plan);
        }
        match best(&Self::ALL[1..]) {
            Some(side) if areas[Self::Plan as usize] < 0.01 * areas[side as usize] => side,
            _ => Self::Plan,
        }
    }

    /// Returns the rotation from the scene's coordinates to the paper's: x to the right, y up, z towards the viewer.
    pub(super) fn matrix(self) -> DMat3 {
        let (right, up) = match self {
            Self::Plan => (DVec3::X, DVec3::Y),
            Self::South => (DVec3::X, DVec3::Z),
            Self::East => (DVec3::Y, DVec3::Z),
            Self::North => (-DVec3::X, DVec3::Z),
            Self::West => (-DVec3::Y, DVec3::Z),
        };
        DMat3::from_cols(right, up, right.cross(up)).transpose()
    }

    /// Returns the title of the drawing.
    pub(super) fn title(self) -> &'static str {
        match self {
            Self::Plan => "Plan, north up",
            Self::South => "Elevation, seen from the south",
            Self::East => "Elevation, seen from the east",
            Self::North => "Elevation, seen from the north",
            Self::West => "Elevation, seen from the west",
        }
    }
}

/// Computes the projected area (m²) of the faces towards each view, including covered faces.
fn facing_areas(checked: &SceneCheck<'_>) -> [f64; 5] {
    let towards = DrawingSide::ALL.map(|view| view.matrix().row(2));
    let mut areas = [0.0; 5];
    for instance in checked.scene.instances.iter().filter(|instance| checked.meshes[instance.mesh]) {
        let side = instance.transform.matrix3.determinant().signum();
        for part in shown_parts(&checked.scene.meshes[instance.mesh]) {
            let both = checked.scene.materials[part.material].double_sided;
            for corners in triangles(part) {
                let [a, b, c] = corners.map(|corner| {
                    instance.transform.transform_vector3(part.positions[corner as usize].as_dvec3())
                });
                let area = (b - a).cross(c - a) * (0.5 * side);
                for (sum, towards) in areas.iter_mut().zip(&towards) {
                    let facing = area.dot(*towards);
                    *sum += if both { facing.abs() } else { facing.max(0.0) };
                }
            }
        }
    }
    areas
}

#[cfg(test)]
mod tests {
    use super::super::super::{check::check, samples};
    use super::*;

    #[test]
    fn a_view_turns_without_mirroring_and_looks_from_its_side() {
        let towards = [DVec3::Z, -DVec3::Y, DVec3::X, DVec3::Y, -DVec3::X];
        for (view, towards) in DrawingSide::ALL.into_iter().zip(towards) {
            assert_eq!(view.matrix() * towards, DVec3::Z, "{view:?}");
            assert!(view.matrix().determinant() > 0.5, "{view:?}");
        }
    }

    #[test]
    fn one_wall_is_seen_from_the_side_that_it_faces() {
        let mut scene = samples::boxes(1);
        // The first square of the box faces east, and the fourth faces south.
        for (square, view) in
            [(0, DrawingSide::East), (3, DrawingSide::South), (1, DrawingSide::West), (4, DrawingSide::Plan)]
        {
            let mut one = scene.clone();
            one.meshes[0].parts[0].triangles =
                scene.meshes[0].parts[0].triangles.range(square * 2..square * 2 + 2).collect();
            assert_eq!(DrawingSide::of(&check(&one).unwrap()), view, "{square}");
        }
        scene.instances[0].transform.matrix3.z_axis.z = 30.0;
        assert_eq!(DrawingSide::of(&check(&scene).unwrap()), DrawingSide::Plan, "a tower");
    }
}
