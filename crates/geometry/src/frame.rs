//! A position with three axes, as a turtle carries it.

use glam::{DAffine3, DMat3, DQuat, DVec3};

/// Where something is and how it is turned.
///
/// The axes are orthonormal and right-handed: `heading` x `left` = `up`, in the words of *The Algorithmic
/// Beauty of Plants*. Angles are radians; a positive turn goes to the left, a positive pitch goes down and a
/// positive roll lowers the left side, as `+`, `&` and `\` do there.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Frame {
    /// The place (m).
    pub position: DVec3,
    /// Forwards.
    pub heading: DVec3,
    /// To the left.
    pub left: DVec3,
    /// Upwards, out of the plane of `heading` and `left`.
    pub up: DVec3,
}

impl Default for Frame {
    /// At the origin, heading along z, with left along -x and up along -y: a plant that grows upwards.
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

    /// Turns to the left about `up`.
    pub fn turn(&mut self, angle: f64) {
        self.turn_by(angle.sin_cos());
    }

    /// As [`Frame::turn`], by the sine and cosine of the angle.
    #[inline]
    pub fn turn_by(&mut self, (sin, cos): (f64, f64)) {
        (self.heading, self.left) =
            (self.heading * cos + self.left * sin, self.left * cos - self.heading * sin);
    }

    /// Pitches down about `left`.
    pub fn pitch(&mut self, angle: f64) {
        self.pitch_by(angle.sin_cos());
    }

    /// As [`Frame::pitch`], by the sine and cosine of the angle.
    #[inline]
    pub fn pitch_by(&mut self, (sin, cos): (f64, f64)) {
        (self.heading, self.up) = (self.heading * cos - self.up * sin, self.up * cos + self.heading * sin);
    }

    /// Rolls about `heading`, from `left` towards -`up`.
    pub fn roll(&mut self, angle: f64) {
        self.roll_by(angle.sin_cos());
    }

    /// As [`Frame::roll`], by the sine and cosine of the angle.
    #[inline]
    pub fn roll_by(&mut self, (sin, cos): (f64, f64)) {
        (self.left, self.up) = (self.left * cos - self.up * sin, self.up * cos + self.left * sin);
    }

    /// Rolls so that `left` is horizontal and `up` looks upwards; a vertical heading leaves the frame.
    pub fn level(&mut self) {
        let left = DVec3::Z.cross(self.heading);
        if left.length_squared() > 1e-18 {
            self.left = left.normalize();
            self.up = self.heading.cross(self.left);
        }
    }

    /// Turns the heading by the shortest way to `direction`, which is not zero.
    pub fn face(&mut self, direction: DVec3) {
        self.rotate(DQuat::from_rotation_arc(self.heading, direction.normalize()));
    }

    /// Turns the heading to `direction`, and rolls so that `up` looks as nearly to `above` as it can; neither is zero. Where
    /// both are the same way, it rolls as [`Frame::face`] does.
    pub fn look(&mut self, direction: DVec3, above: DVec3) {
        self.face(direction);
        let left = above.cross(self.heading);
        if left.length_squared() > 1e-18 * above.length_squared() {
            self.left = left.normalize();
            self.up = self.heading.cross(self.left);
        }
    }

    /// Turns all axes.
    pub fn rotate(&mut self, rotation: DQuat) {
        self.heading = rotation * self.heading;
        self.left = rotation * self.left;
        self.orthonormalize();
    }

    /// Removes the rounding that many turns leave in the axes.
    pub fn orthonormalize(&mut self) {
        self.heading = self.heading.normalize();
        self.left = (self.left - self.heading * self.heading.dot(self.left)).normalize();
        self.up = self.heading.cross(self.left);
    }

    /// From this frame's coordinates to the world's: x to the right, y backwards from `up`, z along the heading.
    ///
    /// So a model made by a frame at rest comes out as it was made.
    pub fn transform(&self) -> DAffine3 {
        DAffine3::from_mat3_translation(DMat3::from_cols(-self.left, -self.up, self.heading), self.position)
    }
}
