//! Modules that one call rewrites although they depend on one another, in columns.

use crate::dependents::DependentModules;
use crate::new_chain::NewPlace;
use crate::successors::Successors;

/// Neighbour of a module in the new chain.
#[derive(Debug, Clone, Copy)]
pub(crate) enum Neighbour {
    None,
    /// Final module.
    Final(NewPlace),
    /// Result of the module with this index in the same call.
    Pending(u32),
}

/// Modules of a call, in columns that are used again for the next call.
#[derive(Debug, Default)]
pub(crate) struct DependentBatch {
    /// Indices of the modules among the active ones.
    pub members: Vec<u32>,
    pub sources: Vec<Neighbour>,
    pub modules: Vec<[u32; 3]>,
    pub trials: Vec<[u32; 2]>,
    pub arguments: Vec<f64>,
    pub neighbours: Vec<[u32; 2]>,
    pub values: Vec<f64>,
    /// Last final module that has been added to `neighbours`, with its index.
    pub last: Option<(NewPlace, u32)>,
    pub successors: Successors,
    pub chosen: Vec<u32>,
    /// Number of applications of each rule in all calls for a piece.
    pub applied: Vec<usize>,
}

impl DependentBatch {
    /// Removes the modules but keeps the memory.
    pub(crate) fn clear(&mut self) {
        self.members.clear();
        self.sources.clear();
        self.modules.clear();
        self.trials.clear();
        self.arguments.clear();
        self.neighbours.clear();
        self.neighbours.push(DependentModules::NO_NEIGHBOUR);
        self.values.clear();
        self.last = None;
    }

    /// Returns the final neighbour that `from` has become after the call.
    pub(crate) fn settle(&mut self, from: Neighbour, nearest: impl Fn(u32) -> Option<NewPlace>) -> Neighbour {
        let mut here = from;
        let found = loop {
            let Neighbour::Pending(index) = here else { break here };
            if let Some(place) = nearest(self.members[index as usize]) {
                break Neighbour::Final(place);
            }
            here = self.sources[index as usize];
        };
        let mut passed = from;
        while let Neighbour::Pending(index) = passed
            && nearest(self.members[index as usize]).is_none()
        {
            passed = std::mem::replace(&mut self.sources[index as usize], found);
        }
        found
    }
}
