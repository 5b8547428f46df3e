//! What a run's scripts have declared of types of objects, for those who want to know afterwards.

use std::sync::Arc;

use super::session::Session;
use burgeon_base::locks::LockRecovery;
use burgeon_kit::{Kind, Method, Registry};

/// Types of objects that scripts have declared, and methods that they have added to others.
#[derive(Default)]
pub(crate) struct DeclaredTypes {
    types: Vec<Arc<Kind>>,
    /// By the name of the type.
    methods: Vec<(String, Method)>,
}

impl Session {
    /// Takes notice of a type that a script declares; each machine of a run tells of it.
    pub(crate) fn note_type(&self, kind: &Arc<Kind>) {
        let mut declared = self.declared.lock().recover();
        if !declared.types.iter().any(|known| known.name == kind.name) {
            declared.types.push(Arc::clone(kind));
        }
    }

    /// Takes notice of a method that a script adds to the type called `kind`.
    pub(crate) fn note_method(&self, kind: &str, method: Method) {
        let mut declared = self.declared.lock().recover();
        if !declared.methods.iter().any(|(of, known)| of == kind && known.name == method.name) {
            declared.methods.push((kind.to_owned(), method));
        }
    }

    /// The registry with what the scripts have declared besides, or have added to what is there.
    pub(crate) fn registry_with_types(&self) -> Registry {
        let own = self.types();
        let others = self.options.registry.kinds().filter(|kind| !own.iter().any(|it| it.name == kind.name));
        others.cloned().chain(own.iter().cloned()).collect()
    }

    /// The types of objects that the scripts have declared, in order, and those that they have added methods to.
    pub fn types(&self) -> Vec<Arc<Kind>> {
        let declared = self.declared.lock().recover();
        let mut types = declared.types.clone();
        for (of, method) in &declared.methods {
            let known = types.iter_mut().find(|known| known.name == *of);
            match (known, self.options.registry.get(of)) {
                (Some(known), _) => Arc::make_mut(known).methods.push(method.clone()),
                (None, Some(kind)) => {
                    let mut kind = Kind::clone(kind);
                    kind.methods.push(method.clone());
                    types.push(Arc::new(kind));
                }
                (None, None) => {}
            }
        }
        types
    }
}
