//! Cameras of a scene, which scripts place.

use burgeon_base::error::{Error, Result, SourcePlace};
use glam::DVec3;

/// Camera with a name.
#[derive(Debug, Clone, PartialEq)]
pub struct SceneCamera {
    /// Name, unique in the scene.
    pub name: String,
    /// Position and projection.
    pub view: CameraView,
    /// Line of the declaration, if a script declares the camera.
    pub place: Option<SourcePlace>,
}

/// Position and projection of a camera. Up is z.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum CameraView {
    /// Perspective.
    Perspective {
        /// Position (m).
        from: DVec3,
        /// Point in the middle of the picture (m).
        to: DVec3,
        /// Vertical field of view (degrees).
        fov: f64,
    },
    /// Parallel projection.
    Orthographic {
        /// Position (m), from which the point is seen.
        from: DVec3,
        /// Point in the middle of the picture (m).
        to: DVec3,
        /// Height (m) that the picture shows; `None` fits the whole model.
        height: Option<f64>,
    },
    /// Parallel projection from above, with north at the top, fitted to the model.
    Plan,
    /// Perspective from the height of a standing person's eyes, 1.7 m above the lowest point, fitted to the model.
    EyeLevel {
        /// Azimuth from north, clockwise (degrees); `None` chooses by the model's shape.
        azimuth: Option<f64>,
    },
    /// Perspective or parallel projection in a direction, from where it shows its whole target.
    Fitted(FittedView),
}

/// Camera by angles, whose distance is fitted to its target.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct FittedView {
    /// Azimuth from north, clockwise (degrees); `None` chooses by the model's shape.
    pub azimuth: Option<f64>,
    /// Elevation above the horizon (degrees), -90 to 90; `None` chooses by the model's shape.
    pub elevation: Option<f64>,
    /// Vertical field of view (degrees) of a perspective; `None` is that of a picture without a camera.
    pub fov: Option<f64>,
    /// Sphere that fills the picture: its centre (m) and radius (m). `None` shows the whole model.
    pub sphere: Option<(DVec3, f64)>,
    /// Set for a parallel projection.
    pub is_parallel: bool,
}

impl CameraView {
    /// Fails if the camera has no direction or no size.
    ///
    /// ```
    /// use burgeon_scene::CameraView;
    /// use glam::DVec3;
    ///
    /// let view = |to| CameraView::Perspective { from: DVec3::ONE, to, fov: 40.0 };
    /// assert!(view(DVec3::ZERO).check().is_ok());
    /// assert_eq!(view(DVec3::ONE).check().unwrap_err().message(), "the camera has no direction");
    /// ```
    pub fn check(&self) -> Result<()> {
        let direction = |from: DVec3, to: DVec3| {
            if !from.is_finite() || !to.is_finite() {
                return Err(Error::argument("the position of the camera is not finite")
                    .help("give three numbers (m)"));
            }
            if (to - from).length() <= 1e-9 * (1.0 + from.length()) {
                return Err(Error::argument("the camera has no direction")
                    .help("give two different points: from, its position, and to, the point that it shows"));
            }
            Ok(())
        };
        match *self {
            Self::Perspective { from, to, fov } => {
                check_fov(fov)?;
                direction(from, to)
            }
            Self::Orthographic { from, to, height } => {
                if height.is_some_and(|height| !height.is_finite() || height <= 0.0) {
                    return Err(Error::argument("the height that the camera shows is not above 0")
                        .help("give metres above 0"));
                }
                direction(from, to)
            }
            Self::EyeLevel { azimuth: Some(azimuth) } if !azimuth.is_finite() => {
                Err(Error::argument("the camera's azimuth is not a number").help("give degrees from north"))
            }
            Self::Fitted(view) => view.check(),
            Self::Plan | Self::EyeLevel { .. } => Ok(()),
        }
    }

    /// Returns the name of the kind of view, as scripts write it.
    #[must_use]
    pub fn kind_name(&self) -> &'static str {
        match self {
            Self::Perspective { .. } | Self::Fitted(FittedView { is_parallel: false, .. }) => "perspective",
            Self::Orthographic { .. } | Self::Fitted(FittedView { is_parallel: true, .. }) => "orthographic",
            Self::Plan => "plan",
            Self::EyeLevel { .. } => "eye",
        }
    }

    /// Returns the position (m) of a camera that is not fitted to the model.
    #[must_use]
    pub fn position(&self) -> Option<DVec3> {
        match *self {
            Self::Perspective { from, .. } => Some(from),
            // A parallel projection shows the whole model, wherever the camera stands.
            Self::Orthographic { .. } | Self::Plan | Self::EyeLevel { .. } | Self::Fitted(_) => None,
        }
    }
}

impl FittedView {
    /// Fails if an angle, the field of view or the sphere is invalid.
    fn check(&self) -> Result<()> {
        if self.azimuth.is_some_and(|azimuth| !azimuth.is_finite()) {
            return Err(
                Error::argument("the camera's azimuth is not a number").help("give degrees from north")
            );
        }
        if let Some(elevation) = self.elevation.filter(|elevation| !(-90.0..=90.0).contains(elevation)) {
            return Err(Error::argument(format!("the elevation of the camera is {elevation} degrees"))
                .help("give -90 to 90 degrees above the horizon"));
        }
        if let Some((center, radius)) = self.sphere {
            if !center.is_finite() {
                return Err(Error::argument("the point that the camera shows is not finite")
                    .help("give three numbers (m)"));
            }
            if !radius.is_finite() || radius <= 0.0 {
                return Err(Error::argument(format!("the radius that the camera shows is {radius} m"))
                    .help("give metres above 0"));
            }
        }
        self.fov.map_or(Ok(()), check_fov)
    }
}

/// Fails if a field of view (degrees) is invalid.
fn check_fov(fov: f64) -> Result<()> {
    if (1.0..=120.0).contains(&fov) {
        return Ok(());
    }
    Err(Error::argument(format!("the field of view is {fov} degrees")).help("give 1 to 120 degrees"))
}
