//! Decomposition of transforms into a translation, a rotation and a scale, as formats require.

use glam::{DAffine3, DMat3, DQuat, DVec3};

/// Description of the axes of y-up files.
pub(crate) const Y_UP_AXES: &str = "x east, y up, z south (m)";

/// Transform that scales, then rotates, then translates.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Trs {
    /// Translation (m).
    pub(super) translation: DVec3,
    /// Rotation as a unit quaternion.
    pub(super) rotation: DQuat,
    /// Scale factors; one is negative if the transform mirrors.
    pub(super) scale: DVec3,
}

/// Transform in the form that glTF allows.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum Steps {
    /// Any transform that preserves right angles.
    One(Trs),
    /// Sheared transform: apply the rotation first, then the rest.
    Two(Trs, DQuat),
}

/// Converts `transform` from z-up to y-up coordinates.
pub(super) fn y_up(transform: &DAffine3) -> DAffine3 {
    let turn = |v: DVec3| DVec3::new(v.x, v.z, -v.y);
    let DMat3 { x_axis, y_axis, z_axis } = transform.matrix3;
    DAffine3 {
        matrix3: DMat3::from_cols(turn(x_axis), turn(z_axis), -turn(y_axis)),
        translation: turn(transform.translation),
    }
}

/// Returns the matrix that transforms normals if `matrix` transforms points: its inverse transpose up to a positive
/// factor, which exists for a flattening matrix too.
pub(super) fn normal_matrix(matrix: &DMat3) -> DMat3 {
    let (x, y, z) = (matrix.x_axis, matrix.y_axis, matrix.z_axis);
    let cofactors = DMat3::from_cols(y.cross(z), z.cross(x), x.cross(y));
    if matrix.determinant() < 0.0 { -cofactors } else { cofactors }
}

/// Decomposes `transform`.
///
/// A sheared transform has no decomposition into one translation, rotation and scale, and glTF does not allow a matrix
/// for it either. It is therefore written as a rotation, then a scale along the axes, then another rotation, one nested
/// in the other (the singular value decomposition).
pub(super) fn decompose(transform: &DAffine3) -> Steps {
    let columns = transform.matrix3;
    // A micrometre per metre: the precision of f32.
    let square = |a: DVec3, b: DVec3| a.dot(b).abs() <= 1e-6 * a.length() * b.length();
    if square(columns.x_axis, columns.y_axis)
        && square(columns.y_axis, columns.z_axis)
        && square(columns.z_axis, columns.x_axis)
    {
        return Steps::One(from_columns(columns, transform.translation));
    }
    let first = principal_axes(columns.transpose() * columns);
    let rest = from_columns(columns * first, transform.translation);
    Steps::Two(rest, DQuat::from_mat3(&first.transpose()).normalize())
}

/// Returns the transform whose `columns` are orthogonal.
fn from_columns(columns: DMat3, translation: DVec3) -> Trs {
    let mut scale = DVec3::new(columns.x_axis.length(), columns.y_axis.length(), columns.z_axis.length());
    if columns.determinant() < 0.0 {
        scale.x = -scale.x;
    }
    let least = scale.abs().max_element() * 1e-12;
    let axis = |column: DVec3, length: f64| (length.abs() > least).then(|| column / length);
    let axes = [axis(columns.x_axis, scale.x), axis(columns.y_axis, scale.y), axis(columns.z_axis, scale.z)];
    for (factor, axis) in scale.as_mut().iter_mut().zip(&axes) {
        if axis.is_none() {
            *factor = 0.0;
        }
    }
    Trs { translation, rotation: DQuat::from_mat3(&right_handed(axes)).normalize(), scale }
}

/// Completes `axes` to a rotation; axes that a flattening transform leaves undefined are chosen.
fn right_handed(axes: [Option<DVec3>; 3]) -> DMat3 {
    match axes {
        [Some(x), Some(y), Some(z)] => DMat3::from_cols(x, y, z),
        [Some(x), Some(y), None] => DMat3::from_cols(x, y, x.cross(y)),
        [Some(x), None, Some(z)] => DMat3::from_cols(x, z.cross(x), z),
        [None, Some(y), Some(z)] => DMat3::from_cols(y.cross(z), y, z),
        [Some(x), None, None] => right_handed([Some(x), Some(x.any_orthonormal_vector()), None]),
        [None, Some(y), None] => right_handed([Some(y.any_orthonormal_vector()), Some(y), None]),
        [None, None, Some(z)] => right_handed([Some(z.any_orthonormal_vector()), None, Some(z)]),
        [None, None, None] => DMat3::IDENTITY,
    }
}

/// Returns the eigenvectors of a `symmetric` matrix as the columns of a rotation.
///
/// Method: Jacobi's, as in Golub and Van Loan, "Matrix Computations", section 8.5.
fn principal_axes(mut symmetric: DMat3) -> DMat3 {
    let mut axes = DMat3::IDENTITY;
    // Each sweep of three rotations squares the off-diagonal remainder, so eight sweeps are more than f64 needs.
    for (p, q) in [(0, 1), (0, 2), (1, 2)].into_iter().cycle().take(3 * 8) {
        let off = symmetric.col(q)[p];
        if off == 0.0 {
            continue;
        }
        let ratio = (symmetric.col(q)[q] - symmetric.col(p)[p]) / (2.0 * off);
        let tangent = ratio.signum() / (ratio.abs() + ratio.hypot(1.0));
        let cosine = 1.0 / tangent.hypot(1.0);
        let sine = tangent * cosine;
        let mut turn = DMat3::IDENTITY;
        turn.col_mut(p)[p] = cosine;
        turn.col_mut(q)[q] = cosine;
        turn.col_mut(q)[p] = sine;
        turn.col_mut(p)[q] = -sine;
        symmetric = turn.transpose() * symmetric * turn;
        axes *= turn;
    }
    axes
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    fn compose(steps: Steps) -> DAffine3 {
        let matrix =
            |it: Trs| DAffine3::from_scale_rotation_translation(it.scale, it.rotation, it.translation);
        match steps {
            Steps::One(one) => matrix(one),
            Steps::Two(rest, first) => matrix(rest) * DAffine3::from_quat(first),
        }
    }

    fn error(transform: &DAffine3) -> f64 {
        let (a, b) = (transform.to_cols_array(), compose(decompose(transform)).to_cols_array());
        let size = a.iter().fold(1.0, |size: f64, x| size.max(x.abs()));
        a.iter().zip(&b).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max) / size
    }

    proptest! {
        #[test]
        fn a_transform_is_the_product_of_its_steps(cols in proptest::array::uniform12(-3.0_f64..3.0)) {
            prop_assert!(error(&DAffine3::from_cols_array(&cols)) < 1e-9);
        }

        #[test]
        fn a_transform_without_shear_takes_one_step(
            angles in proptest::array::uniform3(-3.0_f64..3.0), scale in proptest::array::uniform3(-9.0_f64..9.0)
        ) {
            let rotation = DQuat::from_euler(glam::EulerRot::XYZ, angles[0], angles[1], angles[2]);
            let transform = DAffine3::from_scale_rotation_translation(scale.into(), rotation, DVec3::ONE);
            prop_assert!(matches!(decompose(&transform), Steps::One(_)));
            prop_assert!(error(&transform) < 1e-9);
        }

        #[test]
        fn turning_a_transform_turns_what_it_does(
            cols in proptest::array::uniform12(-3.0_f64..3.0), point in proptest::array::uniform3(-3.0_f64..3.0)
        ) {
            let transform = DAffine3::from_cols_array(&cols);
            let turn = |p: DVec3| DVec3::new(p.x, p.z, -p.y);
            let moved = y_up(&transform).transform_point3(turn(point.into()));
            prop_assert!(moved.abs_diff_eq(turn(transform.transform_point3(point.into())), 1e-9));
        }
    }

    #[test]
    fn a_flattened_a_linear_and_an_empty_transform_have_a_rotation_too() {
        for scale in
            [DVec3::new(2.0, 0.0, 3.0), DVec3::new(0.0, 2.0, 0.0), DVec3::new(0.0, 0.0, -2.0), DVec3::ZERO]
        {
            let turned =
                DAffine3::from_scale_rotation_translation(scale, DQuat::from_rotation_x(0.4), DVec3::X);
            let Steps::One(trs) = decompose(&turned) else { panic!("{scale} is no shear") };
            assert!(trs.rotation.is_normalized() && error(&turned) < 1e-9, "{scale}: {trs:?}");
        }
    }

    #[test]
    fn a_shear_takes_two_steps() {
        let mut shear = DAffine3::IDENTITY;
        shear.matrix3.y_axis.x = 0.5;
        assert!(matches!(decompose(&shear), Steps::Two(..)));
    }
}
