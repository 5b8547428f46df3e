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

    /// Returns the places in a chain from which modules were removed; `applied` has for each symbol the number of symbols
    /// that it became, 1 or 0.
    pub(crate) fn after(&self, applied: &[(u16, u32)]) -> Self {
        let mut known = self.modules.iter().zip(&self.places).peekable();
        let mut kept = Self::default();
        let mut index = 0;
        for (before, (_, count)) in (0u32..).zip(applied) {
            if let Some((_, place)) = known.next_if(|(module, _)| **module == before)
                && *count > 0
            {
                kept.modules.push(index);
                kept.places.push(*place);
            }
            index += count;
        }
        kept
    }

    /// Returns the place at the module with this index, if it is known.
    pub(crate) fn get(&self, module: u32) -> Option<&ObjectPlace> {
        self.places.get(self.modules.binary_search(&module).ok()?)
    }
}
