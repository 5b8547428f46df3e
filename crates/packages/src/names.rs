//! Names of packages and of their files, such as `@castle/towers.lua`.

use std::fmt;

use burgeon_base::error::{Error, Result};
use burgeon_base::names::{has_bidi_controls, normal_form};

/// Maximum number of characters of a package's name.
pub(super) const LONGEST: usize = 40;

/// Returns true if `name` is a valid package name: a lower-case letter, followed by lower-case letters, digits, `_` and
/// `-`.
///
/// ```
/// use burgeon_packages::is_name;
///
/// assert!(is_name("old-castle_2") && !is_name("Castle") && !is_name("2castles"));
/// ```
pub fn is_name(name: &str) -> bool {
    let mut letters = name.chars();
    letters.next().is_some_and(|first| first.is_ascii_lowercase())
        && letters
            .all(|letter| letter.is_ascii_lowercase() || letter.is_ascii_digit() || "_-".contains(letter))
        && name.len() <= LONGEST
}

/// Name of a package's file.
#[derive(Debug, Clone, PartialEq, Eq, PartialOrd, Ord)]
pub struct FileName {
    /// Name of the package.
    pub package: String,
    /// Path of the file relative to the package's folder, separated by `/`; empty for the package itself.
    pub path: String,
}

impl fmt::Display for FileName {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let separator = if self.path.is_empty() { "" } else { "/" };
        write!(f, "@{}{separator}{}", self.package, self.path)
    }
}

impl FileName {
    /// Returns true if a name in a script refers to a package's file.
    pub fn is_meant(name: &str) -> bool {
        name.starts_with('@')
    }

    /// Creates the name of the file at `path` in the folder of `package`.
    pub fn new(package: &str, path: impl Into<String>) -> Self {
        Self { package: package.to_owned(), path: path.into() }
    }

    /// Parses `@castle/towers.lua`. Fails if the path leaves the package, and for an invalid package name.
    pub fn parse(name: &str) -> Result<Self> {
        let inner = name.strip_prefix('@').unwrap_or(name);
        let (package, path) = inner.split_once('/').unwrap_or((inner, ""));
        if !name.starts_with('@') || !is_name(package) {
            return Err(Error::file(name, format!("{name:?} is not a file of a package"))
                .help("write \"@castle/stone.png\" for stone.png of the package castle"));
        }
        let leads_out = |part: &str| part == ".." || part.contains(['\\', ':', '\0']);
        if path.starts_with('/') || path.split('/').any(leads_out) {
            return Err(Error::file(name, format!("{name} is outside the package {package}"))
                .help(format!("use a file in its folder or its subfolders: \"@{package}/stone.png\"")));
        }
        if has_bidi_controls(path) {
            return Err(Error::file(
                name,
                format!("{} has a character that reverses text", name.escape_unicode()),
            )
            .help("rename the file: such names are shown in another order than stored"));
        }
        let parts: Vec<&str> = path.split('/').filter(|part| !part.is_empty() && *part != ".").collect();
        Ok(Self::new(package, normal_form(&parts.join("/"))))
    }

    /// Parses `@castle/towers`, without an extension, as the name of a script: `towers.lua` of that package, or
    /// `init.lua` if the name is only the package.
    ///
    /// ```
    /// use burgeon_packages::FileName;
    ///
    /// assert_eq!(FileName::script("@castle/towers")?.to_string(), "@castle/towers.lua");
    /// assert_eq!(FileName::script("@castle")?.path, "init.lua");
    /// assert!(FileName::script("@castle/../secret").is_err());
    /// # Ok::<(), burgeon_base::Error>(())
    /// ```
    pub fn script(name: &str) -> Result<Self> {
        let Self { package, path } = Self::parse(name)?;
        let path = if path.is_empty() { "init.lua".to_owned() } else { format!("{path}.lua") };
        Ok(Self { package, path })
    }
}
