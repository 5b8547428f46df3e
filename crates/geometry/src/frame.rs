//! Turtle frames: a position with three axes.

use glam::{DAffine3, DMat3, DQuat, DVec3};

/// Position and orientation of a turtle.
///
/// The axes are orthonormal and right-handed: `heading` x `left` = `up`, in the terms of *The Algorithmic
/// Beauty of Plants*. Angles are in radians. As with `+`, `&` and `\` in that book, a positive turn goes to
/// the left, a positive pitch goes down, and a positive roll lowers the left side.
///
/// ```
/// use burgeon_geometry::Frame;
/// use glam::DVec3;
/// use std::f64::consts::FRAC_PI_2;
///
/// let mut frame = Frame::default();
/// frame.forward(2.0);
/// frame.turn(FRAC_PI_2);
/// frame.forward(3.0);
/// // A turn to the left of a frame that points upwards leads along -x.
/// assert!(frame.position.abs_diff_eq(DVec3::new(-3.0, 0.0, 2.0), 1e-12));
/// assert!(frame.heading.cross(frame.left).abs_diff_eq(frame.up, 1e-12));
/// ```
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Frame {
    /// Position (m).
    pub position: DVec3,
    /// Forward direction.
    pub heading: DVec3,
    /// Left direction.
    pub left: DVec3,
    /// Up direction, normal to the plane of `heading` and `left`.
    pub up: DVec3,
}

impl Default for Frame {
    /// Returns a frame at the origin with `heading` along z, `left` along -x and `up` along -y: a plant that
    /// grows upwards.
    fn default() -> Self {
        Self { position: DVec3::ZERO, heading: DVec3::Z, left: DVec3::NEG_X, up: DVec3::NEG_Y }
    }
}

impl Frame {
    /// Moves along the heading by `length` (m).
    #[inline]
    pub fn forward(&mut self, length: f64) {
        self.position += self.heading * length;
    }

    /// Turns left about `up` by `angle` (radians).
    pub fn turn(&mut self, angle: f64) {
        self.turn_by(angle.sin_cos());
    }

    /// Turns like [`Frame::turn`], by the sine and cosine of the angle.
    #[inline]
    pub fn turn_by(&mut self, (sin, cos): (f64, f64)) {
        (self.heading, self.left) =
            (self.heading * cos + self.left * sin, self.left * cos - self.heading * sin);
    }

    /// Pitches down about `left` by `angle` (radians).
    pub fn pitch(&mut self, angle: f64) {
        self.pitch_by(angle.sin_cos());
    }

    /// Pitches like [`Frame::pitch`], by the sine and cosine of the angle.
    #[inline]
    pub fn pitch_by(&mut self, (sin, cos): (f64, f64)) {
        (self.heading, self.up) = (self.heading * cos - self.up * sin, self.up * cos + self.heading * sin);
    }

    /// Rolls about `heading` by `angle` (radians), from `left` towards -`up`.
    pub fn roll(&mut self, angle: f64) {
        self.roll_by(angle.sin_cos());
    }

    /// Rolls like [`Frame::roll`], by the sine and cosine of the angle.
    #[inline]
    pub fn roll_by(&mut self, (sin, cos): (f64, f64)) {
        (self.left, self.up) = (self.left * cos - self.up * sin, self.up * cos + self.left * sin);
    }

    /// Rolls so that `left` is horizontal and `up` points upwards; a frame with a vertical heading is
    /// unchanged.
    pub fn level(&mut self) {
        let left = DVec3::Z.cross(self.heading);
        if left.length_squared() > 1e-18 {
            self.left = left.normalize();
            self.up = self.heading.cross(self.left);
        }
    }

    /// Rotates the heading to `direction` by the smallest angle; `direction` is not zero.
    pub fn face(&mut self, direction: DVec3) {
        self.rotate(DQuat::from_rotation_arc(self.heading, direction.normalize()));
    }

    /// Rotates the heading to `direction`, and rolls so that `up` is as close to `above` as possible; neither
    /// is zero.
    ///
    /// If both vectors are parallel, it rolls like [`Frame::face`].
    pub fn look(&mut self, direction: DVec3, above: DVec3) {
        self.face(direction);
        let left = above.cross(self.heading);
        if left.length_squared() > 1e-18 * above.length_squared() {
            self.left = left.normalize();
            self.up = self.heading.cross(self.left);
        }
    }

    /// Rotates all axes.
    pub fn rotate(&mut self, rotation: DQuat) {
        self.heading = rotation * self.heading;
        self.left = rotation * self.left;
        self.orthonormalize();
    }

    /// Removes the rounding errors of many rotations from the axes.
    pub fn orthonormalize(&mut self) {
        self.heading = self.heading.normalize();
        self.left = (self.left - self.heading * self.heading.dot(self.left)).normalize();
        self.up = self.heading.cross(self.left);
    }

    /// Returns the transformation from this frame's coordinates to world coordinates: x is right, y is
    /// opposite to `up`, z is along the heading.
    ///
    /// For the default frame it is the identity.
    ///
    /// ```
    /// use burgeon_geometry::Frame;
    /// use glam::{DAffine3, DVec3};
    ///
    /// assert_eq!(Frame::default().transform(), DAffine3::IDENTITY);
    /// let moved = Frame { position: DVec3::new(4.0, 5.0, 6.0), ..Frame::default() };
    /// assert_eq!(moved.transform().transform_point3(DVec3::X), DVec3::new(5.0, 5.0, 6.0));
    /// ```
    pub fn transform(&self) -> DAffine3 {
        DAffine3::from_mat3_translation(DMat3::from_cols(-self.left, -self.up, self.heading), self.position)
    }
}
