//! Settings of a render.

use burgeon_base::error::{Error, Result};
use burgeon_scene::CameraView;
use serde::Deserialize;

/// Settings of a render.
///
/// ```
/// use burgeon_picture::{Background, Picture};
///
/// let json = r#"{ "width": 640, "azimuth": 45, "background": "clear", "quality": "draft" }"#;
/// let picture: Picture = serde_json::from_str(json)?;
/// assert_eq!((picture.width, picture.height, picture.background), (640, 960, Background::Clear));
/// assert!(serde_json::from_str::<Picture>(r#"{ "widht": 640 }"#).is_err());
/// # Ok::<(), serde_json::Error>(())
/// ```
#[derive(Debug, Clone, PartialEq, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct Picture {
    /// Width (pixels), 1 to 16384.
    pub width: u32,
    /// Height (pixels), 1 to 16384.
    pub height: u32,
    /// Azimuth of the camera (degrees): 0 is north of the model, 90 east, 180 south. North is +y, or the pole of a
    /// planet. `None` chooses by the model's shape: a three-quarter view, or the broad side of a flat model.
    pub azimuth: Option<f64>,
    /// Elevation of the camera above the horizon (degrees), -90 to 90. `None` chooses by the model's shape: lower for a
    /// tall model, higher for a low one.
    pub elevation: Option<f64>,
    /// Sphere that the render shows: its centre (m) and radius (m). `None` shows the whole model.
    pub look: Option<ViewBall>,
    /// Camera of the render. The angles and the sphere above replace the first camera of the scene.
    #[serde(skip)]
    pub camera: CameraChoice,
    /// Position of the sun. `None` places it behind the left shoulder of the viewer.
    pub sun: Option<SunPosition>,
    /// Distance (m) at which haze hides two thirds of a surface; `None` is clear air.
    pub haze: Option<f64>,
    /// Background of the render.
    pub background: Background,
    /// Set if a ground plane below the model's lowest point shows its shadow.
    pub ground: bool,
    /// Quality of the render, which determines the time.
    pub quality: Quality,
}

/// Sphere that fills a render.
#[derive(Debug, Clone, Copy, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct ViewBall {
    /// Centre (m): x, y and z.
    pub at: [f64; 3],
    /// Radius (m).
    pub radius: f64,
}

/// Choice of the camera of a render.
#[derive(Debug, Clone, Default, PartialEq)]
pub enum CameraChoice {
    /// First camera of the scene, or one that is fitted to the model.
    #[default]
    Automatic,
    /// Camera of the scene with this name.
    Named(String),
    /// Camera at this place.
    View(CameraView),
}

/// Direction of the sun.
#[derive(Debug, Clone, Copy, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct SunPosition {
    /// Azimuth from north, clockwise (degrees).
    pub azimuth: f64,
    /// Elevation above the horizon (degrees), above 0 and at most 90.
    pub elevation: f64,
}

impl SunPosition {
    /// Returns the position at a true solar time of `hour` (h), 12 at noon, at this `latitude` (degrees) on the day of the
    /// longest light in the north, 21 June. The elevation is negative at night.
    ///
    /// ```
    /// use burgeon_picture::SunPosition;
    ///
    /// let noon = SunPosition::at(12.0, 45.0);
    /// assert!((noon.azimuth - 180.0).abs() < 1e-6 && (noon.elevation - 68.44).abs() < 0.01);
    /// assert!(SunPosition::at(7.0, 45.0).azimuth < 90.0 && SunPosition::at(0.0, 45.0).elevation < 0.0);
    /// ```
    #[must_use]
    pub fn at(hour: f64, latitude: f64) -> Self {
        let (turn, latitude) = (((hour - 12.0) * 15.0).to_radians(), latitude.to_radians());
        let tilt = TILT.to_radians();
        let up = latitude.sin() * tilt.sin() + latitude.cos() * tilt.cos() * turn.cos();
        let (east, north) = (
            -tilt.cos() * turn.sin(),
            tilt.sin() * latitude.cos() - tilt.cos() * latitude.sin() * turn.cos(),
        );
        Self {
            azimuth: east.atan2(north).to_degrees().rem_euclid(360.0),
            elevation: up.clamp(-1.0, 1.0).asin().to_degrees(),
        }
    }
}

/// Tilt of the earth's axis (degrees).
const TILT: f64 = 23.44;

/// Background of a render.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Background {
    /// Light, slightly warm grey, as in a studio.
    #[default]
    Light,
    /// Dark, slightly cool grey.
    Dark,
    /// Sky with the sun's glow, above a ground that reaches to the horizon.
    Sky,
    /// Transparent, with the shadow on the ground as translucent black.
    Clear,
}

/// Quality of a render.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Quality {
    /// Few samples, whose light neighbouring pixels share: less than a second for most models.
    #[default]
    Draft,
    /// Smooth edges and shadows that stay still from frame to frame, for films.
    Film,
    /// Smooth edges and soft shadows, for presentation.
    Fine,
    /// As many samples as large prints show, in several times the time of [`Fine`](Self::Fine).
    Best,
}

impl Default for Picture {
    /// Returns the default settings: 1280 by 960 pixels, draft quality, a light studio, and a viewpoint chosen by the
    /// model's shape.
    fn default() -> Self {
        Self {
            width: 1280,
            height: 960,
            azimuth: None,
            elevation: None,
            look: None,
            camera: CameraChoice::Automatic,
            sun: None,
            haze: None,
            background: Background::Light,
            ground: true,
            quality: Quality::Draft,
        }
    }
}

impl Picture {
    /// Maximum width and height (pixels).
    pub const LARGEST: u32 = 16384;

    /// Returns true if no angle and no sphere replaces the first camera of the scene.
    pub fn is_free(&self) -> bool {
        self.azimuth.is_none() && self.elevation.is_none() && self.look.is_none()
    }

    /// Fails if the size or an angle is invalid.
    ///
    /// ```
    /// use burgeon_picture::Picture;
    ///
    /// assert!(Picture::default().check().is_ok());
    /// assert!(Picture { width: 0, ..Picture::default() }.check().is_err());
    /// assert!(Picture { elevation: Some(100.0), ..Picture::default() }.check().is_err());
    /// ```
    pub fn check(&self) -> Result<()> {
        let fits = |size: u32| (1..=Self::LARGEST).contains(&size);
        if !fits(self.width) || !fits(self.height) {
            let message = format!("invalid image size {} x {}", self.width, self.height);
            return Err(Error::argument(message)
                .help(format!("use a width and a height from 1 to {} pixels", Self::LARGEST)));
        }
        if self
            .sun
            .is_some_and(|sun| !(sun.azimuth.is_finite() && 0.0 < sun.elevation && sun.elevation <= 90.0))
        {
            return Err(Error::argument("the sun is not above the horizon")
                .help("give an elevation above 0 and at most 90 degrees, or a time of the day"));
        }
        if self.haze.is_some_and(|distance| !distance.is_finite() || distance <= 0.0) {
            return Err(
                Error::argument("the distance of the haze is not above 0").help("give metres, such as 2000")
            );
        }
        if let CameraChoice::View(view) = &self.camera {
            view.check()?;
        }
        if self.azimuth.is_some_and(|angle| !angle.is_finite()) {
            return Err(
                Error::argument("the camera's azimuth is not a number").help("give degrees from north")
            );
        }
        if self.elevation.is_some_and(|angle| !(-90.0..=90.0).contains(&angle)) {
            return Err(Error::argument("the camera's elevation is outside -90 to 90 degrees")
                .help("give degrees above the horizon"));
        }
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_size_of_zero_or_beyond_the_limit_is_refused() {
        for (width, height) in [(0, 10), (10, 0), (16385, 10)] {
            let error = Picture { width, height, ..Picture::default() }.check().unwrap_err();
            assert!(error.to_string().contains(&format!("{width} x {height}")), "{error}");
        }
        assert!(Picture { width: 16384, height: 1, ..Picture::default() }.check().is_ok());
    }

    #[test]
    fn a_misspelt_wish_is_refused() {
        assert!(serde_json::from_str::<Picture>(r#"{"widht": 100}"#).is_err());
        let picture: Picture = serde_json::from_str(r#"{"width": 100, "background": "dark"}"#).unwrap();
        assert_eq!((picture.width, picture.height, picture.background), (100, 960, Background::Dark));
    }
}
