//! What can be wished of a picture.

use burgeon_base::error::{Error, Result};
use serde::Deserialize;

/// How a scene is rendered.
#[derive(Debug, Clone, PartialEq, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct Picture {
    /// Width (pixels), 1 to 16384.
    pub width: u32,
    /// Height (pixels), 1 to 16384.
    pub height: u32,
    /// Where the camera stands (degrees): 0 to the north of the model, 90 to the east, 180 to the south.
    /// North is +y, on a planet its pole. Without it the model's shape decides: a three-quarter view, or the broad side of what is
    /// flat.
    pub azimuth: Option<f64>,
    /// How high the camera stands above the horizon (degrees), -90 to 90. Without it the model's shape
    /// decides: lower for what is tall, higher for what is low.
    pub elevation: Option<f64>,
    /// What is looked at: a place (m), and how far (m) around it is in the picture. Without it the whole model is.
    pub look: Option<ViewBall>,
    /// What is behind the model.
    pub background: Background,
    /// Whether a ground under the model's lowest point catches its shadow.
    pub ground: bool,
    /// How much time to spend.
    pub quality: Quality,
}

/// A ball that fills a picture.
#[derive(Debug, Clone, Copy, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct ViewBall {
    /// Its centre (m): x, y and z.
    pub at: [f64; 3],
    /// Its radius (m).
    pub radius: f64,
}

/// What is behind the model.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Background {
    /// A light, slightly warm grey, as in a studio.
    #[default]
    Light,
    /// A dark, slightly cool grey.
    Dark,
    /// Nothing: the image is transparent there, with the shadow on the ground as translucent black.
    Clear,
}

/// How much time to spend.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Quality {
    /// For thumbnails: a few samples.
    Draft,
    /// For showing: smooth edges, soft shadows.
    #[default]
    Fine,
}

impl Default for Picture {
    /// 1280 by 960 pixels, fine, in a light studio, from where the model is seen best.
    fn default() -> Self {
        Self {
            width: 1280,
            height: 960,
            azimuth: None,
            elevation: None,
            look: None,
            background: Background::Light,
            ground: true,
            quality: Quality::Fine,
        }
    }
}

impl Picture {
    /// The largest width and height (pixels).
    pub const LARGEST: u32 = 16384;

    /// Refuses sizes and angles that have no picture.
    pub fn check(&self) -> Result<()> {
        let fits = |size: u32| (1..=Self::LARGEST).contains(&size);
        if !fits(self.width) || !fits(self.height) {
            let message = format!("a picture cannot be {} x {} pixels", self.width, self.height);
            return Err(Error::argument(message)
                .help(format!("give a width and a height from 1 to {}", Self::LARGEST)));
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
