//! Packages: folders with a `mod.toml` that share scripts, models and textures with other scripts.
//!
//! ```toml
//! name = "castle"
//! version = "1.2.0"
//! api = "1.0"                  # the version of the script API that it needs
//!
//! [depends]
//! masonry = "1.1"              # what must be there, and is loaded before it
//! [optional]
//! banners = "1"                # what it uses where it is there
//! [conflicts]
//! ruins = "*"                  # what it cannot be used with
//! [replaces]
//! "@masonry/stone.png" = "grey.png"
//! [params.masonry]
//! course = 0.4                 # another default of a parameter
//! ```
//!
//! Comes in: folders in which packages may be ([`PackageSearch`]), and names of their files, such as `@castle/towers.lua`. Goes
//! out: [`Packages`] in an order that depends on nothing but what they say of each other, the file that a name means
//! ([`Packages::locate`]), and an installed folder ([`install()`]). It never runs a script, and it never leads to a file
//! outside the folder of a package.
//!
//! A package that is broken, or that cannot be used with another one, stops nobody who does not use it.

mod check;
mod find;
mod install;
mod locate;
mod lock;
mod manifest;
mod order;
mod switches;
#[cfg_attr(not(feature = "zip"), path = "absent.rs")]
mod unzip;

#[cfg(test)]
mod generated;
#[cfg(test)]
mod hostile;
#[cfg(test)]
mod tests;

pub use find::{
    BrokenPackage, DisabledPackage, HiddenPackage, Package, PackageOrigin, PackageSearch, Packages,
};
pub use install::{Installation, LARGEST, MOST, install};
pub use locate::{FileName, PackageFile};
pub use lock::LockedPackage;
pub use manifest::{Dependency, MANIFEST, Manifest, ParamDefault, Replacement, is_name};
pub use semver::{Version, VersionReq};
pub use switches::{SWITCHES, switch};
