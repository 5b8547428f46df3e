//! Sources on database servers, with access checks.

use std::sync::Arc;

use super::data::LayerStore;
use super::session::Session;
use burgeon_base::error::{Error, Result};
use burgeon_data::{Layer, SourceOptions};

/// Reads the layer at an address. Fails if the script may not access its database.
#[cfg(feature = "postgis")]
pub(super) fn read(
    session: &Session,
    text: &str,
    mut wanted: SourceOptions,
    known: &mut LayerStore,
    table: Option<&str>,
) -> Result<Arc<Layer>> {
    use super::tables::{SourceTable, TableContent};
    use burgeon_query::postgis::ServerAddress;

    let (asked, layer) = ServerAddress::split(text)?;
    wanted.layer = wanted.layer.or(layer);
    let allowed = session.options.inputs.databases.iter().map(|address| ServerAddress::parse(address));
    let allowed = allowed.collect::<Result<Vec<ServerAddress>>>()?;
    let server = known.tables.server(asked.find_allowed(&allowed)?, session.options.limits.time);
    let features = server.read(&wanted)?;
    let shown = features.shown.clone();
    let layer = Layer::new(features, &mut known.frame).map_err(|error| error.about(&shown))?;
    if let (true, Some((_, error))) = (session.options.strict, layer.refused.first()) {
        return Err(error.clone());
    }
    let layer = Arc::new(layer);
    if let Some(table) = table.filter(|table| !table.eq_ignore_ascii_case(&layer.name)) {
        return Err(Error::argument(format!(
            "{shown} cannot be called {table}: the server calls it {}",
            layer.name
        ))
        .help("leave table out: on a server tables keep their names"));
    }
    let content = TableContent::Server(server);
    known.tables.add(SourceTable { name: layer.name.clone(), content });
    Ok(layer)
}

/// Returns the error for builds without database support.
#[cfg(not(feature = "postgis"))]
pub(super) fn read(
    _: &Session,
    _: &str,
    _: SourceOptions,
    _: &mut LayerStore,
    _: Option<&str>,
) -> Result<Arc<Layer>> {
    Err(Error::left_out("databases", "postgis"))
}
