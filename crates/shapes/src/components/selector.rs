//! Selection of faces by direction, slope or tag.

use burgeon_base::error::{Error, Result};
use burgeon_base::text::listed;
use glam::{DMat3, DVec3};

use crate::style::{FaceStyle, SharedStyle};

/// Selects faces of a shape.
#[derive(Debug, Clone, PartialEq)]
pub enum Selector {
    /// All faces.
    All,
    /// Faces towards a direction of the shape's own scope.
    Own(FaceDirection),
    /// Faces towards a direction of the world.
    World(FaceDirection),
    /// Faces by their inclination in the world.
    Inclined(Inclination),
    /// Faces with a tag that matches a pattern.
    Tagged(String),
}

/// Direction of a face: the nearest axis.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum FaceDirection {
    /// Along +z.
    Top,
    /// Along -z.
    Bottom,
    /// Along -y.
    Front,
    /// Along +y.
    Back,
    /// Along -x.
    Left,
    /// Along +x.
    Right,
    /// Neither top nor bottom.
    Side,
}

/// Inclination of a face.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Inclination {
    /// Within 11.25 degrees of a wall.
    Vertical,
    /// Within 11.25 degrees of a floor or ceiling.
    Horizontal,
    /// Upwards, between horizontal and vertical.
    Slanted,
    /// Downwards, between horizontal and vertical.
    Overhanging,
}

/// Sine of the angle (11.25 degrees) within which a face is vertical or horizontal.
const NEAR: f64 = 0.195_090_322_016_128_28;

/// Selectors with fixed names.
static NAMES: [(&str, Selector); 18] = {
    use FaceDirection::{Back, Bottom, Front, Left, Right, Side, Top};
    use Inclination::{Horizontal, Overhanging, Slanted, Vertical};
    [
        ("all", Selector::All),
        ("top", Selector::Own(Top)),
        ("bottom", Selector::Own(Bottom)),
        ("front", Selector::Own(Front)),
        ("back", Selector::Own(Back)),
        ("left", Selector::Own(Left)),
        ("right", Selector::Own(Right)),
        ("side", Selector::Own(Side)),
        ("up", Selector::World(Top)),
        ("down", Selector::World(Bottom)),
        ("south", Selector::World(Front)),
        ("north", Selector::World(Back)),
        ("west", Selector::World(Left)),
        ("east", Selector::World(Right)),
        ("vertical", Selector::Inclined(Vertical)),
        ("horizontal", Selector::Inclined(Horizontal)),
        ("slanted", Selector::Inclined(Slanted)),
        ("overhanging", Selector::Inclined(Overhanging)),
    ]
};

impl Selector {
    /// Reads a selector: a name such as "front" or "south", or "tag:" with a pattern.
    ///
    /// ```
    /// use burgeon_shapes::Selector;
    ///
    /// assert!(Selector::read("front").is_ok() && Selector::read("tag:roof.*").is_ok());
    /// let error = Selector::read("frnt").expect_err("misspelt");
    /// assert_eq!(error.remedy(), Some("did you mean front?"));
    /// ```
    pub fn read(name: &str) -> Result<Self> {
        if let Some(pattern) = name.strip_prefix("tag:") {
            return Ok(Self::Tagged(pattern.trim().to_owned()));
        }
        if let Some((_, selector)) = NAMES.iter().find(|(known, _)| *known == name) {
            return Ok(selector.clone());
        }
        let names = || NAMES.iter().map(|(name, _)| *name);
        Err(Error::not_found("selector", name, names(), format!("unknown selector {name:?}"))
            .help(format!("use {}, or \"tag:\" with a pattern", listed(names()))))
    }

    /// Returns the bit of a selector with a fixed name; `None` for a pattern of tags.
    pub fn bit(&self) -> Option<u32> {
        NAMES.iter().position(|(_, known)| known == self).map(|index| 1 << index)
    }

    /// Returns the bits of the selectors with fixed names that match a face, as [`Selector::matches`].
    pub fn matching(normal: DVec3, axes: &DMat3) -> u32 {
        let (own, world) = (FaceDirection::of(axes.transpose() * normal), FaceDirection::of(normal));
        let inclination = Inclination::of(normal);
        let is_match = |selector: &Self| match selector {
            Self::All => true,
            Self::Own(direction) => direction.includes(own),
            Self::World(direction) => direction.includes(world),
            Self::Inclined(wanted) => *wanted == inclination,
            Self::Tagged(_) => false,
        };
        NAMES.iter().enumerate().map(|(index, (_, selector))| u32::from(is_match(selector)) << index).sum()
    }

    /// Returns true for a face with this unit normal and style, of a shape with these axes.
    pub fn matches(&self, normal: DVec3, style: &SharedStyle, axes: &DMat3) -> bool {
        match self {
            Self::All => true,
            Self::Own(direction) => direction.includes(FaceDirection::of(axes.transpose() * normal)),
            Self::World(direction) => direction.includes(FaceDirection::of(normal)),
            Self::Inclined(inclination) => *inclination == Inclination::of(normal),
            Self::Tagged(pattern) => FaceStyle::has_tag(style, pattern),
        }
    }
}

impl FaceDirection {
    /// Returns the direction of a normal; the vertical axis wins from 45 degrees on, and then x before y.
    fn of(normal: DVec3) -> Self {
        let size = normal.abs();
        // Rounding does not decide at exactly 45 degrees.
        let slack = 1e-9;
        if size.z * size.z + slack >= size.x * size.x + size.y * size.y {
            return if normal.z > 0.0 { Self::Top } else { Self::Bottom };
        }
        if size.x > size.y + slack {
            if normal.x > 0.0 { Self::Right } else { Self::Left }
        } else if normal.y > 0.0 {
            Self::Back
        } else {
            Self::Front
        }
    }

    /// Returns true for a face with the direction `own`.
    fn includes(self, own: Self) -> bool {
        own == self || (self == Self::Side && !matches!(own, Self::Top | Self::Bottom))
    }
}

impl Inclination {
    fn of(normal: DVec3) -> Self {
        if normal.z.abs() <= NEAR {
            Self::Vertical
        } else if normal.truncate().length() <= NEAR {
            Self::Horizontal
        } else if normal.z > 0.0 {
            Self::Slanted
        } else {
            Self::Overhanging
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn each_direction_is_one_of_six() {
        let names = ["top", "bottom", "front", "back", "left", "right"];
        let selectors = names.map(|name| Selector::read(name).expect("known"));
        for step in 0..400 {
            let step = f64::from(step);
            let normal = DVec3::new((step * 0.7).sin(), (step * 1.3).cos(), (step * 0.37).sin()).normalize();
            let found = selectors.iter().filter(|it| it.matches(normal, &None, &DMat3::IDENTITY)).count();
            assert_eq!(found, 1, "{normal}");
        }
    }

    #[test]
    fn a_roof_slope_is_slanted_and_its_soffit_overhanging() {
        let slope = DVec3::new(0.0, -1.0, 1.0).normalize();
        let is = |name: &str, normal| {
            Selector::read(name).expect("known").matches(normal, &None, &DMat3::IDENTITY)
        };
        assert!(is("slanted", slope) && is("top", slope) && !is("vertical", slope));
        assert!(is("overhanging", -slope) && is("vertical", DVec3::X) && is("horizontal", -DVec3::Z));
    }
}
