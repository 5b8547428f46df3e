//! Places of an object at modules of a chain, for rules that read them.

use burgeon_kit::ObjectPlace;

/// Places of an object at modules of a chain.
#[derive(Default)]
pub(crate) struct ModulePlaces {
    /// Indices of the modules, ascending.
    modules: Vec<u32>,
    places: Vec<ObjectPlace>,
}

impl ModulePlaces {
    /// Creates the places of modules, given with their indices in any order.
    pub(crate) fn new(mut places: Vec<(u32, ObjectPlace)>) -> Self {
        places.sort_by_key(|(module, _)| *module);
        let (modules, places) = places.into_iter().unzip();
        Self { modules, places }
    }

    /// Returns the place at the module with this index, if it is known.
    pub(crate) fn get(&self, module: u32) -> Option<&ObjectPlace> {
        self.places.get(self.modules.binary_search(&module).ok()?)
    }
}
