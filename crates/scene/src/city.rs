//! What things are in a city, for formats that tell houses from trees.

use burgeon_base::error::{Error, Result};

/// What CityJSON calls things of the first rank.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct CityClass(&'static str);

/// The classes that a script may name.
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
    /// A building.
    pub const BUILDING: Self = Self("Building");
    /// What has no class of its own.
    pub const GENERIC: Self = Self("GenericCityObject");

    /// The class called `name`. Fails, and tells which there are, if it is none.
    pub fn of(name: &str) -> Result<Self> {
        CLASSES.iter().find(|known| **known == name).map(|known| Self(known)).ok_or_else(|| {
            let message = format!("{name:?} is no class of city objects");
            Error::not_found("class", name, CLASSES, message)
                .help(format!("there are {}", CLASSES.join(", ")))
        })
    }

    /// Its name.
    pub fn name(self) -> &'static str {
        self.0
    }

    /// Whether its surfaces may be told apart as those of buildings.
    pub fn has_surfaces(self) -> bool {
        ["Building", "Bridge", "Tunnel", "OtherConstruction"].contains(&self.0)
    }

    /// Whether it is one surface.
    pub fn is_relief(self) -> bool {
        self.0 == "TINRelief"
    }

    /// Whether it may be a solid.
    pub fn takes_solids(self) -> bool {
        let flat = ["LandUse", "Railway", "Road", "TINRelief", "TransportSquare", "Waterway"];
        !flat.contains(&self.0)
    }

    /// Whether it, or what is fixed to it, may be an instance of a template.
    pub fn takes_instances(self) -> bool {
        let alone = ["CityFurniture", "GenericCityObject", "OtherConstruction", "SolitaryVegetationObject"];
        alone.contains(&self.0) || self.installation().is_some()
    }

    /// What is fixed to it, if that is of a class of its own.
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
