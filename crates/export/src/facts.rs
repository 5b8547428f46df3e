//! What is written: what is seen, and what is known of it.

use burgeon_data::ReferenceFrame;
use burgeon_data::output::RecordTable;
use burgeon_picture::Picture;
use burgeon_scene::{CityClass, Scene};

/// What a run gives to its files.
#[derive(Clone, Copy)]
pub struct Export<'a> {
    /// What is seen.
    pub scene: &'a Scene,
    /// How a picture of it is taken.
    pub picture: &'a Picture,
    /// What is known of it.
    pub facts: SceneFacts<'a>,
}

/// What is known of a scene besides what is seen, for formats that tell it.
#[derive(Clone, Copy)]
pub struct SceneFacts<'a> {
    /// Where on the earth it is.
    pub frame: Option<&'a ReferenceFrame>,
    /// The level of detail that it was made in, from 0 to 3.
    pub detail: u8,
    /// What is known of the systems that put something into the scene, as far as they have features.
    pub systems: &'a [SystemFacts],
    /// What rules made that has a geometry: a table for each symbol.
    pub layers: &'a [RecordTable],
    /// The attributes of features that models in glTF have, beside ids (`EXT_structural_metadata`); `None` for neither.
    pub metadata: Option<&'a [String]>,
}

/// What is known of a system's chains.
#[derive(Debug, Clone, Default)]
pub struct SystemFacts {
    /// The system's place in the script, from 0.
    pub system: usize,
    /// For each of its chains in their order, what is known of its feature.
    pub records: RecordTable,
    /// What its chains are in a city, if the script says.
    pub class: Option<CityClass>,
}

impl Default for SceneFacts<'_> {
    /// Nothing is known of a scene in full detail.
    fn default() -> Self {
        Self { frame: None, detail: 3, systems: &[], layers: &[], metadata: None }
    }
}
