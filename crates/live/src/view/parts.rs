//! Parts of the model for pages: systems, chains with their features, and the modules of a symbol.

use super::layout::Indices;
use super::message::{Event, PartMessage, Range};
use super::state::{PresentModel, ServerState};
use super::trace;
use burgeon_base::error::{Error, Result};
use burgeon_base::locks::LockRecovery;
use burgeon_engine::results::DerivedSystem;
use burgeon_engine::trace as engine;
use burgeon_scene::Origin;

/// Maximum number of chains that pages receive.
const MOST: usize = 200;

/// Lists the chains whose feature, or whose number, contains all words of `search`.
pub(super) fn list(state: &ServerState, id: u64, search: &str) -> Event {
    let Some(shown) = state.shown() else {
        return Event::rejection(Some(id), &Error::unavailable("no model yet"));
    };
    let words: Vec<String> = search.split_whitespace().map(str::to_lowercase).collect();
    let mut parts = Vec::new();
    let mut matching = 0;
    for system in shown.run.systems.iter().filter(|system| system.features.len() > 1) {
        for (chain, feature) in system.features.iter().enumerate() {
            let name = feature.clone().unwrap_or_else(|| format!("chain {}", chain + 1)).to_lowercase();
            if !words.iter().all(|word| name.contains(word.as_str())) {
                continue;
            }
            matching += 1;
            if parts.len() < MOST {
                parts.push(PartMessage { system: system.system, chain, feature: feature.clone() });
            }
        }
    }
    Event::Parts { id, parts, matching }
}

/// Finds the triangles of a system, of one of its chains, or of the modules of a symbol.
pub(super) fn find(
    state: &ServerState,
    id: u64,
    system: usize,
    chain: Option<usize>,
    symbol: Option<&str>,
) -> Event {
    let found = match (chain, symbol) {
        (_, None) => of_system(state, system, chain).map(|ranges| (0, ranges)),
        (None, Some(symbol)) => of_symbol(state, system, symbol),
        (Some(_), Some(_)) => Err(Error::argument("a part has a chain or a symbol, not both")),
    };
    match found {
        Ok((modules, ranges)) => Event::Part { id, modules, ranges },
        Err(error) => Event::rejection(Some(id), &error),
    }
}

fn of_system(state: &ServerState, system: usize, chain: Option<usize>) -> Result<Vec<Range>> {
    let Some(shown) = state.shown() else { return Err(Error::unavailable("no model yet")) };
    let derived = system_of(&shown, system)?;
    if let Some(chain) = chain.filter(|chain| *chain >= derived.features.len()) {
        return Err(Error::unavailable(format!("unknown chain {chain} of system {system}")));
    }
    let scene = &shown.run.scene;
    let is_part = |origin: Option<Origin>| {
        origin
            .is_some_and(|origin| origin.system == system && chain.is_none_or(|chain| origin.chain == chain))
    };
    let instances = scene
        .instances
        .iter()
        .enumerate()
        .filter(|(_, instance)| is_part(instance.origin) || is_part(scene.meshes[instance.mesh].origin));
    let instances: Vec<usize> = instances.map(|(index, _)| index).collect();
    Ok(Indices { scene, layout: &shown.layout }.instance_ranges(&instances))
}

fn of_symbol(state: &ServerState, system: usize, symbol: &str) -> Result<(usize, Vec<Range>)> {
    let (shown, options) = trace::present(state)?;
    let derived = system_of(&shown, system)?;
    let names = trace::symbols(derived);
    if !names.iter().any(|known| known.name == symbol) {
        let message = format!("no module of system {} is a {symbol}", system + 1);
        return Err(Error::not_found("symbol", symbol, names.iter().map(|it| it.name.as_str()), message));
    }
    let scene = &shown.run.scene;
    let _turn = state.tracing.lock().recover();
    let found = engine::highlight_symbol(&state.script, &options, scene, system, symbol)?;
    let mut indices = Indices { scene, layout: &shown.layout };
    let mut ranges = indices.ranges(&found.runs);
    ranges.extend(indices.instance_ranges(&found.instances));
    Ok((found.modules, ranges))
}

fn system_of(shown: &PresentModel, system: usize) -> Result<&DerivedSystem> {
    let found = shown.run.systems.iter().find(|derived| derived.system == system);
    found.map(AsRef::as_ref).ok_or_else(|| Error::unavailable(format!("unknown system {system}")))
}
