//! Initial chains of a system.

use std::sync::Arc;

use mlua::{AnyUserData, Function, MultiValue, Table, Value as LuaValue};

use crate::machine::Machine;
use crate::machine::convert::to_value;
use crate::machine::types::ObjectHandle;
use crate::results::VariableValues;
use crate::results::{DerivedSystem, SourceFeatures, skipped_feature, unread_feature};
use burgeon_base::error::{Error, Result};
use burgeon_base::warning::Warning;
use burgeon_kit::{Object, Prefetch, Value};
use burgeon_rewriting::{Chain, END, ModuleKey, Ordinals};

use super::chain_builder::ChainBuilder;
use super::lazy::is_feature;
use super::selection::{FeatureRole, PartSelection};
use super::source::{each_feature, layer_of, refused_of, shown};
use super::{DeclaredAxiom, SystemDeclaration};

/// Initial chains of a system, with the data of each chain.
#[derive(Default)]
pub(crate) struct Axiom {
    pub chain: Chain,
    /// Object of each chain; empty if the system has no object.
    pub objects: Vec<Box<dyn Object>>,
    /// Feature id of each chain.
    pub features: Vec<Option<String>>,
    /// Attributes of the features.
    pub known: SourceFeatures,
    /// Name of the features' source; empty without features, and for a list of the script.
    pub source: String,
    /// Number of input features, including skipped features.
    pub given: usize,
    /// Skipped features.
    pub feature_warnings: Vec<Warning>,
    /// Indices of the chains that are only built for others near them, ascending.
    pub neighbors: Vec<usize>,
    /// Variables of the derivation that is continued.
    pub variables: Option<VariableValues>,
}

impl Axiom {
    /// Returns only chain `index`.
    pub(crate) fn only(mut self, index: usize, arities: &[u8]) -> Self {
        Self {
            chain: self.chain.single_chain(index, arities),
            objects: self.objects.drain(..).skip(index).take(1).collect(),
            features: self.features.drain(..).skip(index).take(1).collect(),
            known: std::mem::take(&mut self.known).only(index),
            ..self
        }
    }
}

impl SystemDeclaration {
    /// Repeats the side effects of the axiom in a helper machine: runs the function that makes each feature's
    /// chain.
    ///
    /// Skips a function whose only side effect is random numbers; [`SystemDeclaration::catch_up`] then
    /// corrects the random stream.
    pub(crate) fn replay_axiom(&self, machine: &Machine) -> Result<()> {
        match &self.axiom {
            Some(DeclaredAxiom::Source(_, function)) if is_pure(machine, function) => Ok(()),
            Some(DeclaredAxiom::Source(..)) => self.axiom(machine, ModuleKey::default(), false).map(|_| ()),
            _ => Ok(()),
        }
    }

    /// Returns true if the function of the axiom may change variables of the script.
    pub(super) fn changes_variables(&self, machine: &Machine) -> bool {
        matches!(&self.axiom, Some(DeclaredAxiom::Source(_, function)) if !is_pure(machine, function))
    }

    /// Sets the random stream of a helper machine to the position of the leader, after a derivation.
    pub(crate) fn catch_up(&self, machine: &Machine) {
        if let Some(DeclaredAxiom::Source(..)) = self.axiom
            && let Some(stream) = machine.session.drawn.after(machine.driver.count())
        {
            machine.current.top.replace(stream);
        }
    }

    /// Makes the initial chains: one from modules, or one per feature. Errors have the location where the
    /// axiom was set.
    pub(crate) fn axiom(&self, machine: &Machine, key: ModuleKey, random: bool) -> Result<Axiom> {
        self.first_chains(machine, key, random).map_err(|error| error.at_place(self.axiom_place.as_ref()))
    }

    fn first_chains(&self, machine: &Machine, key: ModuleKey, random: bool) -> Result<Axiom> {
        let mut axiom = Axiom::default();
        let mut builder = ChainBuilder { machine, chain: &mut axiom.chain, random, kept: None };
        match &self.axiom {
            None if self.object.as_ref().is_some_and(|object| object.expands()) => {
                builder.push(END, &[], key);
                axiom.objects.extend(self.object.as_ref().map(|object| prepared(machine, &**object, key)));
                axiom.features.push(None);
            }
            None => return Err(Error::script("the system has no axiom").help("write system:axiom(A(1))")),
            Some(DeclaredAxiom::Modules(modules)) => {
                builder.list(modules, key)?;
                builder.push(END, &[], key);
                axiom.objects.extend(self.object.as_ref().map(|object| prepared(machine, &**object, key)));
                axiom.features.push(None);
            }
            Some(DeclaredAxiom::Derived(derived)) => {
                self.continue_chains(machine, derived, key, random, &mut axiom)
            }
            Some(DeclaredAxiom::Source(source, function)) => {
                let made = self.features(machine, source, function, key, random, &mut axiom);
                // The script can continue after a failure, so the position is recorded first.
                machine.session.drawn.note(machine.driver.count(), &machine.current.top.borrow());
                made?;
            }
        }
        if let Some(gather) = axiom.objects.first().and_then(|object| object.kind().gather) {
            gather(&mut axiom.objects);
        }
        Ok(axiom)
    }

    /// Gives the ends of the chains new keys if they continue those of a derived system, so that their events are not drawn with
    /// the same random numbers again.
    pub(crate) fn advance_continued(&self, chain: &mut Chain) {
        if let Some(DeclaredAxiom::Derived(_)) = self.axiom {
            let ends = chain.keys.iter_mut().zip(&chain.symbols).filter(|(_, symbol)| **symbol == END);
            ends.for_each(|(key, _)| *key = key.advance());
        }
    }

    /// Makes the initial chains of the chains of a derived system, with their features and copies of their objects.
    fn continue_chains(
        &self,
        machine: &Machine,
        derived: &DerivedSystem,
        key: ModuleKey,
        random: bool,
        axiom: &mut Axiom,
    ) {
        derived.note_continued();
        axiom.variables.clone_from(&derived.variables);
        let arities = machine.library.symbols.borrow().arities();
        axiom.chain = derived.chain.without_chains(&derived.left_out, &arities);
        let stays = |index: &usize| derived.left_out.binary_search(index).is_err();
        let is_alike = |known: &&Arc<dyn Object>| {
            self.object.as_ref().is_some_and(|object| object.kind().name == known.kind().name)
        };
        let mut keys = Vec::new();
        for index in (0..derived.features.len()).filter(stays) {
            let feature = derived.features[index].clone();
            let key = feature.as_deref().map_or(key, |id| key.feature(id));
            let known = derived.objects.get(index).filter(is_alike);
            axiom
                .objects
                .extend(known.or(self.object.as_ref()).map(|object| prepared(machine, &**object, key)));
            axiom.features.push(feature);
            keys.push(key);
        }
        axiom.known = derived.source.clone();
        axiom.known.drop_chains(&derived.left_out);
        axiom.given = axiom.features.len();
        if !random {
            axiom.chain.keys.clear();
        } else if axiom.chain.keys.is_empty() {
            // No rule has used random numbers so far, so the modules are numbered in the order of each chain.
            let (symbols, mut ordinals) = (machine.library.symbols.borrow(), Ordinals::default());
            let mut keys = keys.into_iter();
            let mut key = keys.next().unwrap_or(key);
            for symbol in &axiom.chain.symbols {
                axiom.chain.keys.push(match *symbol > END {
                    true => key.successor(symbols.name_hash(*symbol), ordinals.next(*symbol)),
                    false => key,
                });
                if *symbol == END {
                    ordinals.clear();
                    key = keys.next().unwrap_or(key);
                }
            }
        }
    }

    fn features(
        &self,
        machine: &Machine,
        source: &LuaValue,
        function: &Function,
        key: ModuleKey,
        random: bool,
        axiom: &mut Axiom,
    ) -> Result<()> {
        let LuaValue::UserData(source) = source else { return Ok(()) };
        let prefetch = self.prefetch(machine, source)?;
        let mut refused: Option<Error> = None;
        let selection = PartSelection::new(machine, source)?;
        // Without random numbers and side effects, the function need not run for features that are not built.
        let may_skip = !selection.is_whole() && !machine.session.draws_random() && is_pure(machine, function);
        axiom.source = shown(source);
        machine.session.note_feature_source(layer_of(source).as_ref().map(|layer| layer.label()));
        let (layer, records) = (layer_of(source), machine.session.options.reports.records);
        let is_first = machine.session.options.part.is_none_or(|part| part.has_featureless());
        for (id, error) in refused_of(source).into_iter().filter(|_| is_first) {
            axiom.given += 1;
            axiom.feature_warnings.push(unread_feature(&axiom.source, &id, &error));
        }
        let each = |index: usize, feature: LuaValue, id: Option<&str>| {
            let from_file = id.is_some();
            let id = match (id, &feature) {
                (Some(id), _) => id.to_owned(),
                (None, LuaValue::Table(feature)) => match own_id(feature) {
                    Ok(
                        id @ (LuaValue::String(_)
                        | LuaValue::Number(_)
                        | LuaValue::Integer(_)
                        | LuaValue::Boolean(_)),
                    ) => id.to_string().unwrap_or_default(),
                    // Other values have no text that is equal in every run.
                    _ => index.to_string(),
                },
                (None, _) => index.to_string(),
            };
            let key = key.feature(&id);
            let role = selection.role(index - 1);
            if role == FeatureRole::Absent && may_skip {
                return Ok(());
            }
            axiom.given += usize::from(role == FeatureRole::Shown);
            let value = (!from_file && records).then(|| to_value(&feature, true).unwrap_or(Value::Nil));
            let made: MultiValue = match machine.call(function, feature) {
                Ok(made) => made,
                Err(error) => {
                    let error = machine.translate(error);
                    let named = |error: Error| if from_file { error.feature(&id) } else { error };
                    if !error.is_of_data() || machine.session.options.strict {
                        return Err(named(error));
                    }
                    if role == FeatureRole::Shown {
                        axiom.feature_warnings.push(skipped_feature(&axiom.source, Some(&id), &error));
                        refused.get_or_insert_with(|| named(error));
                    }
                    return Ok(());
                }
            };
            match role {
                FeatureRole::Shown => {}
                FeatureRole::Neighbor => axiom.neighbors.push(axiom.features.len()),
                FeatureRole::Absent => return Ok(()),
            }
            let mut made: Vec<LuaValue> = made.into_iter().collect();
            let own = made.first().and_then(ObjectHandle::object_of);
            if own.is_some() {
                made.remove(0);
            }
            let object = own.as_ref().or(self.object.as_ref());
            if let (Some(object), Some(expected)) = (object, &self.object)
                && object.kind().name != expected.kind().name
            {
                return Err(Error::argument(format!(
                    "feature {id} has a {}, but the system's object is a {}",
                    object.kind().name,
                    expected.kind().name
                )));
            }
            axiom.objects.extend(object.map(|object| prepared(machine, &**object, key)));
            axiom.features.push(Some(id));
            axiom.known.push(layer.as_ref(), index - 1, value);
            let mut builder = ChainBuilder { machine, chain: &mut axiom.chain, random, kept: None };
            builder.list(&made, key)?;
            builder.push(END, &[], key);
            Ok(())
        };
        let prefetch = prefetch.as_ref().map(|prefetch| &prefetch.0);
        each_feature(machine.lua(), source, prefetch, each, |error| machine.translate(error))?;
        // If no feature remains, the error is more helpful than an empty model.
        match refused {
            Some(error) if axiom.features.is_empty() && selection.is_whole() => Err(error),
            _ => Ok(()),
        }
    }
}

impl SystemDeclaration {
    /// Lets a helper thread, if there is one, prepare data that the system's objects need for many features.
    fn prefetch(&self, machine: &Machine, source: &AnyUserData) -> Result<Option<PrefetchGuard>> {
        let begin = self.object.as_ref().and_then(|object| object.kind().prefetch);
        let begin = begin.filter(|_| !machine.session.options.check);
        let layer = layer_of(source).filter(|layer| layer.count() >= MANY);
        let (Some(begin), Some(layer)) = (begin, layer) else { return Ok(None) };
        let features = layer.object();
        let Some(prefetch) = begin(&features) else { return Ok(None) };
        let prefetching = PrefetchGuard(prefetch);
        machine.driver.prefetch(machine, &prefetching.0)?;
        Ok(Some(prefetching))
    }
}

/// Returns true if a function of the script has no side effect except random numbers.
fn is_pure(machine: &Machine, function: &Function) -> bool {
    let info = function.info();
    let file = info.source.as_deref().and_then(|source| source.strip_prefix('@'));
    file.zip(info.line_defined).is_some_and(|(file, line)| machine.session.is_pure(file, line))
}

/// Number of features from which helpers start early, because the interpretation needs them anyway.
const MANY: usize = 256;

/// Prefetch that ends when this is dropped.
struct PrefetchGuard(Arc<dyn Prefetch>);

impl Drop for PrefetchGuard {
    fn drop(&mut self) {
        self.0.end();
    }
}

/// Returns the id of a feature in a list of the script.
fn own_id(feature: &Table) -> mlua::Result<LuaValue> {
    match feature.metatable() {
        // A feature of a file may not be a complete table yet, so the metatable finds the id.
        Some(metatable) if is_feature(&metatable) => feature.get("id"),
        _ => feature.raw_get("id"),
    }
}

/// Returns a copy of `object` for the chain with this random key.
fn prepared(machine: &Machine, object: &dyn Object, key: ModuleKey) -> Box<dyn Object> {
    let mut object = object.boxed();
    object.seed(key.0);
    object.set_detail(machine.session.options.lod);
    object
}
