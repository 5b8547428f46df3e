//! Object types and methods that the scripts of a run have declared.

use std::sync::Arc;

use super::session::Session;
use burgeon_base::locks::LockRecovery;
use burgeon_kit::{Argument, Call, Kind, Method, Registry};

/// Object types that scripts have declared, and methods that they have added to others.
#[derive(Default)]
pub(crate) struct DeclaredTypes {
    types: Vec<Arc<Kind>>,
    /// Added methods, each with its type and the package that adds it; an empty package is the script.
    methods: Vec<(String, String, Method)>,
}

impl DeclaredTypes {
    /// Returns the added methods with their types: each by its plain name, and methods of packages also by
    /// qualified name.
    fn added(&self) -> Vec<(&String, Method)> {
        let mut all: Vec<(&String, Method)> = Vec::new();
        for (of, owner, method) in &self.methods {
            let same = self.methods.iter().filter(|(kind, _, known)| kind == of && known.name == method.name);
            let owners: Vec<&String> = same.map(|(_, owner, _)| owner).collect();
            let plain = match owners.len() {
                1 => method.clone(),
                _ => contested_method(&method.name, owners.into_iter()),
            };
            let qualified = (!owner.is_empty())
                .then(|| Method { name: qualified_name(owner, &method.name).into(), ..method.clone() });
            for method in std::iter::once(plain).chain(qualified) {
                if !all.iter().any(|(kind, known)| *kind == of && known.name == method.name) {
                    all.push((of, method));
                }
            }
        }
        all
    }
}

impl Session {
    /// Records a type that a script declares. Every machine of a run calls this.
    pub(crate) fn note_type(&self, kind: &Arc<Kind>) {
        let mut declared = self.declared.lock().recover();
        if !declared.types.iter().any(|known| known.name == kind.name) {
            declared.types.push(Arc::clone(kind));
        }
    }

    /// Records a method that a script adds to the type `kind`.
    pub(crate) fn note_method(&self, kind: &str, owner: &str, method: Method) {
        let mut declared = self.declared.lock().recover();
        let is_same = |(of, by, known): &(String, String, Method)| {
            of == kind && by == owner && known.name == method.name
        };
        if !declared.methods.iter().any(is_same) {
            declared.methods.push((kind.to_owned(), owner.to_owned(), method));
        }
    }

    /// Returns the registry with the declared types and added methods.
    pub(crate) fn registry_with_types(&self) -> Registry {
        let own = self.types();
        let others = self.options.registry.kinds().filter(|kind| !own.iter().any(|it| it.name == kind.name));
        others.chain(&own).cloned().collect()
    }

    /// Returns the declared object types, in order, and the types with added methods.
    pub fn types(&self) -> Vec<Arc<Kind>> {
        let declared = self.declared.lock().recover();
        let mut types = declared.types.clone();
        for (of, method) in declared.added() {
            let known = types.iter_mut().find(|known| known.name == *of);
            match (known, self.options.registry.get(of)) {
                (Some(known), _) => Arc::make_mut(known).methods.push(method),
                (None, Some(kind)) => {
                    let mut kind = Kind::clone(kind);
                    kind.methods.push(method);
                    types.push(Arc::new(kind));
                }
                (None, None) => {}
            }
        }
        types
    }
}

/// Returns the qualified name of a method that the package `owner` has added as `name`.
pub(crate) fn qualified_name(owner: &str, name: &str) -> String {
    format!("{}_{name}", owner.replace('-', "_"))
}

/// Returns the documentation of a method that several packages have added.
pub(crate) fn contested_method<'a>(name: &str, owners: impl Iterator<Item = &'a String>) -> Method {
    let named = owners.filter(|owner| !owner.is_empty()).map(|owner| qualified_name(owner, name));
    let doc = format!("One of {}: the method of the required package.", named.collect::<Vec<_>>().join(", "));
    Method {
        name: name.to_owned().into(),
        doc: doc.into(),
        arguments: vec![Argument::new("...")],
        returns: "any".to_owned(),
        call: Call::Script { changes: false },
    }
}
