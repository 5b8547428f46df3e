//! Packages: folders with a `mod.toml` that share scripts, models and textures with other scripts.
//!
//! ```toml
//! name = "castle"
//! version = "1.2.0"
//! api = "1.0"                  # required version of the script API
//!
//! [depends]
//! masonry = "1.1"              # required, and loaded before this package
//! [optional]
//! banners = "1"                # used if available
//! [conflicts]
//! ruins = "*"                  # cannot be used together with this package
//! [replaces]
//! "@masonry/stone.png" = "grey.png"
//! [params.masonry]
//! course = 0.4                 # another default of a parameter
//! ```
//!
//! Input: folders to search for packages ([`PackageSearch`]), and names of their files, such as `@castle/towers.lua`.
//! Output: [`Packages`] in an order that depends only on their dependencies and names, the file that a name refers to
//! ([`Packages::locate`]), and an installed folder ([`install()`]). The crate never runs a script, and never resolves a
//! name to a file outside the folder of a package.
//!
//! A package that is invalid, or conflicts with another one, only affects scripts that use it.

mod check;
mod copy;
mod find;
mod install;
mod locate;
mod lock;
mod manifest;
mod names;
mod order;
mod package;
mod switches;
#[cfg_attr(not(feature = "zip"), path = "absent.rs")]
mod unzip;

#[cfg(test)]
mod generated;
#[cfg(test)]
mod hostile;
#[cfg(test)]
mod tests;

pub use copy::{LARGEST, MOST};
pub use find::PackageSearch;
pub use install::{Installation, install};
pub use locate::PackageFile;
pub use lock::{LockedPackage, hash_file};
pub use manifest::{Dependency, MANIFEST, Manifest, ParamDefault, Replacement};
pub use names::{FileName, is_name};
pub use package::{BrokenPackage, DisabledPackage, HiddenPackage, Package, PackageOrigin, Packages};
pub use semver::{Version, VersionReq};
pub use switches::{SWITCHES, switch};
