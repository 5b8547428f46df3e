//! Complete derivation in the leading machine: plan, phases and result.

use std::sync::Arc;

use super::phases::{DerivationResults, derive};
use super::plan::{Derivation, DerivationPlan};
use super::threads::{LeadingMachine, ThreadPool};
use crate::machine::{Axiom, DerivationRequest, Machine, Objects};
use crate::results::{DerivedSystem, RowFeatures, RuleName, SystemUses, Trace, skipped_feature};
use burgeon_base::error::{Error, Result};
use burgeon_base::locks::LockRecovery;
use burgeon_base::warning::Warning;
use burgeon_kit::{Drawing, Object};

/// Result of a derivation.
pub(super) enum Ending {
    /// Derived system, as requested by the script.
    Derived(Box<DerivedSystem>),
    /// Lineage requested by the options of the run.
    Traced(Box<Trace>),
}

/// Derives system `index` of the machine's script.
pub(super) fn lead(
    machine: &Machine,
    threads: &ThreadPool,
    index: usize,
    request: DerivationRequest<'_>,
) -> Result<Ending> {
    let mut derivation = Derivation::plan(machine, index, request)?;
    machine.load_variables(derivation.plan.variables().as_deref())?;
    let chain = std::mem::take(&mut derivation.axiom.chain);
    let grown = derive(LeadingMachine { machine, threads }, &derivation, chain)?;
    settle(machine, derivation, grown)
}

/// Builds the result of a derivation: reports warnings, and takes the objects out of the plan.
fn settle(machine: &Machine, derivation: Derivation, grown: DerivationResults) -> Result<Ending> {
    let session = &machine.session;
    let Derivation { mut axiom, plan, declared, traced, place, caller, axiom_place, draws, .. } = derivation;
    for warning in grown.warnings {
        session.warn(warning.at_place(place.as_ref()).called_from(caller.as_ref()));
    }
    let symbols = grown.chain.symbols.iter().copied();
    let systems = machine.library.systems.borrow();
    let undrawn = systems[plan.system].undrawn(&machine.library, symbols, &grown.undrawn);
    drop(systems);
    let (city, has_own_seed) = {
        let system = &machine.library.systems.borrow()[plan.system];
        (system.city, system.seed.is_some())
    };
    drop(declared);
    machine.current.objects.replace(None);
    session.keep(&grown.chain.params);
    let plan = Arc::try_unwrap(plan).map_err(|_| Error::internal("a worker still holds the plan"))?;
    let DerivationPlan { system, steps, interpretations, objects, variables, reports, .. } = plan;
    let grammar = &steps.grammar;
    let objects = objects.map(Arc::try_unwrap).transpose();
    let objects = objects.map_err(|_| Error::internal("a worker still holds the objects"))?;
    if traced.is_some()
        && let Some(objects) = objects
    {
        let rules = grammar.rules().iter();
        let rules = rules.map(|rule| RuleName::new(&rule.pattern.text, rule.place.as_ref()));
        let interpreters = interpretations.list.iter();
        let interpreters = interpreters.map(|known| RuleName::new(&known.name, known.place.as_ref()));
        let shared = (grammar.symbols(), &session.values);
        let regions = grammar.region_openers().regions(&grown.chain).into_iter().chain(std::iter::repeat(0));
        let places = grown.chain.symbols.iter().zip(regions);
        let places = places.map(|(symbol, region)| interpretations.place_of(region, *symbol));
        let interpreted = places.map(|place| interpretations.by_symbol[place]).collect();
        let mut trace = Trace::new(shared, rules.collect(), interpreters.collect(), interpreted, axiom_place);
        let drawn = objects.into_owned().into_iter();
        trace.makers = drawn.map(|(mut object, _)| object.drawing_mut()?.take_makers()).collect();
        (trace.steps, trace.chain) = (grown.steps, Arc::unwrap_or_clone(grown.chain));
        return Ok(Ending::Traced(Box::new(trace)));
    }
    let mut rows = grown.features.filter(|features| !features.is_empty());
    let left_out = objects.as_ref().map(|objects| objects.failed().list()).unwrap_or_default();
    let objects = match objects {
        Some(objects) => {
            let mut warnings = Vec::new();
            let objects = shared(objects, &axiom, rows.as_mut(), &mut warnings)?;
            // Features skipped earlier come first; the chains follow in their order.
            axiom.feature_warnings.append(&mut warnings);
            objects
        }
        None => Vec::new(),
    };
    let mut sums = reports.into_inner().recover();
    sums.skip_chains(&left_out);
    let reported = sums.table().map_err(|error| error.at_place(place.as_ref()))?;
    let neighbors = axiom.neighbors;
    let mut derived = Box::new(DerivedSystem {
        system,
        modules: grown.chain.modules(),
        chain: grown.chain,
        left_out: left_out.into(),
        context: None,
        symbols: Arc::clone(grammar.symbols()),
        values: Arc::clone(&session.values),
        objects,
        features: axiom.features,
        steps: grown.steps_made,
        time: grown.time,
        times: grown.times,
        rules: grown.rules,
        place,
        caller,
        given: axiom.given,
        feature_warnings: axiom.feature_warnings,
        city,
        source: axiom.known,
        rows,
        draws,
        undrawn,
        has_own_seed,
        has_cut: grown.has_cut,
        variables: variables.into_inner().recover().map(Arc::unwrap_or_clone),
        reported,
        uses: SystemUses::default(),
    });
    derived.drop_chains(&neighbors);
    Ok(Ending::Derived(derived))
}

/// Returns the objects after the last pass, and adds the warnings about skipped and simplified features to `warnings`.
/// Fails if all objects have failed.
fn shared(
    objects: Objects,
    axiom: &Axiom,
    rows: Option<&mut RowFeatures>,
    warnings: &mut Vec<Warning>,
) -> Result<Vec<Arc<dyn Object>>> {
    let mut makers = Vec::new();
    let mut settled: Vec<Arc<dyn Object>> = Vec::new();
    let (mut failed, mut first) = (0, None);
    for (index, (mut object, failure)) in objects.into_owned().into_iter().enumerate() {
        let feature = axiom.features.get(index).and_then(Option::as_deref);
        if let Some(error) = failure {
            object.begin();
            warnings.push(skipped_feature(&axiom.source, feature, &error));
            failed += 1;
            first.get_or_insert(error);
        } else {
            let notes = object.notes().iter().cloned();
            warnings.extend(notes.map(|note| note.of_feature(&axiom.source, feature)));
        }
        if rows.is_some() {
            makers.push(object.drawing_mut().and_then(Drawing::take_makers));
        }
        settled.push(Arc::from(object));
    }
    if let Some(rows) = rows {
        rows.set_makers(makers);
    }
    match first {
        Some(error) if failed == settled.len() => Err(error),
        _ => Ok(settled),
    }
}
