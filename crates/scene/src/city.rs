//! Classes of city objects, for formats that distinguish houses from trees.

use burgeon_base::error::{Error, Result};

/// Class of a top-level city object in CityJSON.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct CityClass(&'static str);

/// Classes that a script may specify.
const CLASSES: [&str; 15] = [
    "Bridge",
    "Building",
    "CityFurniture",
    "GenericCityObject",
    "LandUse",
    "OtherConstruction",
    "PlantCover",
    "Railway",
    "Road",
    "SolitaryVegetationObject",
    "TINRelief",
    "TransportSquare",
    "Tunnel",
    "WaterBody",
    "Waterway",
];

impl CityClass {
    /// Class of buildings.
    pub const BUILDING: Self = Self("Building");
    /// Class of objects without a more specific class.
    pub const GENERIC: Self = Self("GenericCityObject");

    /// Returns the class called `name`. Fails if there is none; the error lists the classes.
    pub fn of(name: &str) -> Result<Self> {
        CLASSES.iter().find(|known| **known == name).map(|known| Self(known)).ok_or_else(|| {
            let message = format!("unknown CityJSON class {name:?}");
            Error::not_found("class", name, CLASSES, message).help(format!("use {}", CLASSES.join(", ")))
        })
    }

    /// Returns the name of the class.
    pub fn name(self) -> &'static str {
        self.0
    }

    /// Returns true if objects of the class may have semantic surfaces, as buildings do.
    pub fn has_surfaces(self) -> bool {
        ["Building", "Bridge", "Tunnel", "OtherConstruction"].contains(&self.0)
    }

    /// Returns true if objects of the class are a single surface.
    pub fn is_relief(self) -> bool {
        self.0 == "TINRelief"
    }

    /// Returns true if objects of the class may be solids.
    pub fn takes_solids(self) -> bool {
        let flat = ["LandUse", "Railway", "Road", "TINRelief", "TransportSquare", "Waterway"];
        !flat.contains(&self.0)
    }

    /// Returns true if objects of the class, or their installations, may be instances of templates.
    pub fn takes_instances(self) -> bool {
        let alone = ["CityFurniture", "GenericCityObject", "OtherConstruction", "SolitaryVegetationObject"];
        alone.contains(&self.0) || self.installation().is_some()
    }

    /// Returns the class of objects that are fixed to an object of this class, if there is such a class.
    pub fn installation(self) -> Option<String> {
        ["Building", "Bridge", "Tunnel"].contains(&self.0).then(|| format!("{}Installation", self.0))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_class_is_found_by_its_name_alone() {
        assert_eq!(CityClass::of("Road").map(CityClass::name).ok(), Some("Road"));
        let error = CityClass::of("Raod").expect_err("no class");
        assert!(error.remedy().is_some_and(|help| help.contains("Road")), "{error}");
        assert!(CityClass::of("building").is_err());
    }
}
