//! `burgeon mods new`: creates a starter package.

use std::path::{Path, PathBuf};

use burgeon::packages::{MANIFEST, is_name};
use burgeon::script::api_version;
use burgeon::{Error, Result};

/// File that `require("@NAME")` runs.
const INIT: &str = "init.lua";

/// Creates the package `name` in the packages folder `into`, with a manifest and a script. Returns its folder. Fails if
/// the path exists already.
pub(super) fn create(into: &Path, name: &str) -> Result<PathBuf> {
    if !is_name(name) {
        return Err(Error::argument(format!("invalid package name {name:?}"))
            .help("use lowercase letters, digits, - and _, such as \"street-lamps\""));
    }
    let folder = into.join(name);
    let shown = folder.display();
    if folder.symlink_metadata().is_ok() {
        return Err(Error::file(&folder, format!("{shown} already exists")).help("choose another name"));
    }
    let version = api_version();
    let manifest = format!(
        "name = \"{name}\"\nversion = \"0.1.0\"\napi = \"{}.{}\" # the version of the script API that it needs\ndoc = \"\"\n",
        version.major, version.minor
    );
    let script = format!(
        "--!strict\n-- What require(\"@{name}\") gives. Other files come in with require(\"./file\").\nreturn {{}}\n"
    );
    let wrong = |error: std::io::Error| {
        Error::file(&folder, format!("cannot create {shown}: {error}")).help("choose another folder")
    };
    std::fs::create_dir_all(&folder).map_err(wrong)?;
    std::fs::write(folder.join(MANIFEST), manifest).map_err(wrong)?;
    std::fs::write(folder.join(INIT), script).map_err(wrong)?;
    Ok(folder)
}
