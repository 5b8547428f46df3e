//! Tables of database servers, with access checks.

use std::sync::Arc;

use super::data_store::LoadedSources;
use burgeon_base::error::{Error, Result};
use burgeon_data::{Layer, SourceOptions};
use burgeon_kit::SourceRequest;

/// Reads the layer at an address. Fails if the script may not access its database.
#[cfg(feature = "postgis")]
pub(super) fn read(
    request: &SourceRequest<'_>,
    text: &str,
    mut wanted: SourceOptions,
    known: &mut LoadedSources,
    table: Option<&str>,
) -> Result<Arc<Layer>> {
    use super::tables::{SourceTable, TableContent};
    use crate::sql::postgis::ServerAddress;

    let (address, layer) = ServerAddress::split(text)?;
    wanted.layer = wanted.layer.or(layer);
    let allowed = request.databases.iter().map(|address| ServerAddress::parse(address));
    let allowed = allowed.collect::<Result<Vec<ServerAddress>>>()?;
    let server = known.tables.server(address.find_allowed(&allowed)?, request.time);
    let features = server.read(&wanted)?;
    let label = features.shown.clone();
    let layer = Layer::new(features, &mut known.frame).map_err(|error| error.about(&label))?;
    if let (true, Some((_, error))) = (request.is_strict, layer.refused.first()) {
        return Err(error.clone());
    }
    let layer = Arc::new(layer);
    if let Some(table) = table.filter(|table| !table.eq_ignore_ascii_case(&layer.name)) {
        return Err(Error::argument(format!(
            "{label} cannot be called {table}: the server calls it {}",
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
    _: &SourceRequest<'_>,
    _: &str,
    _: SourceOptions,
    _: &mut LoadedSources,
    _: Option<&str>,
) -> Result<Arc<Layer>> {
    Err(Error::left_out("databases", "postgis"))
}
