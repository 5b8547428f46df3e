//! Choice of a layer of a file by its name.

use burgeon_base::error::{Error, Result};
use burgeon_base::text::{listed, shown};

/// Returns the requested layer of the file `name`, or its only layer.
pub(crate) fn choose_layer(name: &str, layers: &[&str], wanted: Option<&str>) -> Result<String> {
    let list = listed(layers.iter().copied());
    match (wanted, layers) {
        (_, []) => Err(Error::data(format!("{name} has no layers of features"))
            .help("it contains no features table; was it written as a GeoPackage of features?")),
        (None, [only]) => Ok((*only).to_owned()),
        (None, _) => Err(Error::argument(format!("{name} has several layers"))
            .help(format!("specify one after a colon: \"{name}:{}\"; it has {list}", shown(layers[0])))),
        (Some(wanted), _) if layers.contains(&wanted) => Ok(wanted.to_owned()),
        (Some(wanted), _) => {
            let message = format!("{name}: no layer named `{}`", shown(wanted));
            Err(Error::not_found("layer", wanted, layers.iter().copied(), message)
                .help(format!("it has {list}")))
        }
    }
}
