//! Flags of pictures: camera, quality, light and background.

use burgeon::picture::{Background, CameraChoice, Picture, Quality, SunPosition, ViewBall};
use burgeon::scene::CameraView;
use clap::{Args, ValueEnum};
use glam::DVec3;

/// Flags of a render, except its size.
#[derive(Args, Clone)]
pub(crate) struct PictureFlags {
    /// Azimuth of the camera: 0 is north, 90 east (degrees) [default: from the model]
    #[arg(long, value_name = "DEGREES", allow_negative_numbers = true, help_heading = "Pictures")]
    azimuth: Option<f64>,

    /// Elevation of the camera above the horizon (degrees) [default: from the model]
    #[arg(long, value_name = "DEGREES", allow_negative_numbers = true, help_heading = "Pictures")]
    elevation: Option<f64>,

    /// Frames the sphere with this centre and radius (m) [default: the whole model]
    #[arg(long, value_name = "X,Y,Z,M", value_parser = look, allow_hyphen_values = true, help_heading = "Pictures")]
    look: Option<ViewBall>,

    /// Camera of the script, or plan, from above, or eye, at the height of a person's eyes [default: the script's first]
    #[arg(long, value_name = "NAME", help_heading = "Pictures")]
    #[arg(conflicts_with_all = ["azimuth", "elevation", "look", "from"])]
    camera: Option<String>,

    /// Position of the camera (m)
    #[arg(long, value_name = "X,Y,Z", value_parser = position, allow_hyphen_values = true, help_heading = "Pictures")]
    #[arg(requires = "to", conflicts_with_all = ["azimuth", "elevation", "look"])]
    from: Option<DVec3>,

    /// Point in the middle of the render (m)
    #[arg(long, value_name = "X,Y,Z", value_parser = position, allow_hyphen_values = true, help_heading = "Pictures")]
    #[arg(requires = "from")]
    to: Option<DVec3>,

    /// Vertical field of view of the camera at --from (degrees)
    #[arg(
        long,
        value_name = "DEGREES",
        default_value_t = 40.0,
        help_heading = "Pictures",
        requires = "from"
    )]
    fov: f64,

    /// Parallel projection of the camera at --from; =METRES is the height that the render shows [default: the whole model]
    #[arg(long, value_name = "METRES", num_args = 0..=1, require_equals = true, help_heading = "Pictures")]
    #[arg(requires = "from", conflicts_with = "fov")]
    orthographic: Option<Option<f64>>,

    /// Quality of the render; films have one of their own
    #[arg(long, value_enum, default_value_t = QualityFlag::Draft, help_heading = "Pictures")]
    quality: QualityFlag,

    /// Sun, by its azimuth and elevation (degrees), or by the solar time of a day in June and the latitude
    /// [default: behind the viewer's left shoulder]
    #[arg(long, value_name = "AZIMUTH,ELEVATION|HH:MM[,LATITUDE]", value_parser = sun, help_heading = "Pictures")]
    #[arg(allow_hyphen_values = true)]
    sun: Option<SunPosition>,

    /// Haze that hides two thirds of what is this far away (m)
    #[arg(long, value_name = "METRES", value_parser = haze, help_heading = "Pictures")]
    haze: Option<f64>,

    /// Background of the render
    #[arg(long, value_enum, default_value_t = BackgroundFlag::Light, help_heading = "Pictures")]
    background: BackgroundFlag,

    /// Leaves out the ground and the shadow on it
    #[arg(long, help_heading = "Pictures")]
    no_floor: bool,
}

/// Parses `X,Y,Z`.
fn position(text: &str) -> std::result::Result<DVec3, &'static str> {
    let numbers: Option<Vec<f64>> = text.split(',').map(|part| part.trim().parse::<f64>().ok()).collect();
    match numbers.as_deref() {
        Some([x, y, z]) if x.is_finite() && y.is_finite() && z.is_finite() => Ok(DVec3::new(*x, *y, *z)),
        _ => Err("write a position, such as 20,-30,1.7"),
    }
}

/// Parses `AZIMUTH,ELEVATION` or `HH:MM[,LATITUDE]`.
fn sun(text: &str) -> std::result::Result<SunPosition, &'static str> {
    const FORM: &str =
        "write an azimuth and an elevation, such as 210,35, or a time, such as 17:30 or 17:30,52";
    const NIGHT: &str =
        "the sun must be above the horizon: an elevation above 0 and at most 90, or a time of the day";
    let (first, second) = text.split_once(',').map_or((text, None), |(first, second)| (first, Some(second)));
    let number = |text: &str| text.trim().parse::<f64>().ok().filter(|number| number.is_finite());
    let sun = match first.split_once(':') {
        Some((hours, minutes)) => {
            let (hours, minutes) = (number(hours).ok_or(FORM)?, number(minutes).ok_or(FORM)?);
            let latitude = second.map_or(Some(LATITUDE), number).ok_or(FORM)?;
            if !(0.0..=24.0).contains(&hours) || !(0.0..60.0).contains(&minutes) || latitude.abs() > 90.0 {
                return Err(FORM);
            }
            SunPosition::at(hours + minutes / 60.0, latitude)
        }
        None => {
            let (azimuth, elevation) = (number(first), second.and_then(number));
            SunPosition { azimuth: azimuth.ok_or(FORM)?, elevation: elevation.ok_or(FORM)? }
        }
    };
    if sun.elevation > 0.0 && sun.elevation <= 90.0 { Ok(sun) } else { Err(NIGHT) }
}

/// Latitude at which a time without another is meant (degrees).
const LATITUDE: f64 = 45.0;

fn haze(text: &str) -> std::result::Result<f64, &'static str> {
    match text.parse::<f64>() {
        Ok(distance) if distance.is_finite() && distance > 0.0 => Ok(distance),
        _ => Err("write a distance above 0, such as 2000"),
    }
}

/// Parses `X,Y,Z,M`.
fn look(text: &str) -> std::result::Result<ViewBall, &'static str> {
    let numbers: Vec<f64> = text
        .split(',')
        .map(|part| part.trim().parse::<f64>())
        .collect::<std::result::Result<_, _>>()
        .unwrap_or_default();
    match numbers.as_slice() {
        [x, y, z, radius] if numbers.iter().all(|number| number.is_finite()) && *radius > 0.0 => {
            Ok(ViewBall { at: [*x, *y, *z], radius: *radius })
        }
        _ => Err("write a position and a distance above 0, such as 10,-5,0,40"),
    }
}

#[derive(Clone, Copy, ValueEnum)]
enum BackgroundFlag {
    Light,
    Dark,
    /// Sky and a ground that reaches to the horizon
    Sky,
    /// Transparent
    Clear,
}

#[derive(Clone, Copy, ValueEnum)]
enum QualityFlag {
    /// Few samples, in less than a second for most models
    Draft,
    /// Smooth edges and soft shadows
    Fine,
    /// As many samples as large prints show
    Best,
}

impl PictureFlags {
    pub(crate) fn picture(&self, (width, height): (u32, u32)) -> Picture {
        Picture {
            width,
            height,
            azimuth: self.azimuth,
            elevation: self.elevation,
            look: self.look,
            camera: match (&self.camera, self.from, self.to) {
                (Some(name), ..) => CameraChoice::Named(name.clone()),
                (None, Some(from), Some(to)) => CameraChoice::View(match self.orthographic {
                    Some(height) => CameraView::Orthographic { from, to, height },
                    None => CameraView::Perspective { from, to, fov: self.fov },
                }),
                _ => CameraChoice::Automatic,
            },
            sun: self.sun,
            haze: self.haze,
            ground: !self.no_floor,
            quality: match self.quality {
                QualityFlag::Draft => Quality::Draft,
                QualityFlag::Fine => Quality::Fine,
                QualityFlag::Best => Quality::Best,
            },
            background: match self.background {
                BackgroundFlag::Light => Background::Light,
                BackgroundFlag::Dark => Background::Dark,
                BackgroundFlag::Sky => Background::Sky,
                BackgroundFlag::Clear => Background::Clear,
            },
        }
    }
}
