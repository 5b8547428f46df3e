//! `mod.toml`: the manifest of a package.

use std::path::Path;

use burgeon_base::error::{Error, Result, SourcePlace};
use semver::{Version, VersionReq};
use toml::Spanned;
use toml::de::{DeTable, DeValue};

use super::names::{FileName, LONGEST, is_name};

/// File name of the manifest.
pub const MANIFEST: &str = "mod.toml";

/// Maximum size (bytes) of a `mod.toml`.
const LARGEST: u64 = 65_536;

/// Allowed keys in a `mod.toml`.
const KEYS: [&str; 11] = [
    "name",
    "version",
    "api",
    "doc",
    "authors",
    "licence",
    "depends",
    "optional",
    "conflicts",
    "replaces",
    "params",
];

/// Manifest of a package.
#[derive(Debug, Clone)]
pub struct Manifest {
    /// Name of the package, which scripts write after an `@`.
    pub name: String,
    /// Version of the package.
    pub version: Version,
    /// Versions of the script API that the package supports.
    pub api: VersionReq,
    /// Human-readable description; may be empty.
    pub doc: String,
    /// Authors of the package.
    pub authors: Vec<String>,
    /// Licence of the package; may be empty.
    pub licence: String,
    /// Required packages.
    pub depends: Vec<Dependency>,
    /// Packages that are used if available.
    pub optional: Vec<Dependency>,
    /// Packages that cannot be used together with this one.
    pub conflicts: Vec<Dependency>,
    /// Files of other packages that this package replaces.
    pub replaces: Vec<Replacement>,
    /// New defaults for parameters of packages.
    pub params: Vec<ParamDefault>,
    /// Line of the version of the script API.
    pub(crate) api_line: usize,
    /// Path of the file, as displayed to users.
    pub(crate) file: String,
}

/// Version requirement for another package.
#[derive(Debug, Clone)]
pub struct Dependency {
    /// Name of the other package.
    pub name: String,
    /// Required versions.
    pub versions: VersionReq,
    /// Line in the file.
    pub(crate) line: usize,
}

/// Replacement of a file of another package.
#[derive(Debug, Clone)]
pub struct Replacement {
    /// Replaced file.
    pub target: FileName,
    /// Path of the package's own file, relative to its folder.
    pub file: String,
    /// Line in the file.
    pub(crate) line: usize,
}

/// New default of a parameter.
#[derive(Debug, Clone)]
pub struct ParamDefault {
    /// Package whose files declare the parameter.
    pub package: String,
    /// Name of the parameter.
    pub name: String,
    /// Default as text, in the format of the command line.
    pub value: String,
    /// Line in the file.
    pub(crate) line: usize,
}

impl Manifest {
    /// Reads the `mod.toml` in `folder`, which is displayed to users as `shown`.
    ///
    /// Fails with the line if the file is invalid. Also fails if a link leads to a file outside the folder.
    pub fn read(folder: &Path, shown: &Path) -> Result<Self> {
        let (path, shown) = (folder.join(MANIFEST), shown.join(MANIFEST));
        let name = shown.display().to_string();
        let cannot = |why: &dyn std::fmt::Display| {
            Error::file(&shown, format!("cannot read {name}: {why}"))
                .help("a package is a folder with a text file mod.toml")
        };
        let inside = path
            .canonicalize()
            .is_ok_and(|found| folder.canonicalize().is_ok_and(|it| found.starts_with(it)));
        if path.exists() && !inside {
            return Err(cannot(&"it is a link to a file outside the package"));
        }
        let bytes = burgeon_base::files::read(&path, LARGEST).map_err(|error| cannot(&error))?;
        let text = String::from_utf8(bytes).map_err(|_| cannot(&"it is not a text file"))?;
        Self::parse(text.strip_prefix('\u{feff}').unwrap_or(&text), &name)
    }

    /// Parses `text`, the content of the file with the displayed path `file`.
    ///
    /// ```
    /// use burgeon_packages::Manifest;
    ///
    /// let text = "name = \"castle\"\nversion = \"1.2.0\"\napi = \"1.0\"\n[depends]\nmasonry = \"1.1\"\n";
    /// let castle = Manifest::parse(text, "castle/mod.toml")?;
    /// assert_eq!((castle.version.minor, &*castle.depends[0].name), (2, "masonry"));
    /// assert!(castle.may_use("masonry") && !castle.may_use("ruins"));
    /// let error = Manifest::parse("name = \"castle\"\nversoin = \"1.0.0\"", "mod.toml").expect_err("a wrong field");
    /// assert_eq!((error.remedy(), error.place().map(|place| place.line)), (Some("did you mean version?"), Some(2)));
    /// # Ok::<(), burgeon_base::Error>(())
    /// ```
    pub fn parse(text: &str, file: &str) -> Result<Self> {
        let file = ManifestFile { text, name: file };
        let table = DeTable::parse(text).map_err(|error| {
            let at = error.span().map_or(0, |span| span.start);
            let said = error.message().lines().next().unwrap_or_default();
            Error::data(format!("this is not TOML: {said}"))
                .at(Some(file.place(at)))
                .help("write name = \"castle\", one field per line")
        })?;
        let table = table.get_ref();
        for key in table.keys() {
            if !KEYS.contains(&&**key.get_ref()) {
                let message = format!("unknown field `{}` in mod.toml", key.get_ref());
                return Err(Error::not_found("field", key.get_ref(), KEYS, message)
                    .help(format!("it has {}", KEYS.join(", ")))
                    .at(Some(file.place(key.span().start))));
            }
        }
        let name = file.text_of(table, "name")?.ok_or_else(|| file.lacks("name", "castle"))?;
        if !is_name(&name.0) {
            return Err(Error::data(format!("invalid package name {:?}", name.0))
                .help(format!("a name begins with a lowercase letter and contains lowercase letters, digits, _ and -, at most {LONGEST} characters"))
                .at(Some(file.place(name.1))));
        }
        let version = file.text_of(table, "version")?.ok_or_else(|| file.lacks("version", "1.0.0"))?;
        let version = Version::parse(&version.0).map_err(|error| {
            Error::data(format!("invalid version {:?}: {error}", version.0))
                .help("a version has three numbers: version = \"1.0.0\"")
                .at(Some(file.place(version.1)))
        })?;
        let api = file.text_of(table, "api")?.ok_or_else(|| file.lacks("api", "1.0"))?;
        Ok(Self {
            name: name.0,
            version,
            api_line: file.line(api.1),
            api: file.versions(&api.0, api.1)?,
            doc: file.text_of(table, "doc")?.unwrap_or_default().0,
            authors: file.authors(table)?,
            licence: file.text_of(table, "licence")?.unwrap_or_default().0,
            depends: file.dependencies(table, "depends")?,
            optional: file.dependencies(table, "optional")?,
            conflicts: file.dependencies(table, "conflicts")?,
            replaces: file.replacements(table)?,
            params: file.params(table)?,
            file: file.name.to_owned(),
        })
    }

    /// Returns the location of a line of the file.
    pub(crate) fn place(&self, line: usize) -> SourcePlace {
        SourcePlace::new(self.file.as_str(), line)
    }

    /// Returns the location of the beginning of the file.
    pub fn begin(&self) -> SourcePlace {
        self.place(1)
    }

    /// Returns the required and the optional dependencies.
    pub fn dependencies(&self) -> impl Iterator<Item = &Dependency> {
        self.depends.iter().chain(&self.optional)
    }

    /// Returns true if the package may use the files of the package `name`.
    pub fn may_use(&self, name: &str) -> bool {
        self.name == name || self.dependencies().any(|wanted| wanted.name == name)
    }
}

impl ParamDefault {
    /// Returns its location in the `mod.toml` of `package`.
    pub fn place(&self, package: &Manifest) -> SourcePlace {
        package.place(self.line)
    }
}

/// State of a `mod.toml` during parsing.
struct ManifestFile<'a> {
    text: &'a str,
    name: &'a str,
}

/// String with its offset in the file (bytes).
type PlacedText = (String, usize);

impl ManifestFile<'_> {
    fn line(&self, at: usize) -> usize {
        1 + self.text.as_bytes().iter().take(at).filter(|byte| **byte == b'\n').count()
    }

    fn place(&self, at: usize) -> SourcePlace {
        SourcePlace::new(self.name, self.line(at))
    }

    fn lacks(&self, field: &str, example: &str) -> Error {
        Error::data(format!("missing field `{field}` in mod.toml"))
            .help(format!("write {field} = {example:?}"))
            .at(Some(self.place(0)))
    }

    /// Returns the error for a `field` whose value should be `what`.
    fn refuse(&self, field: &str, what: &str, value: &Spanned<DeValue<'_>>) -> Error {
        Error::data(format!("{field} must be {what}, not {}", kind(value.get_ref())))
            .at(Some(self.place(value.span().start)))
    }

    fn text_of(&self, table: &DeTable<'_>, field: &str) -> Result<Option<PlacedText>> {
        let Some(value) = table.get(field) else { return Ok(None) };
        match value.get_ref().as_str() {
            Some(text) => Ok(Some((text.to_owned(), value.span().start))),
            None => {
                Err(self.refuse(field, "a string in quotes", value).help(format!("write {field} = \"...\"")))
            }
        }
    }

    fn authors(&self, table: &DeTable<'_>) -> Result<Vec<String>> {
        let Some(value) = table.get("authors") else { return Ok(Vec::new()) };
        let list = value.get_ref().as_array().into_iter().flat_map(|list| list.iter());
        let texts: Option<Vec<String>> = list.map(|one| one.get_ref().as_str().map(str::to_owned)).collect();
        texts.filter(|_| value.get_ref().is_array()).ok_or_else(|| {
            self.refuse("authors", "a list of strings", value).help("write authors = [\"Ada\"]")
        })
    }

    /// Returns the members of the table `field`: the key, the offset of the key (bytes) and the value.
    fn members<'t, 'i>(
        &self,
        table: &'t DeTable<'i>,
        field: &str,
        example: &str,
    ) -> Result<Vec<(&'t str, usize, &'t Spanned<DeValue<'i>>)>> {
        let Some(value) = table.get(field) else { return Ok(Vec::new()) };
        let members = value.get_ref().as_table().ok_or_else(|| {
            let short = field.rsplit('.').next().unwrap_or(field);
            self.refuse(short, "a table", value).help(format!("write {example}"))
        })?;
        // Sort by the order in the file, which users see.
        let mut members: Vec<_> =
            members.iter().map(|(key, value)| (&**key.get_ref(), key.span().start, value)).collect();
        members.sort_by_key(|(_, at, _)| *at);
        Ok(members)
    }

    fn versions(&self, text: &str, at: usize) -> Result<VersionReq> {
        VersionReq::parse(text).map_err(|error| {
            Error::data(format!("invalid version requirement {text:?}: {error}"))
                .help("write \"1.2\" for 1.2.0 to 2.0.0 (exclusive); \">=1.2, <1.5\"; or \"*\" for all")
                .at(Some(self.place(at)))
        })
    }

    fn dependencies(&self, table: &DeTable<'_>, field: &str) -> Result<Vec<Dependency>> {
        let example = format!("[{field}] and below it masonry = \"1.0\"");
        let members = self.members(table, field, &example)?.into_iter();
        members
            .map(|(name, at, value)| {
                if !is_name(name) {
                    return Err(Error::data(format!("{field}: invalid package name {name:?}"))
                        .help(format!("write {example}"))
                        .at(Some(self.place(at))));
                }
                let Some(text) = value.get_ref().as_str() else {
                    return Err(self
                        .refuse(&format!("{field}: {name}"), "a string in quotes", value)
                        .help("write \"1.0\""));
                };
                let versions = self.versions(text, value.span().start)?;
                Ok(Dependency { name: name.to_owned(), versions, line: self.line(at) })
            })
            .collect()
    }

    fn replacements(&self, table: &DeTable<'_>) -> Result<Vec<Replacement>> {
        let example = "[replaces] and below it \"@castle/stone.png\" = \"stone.png\"";
        let members = self.members(table, "replaces", example)?.into_iter();
        members
            .map(|(target, at, value)| {
                let place = || Some(self.place(at));
                let target = FileName::parse(target).map_err(|error| error.at(place()).help(example))?;
                if target.path.is_empty() {
                    return Err(Error::data(format!(
                        "replaces: @{} does not contain a file name",
                        target.package
                    ))
                    .help(format!("write {example}"))
                    .at(place()));
                }
                let Some(file) = value.get_ref().as_str() else {
                    return Err(self
                        .refuse(&format!("replaces: {target}"), "a file of the package", value)
                        .help(format!("write {example}")));
                };
                // The validity of a path does not depend on the package's name.
                FileName::parse(&format!("@own/{file}")).map_err(|_| {
                    Error::file(file, format!("replaces: {file:?} is not a file of the package"))
                        .help("use a path relative to the package's folder: \"textures/stone.png\"")
                        .at(place())
                })?;
                Ok(Replacement { target, file: file.to_owned(), line: self.line(at) })
            })
            .collect()
    }

    fn params(&self, table: &DeTable<'_>) -> Result<Vec<ParamDefault>> {
        let example = "[params.castle] and below it height = 12";
        let mut params = Vec::new();
        for (package, _, value) in self.members(table, "params", example)? {
            let Some(inner) = value.get_ref().as_table() else {
                return Err(self
                    .refuse(&format!("params: {package}"), "a table", value)
                    .help(format!("write {example}")));
            };
            let mut inner: Vec<_> = inner.iter().collect();
            inner.sort_by_key(|(key, _)| key.span().start);
            for (name, value) in inner {
                let text = match value.get_ref() {
                    DeValue::Integer(number) if number.radix() == 10 => number.as_str(),
                    DeValue::Float(number) => number.as_str(),
                    DeValue::Boolean(true) => "true",
                    DeValue::Boolean(false) => "false",
                    DeValue::String(text) => &**text,
                    _ => {
                        let what = format!("params: {package}: {}", name.get_ref());
                        return Err(self
                            .refuse(&what, "a number, a boolean or a string", value)
                            .help(format!("write {example}")));
                    }
                };
                params.push(ParamDefault {
                    package: package.to_owned(),
                    name: name.get_ref().to_string(),
                    value: text.to_owned(),
                    line: self.line(name.span().start),
                });
            }
        }
        Ok(params)
    }
}

/// Returns the human-readable type of a value.
fn kind(value: &DeValue<'_>) -> &'static str {
    match value {
        DeValue::String(_) => "a text",
        DeValue::Integer(_) | DeValue::Float(_) => "a number",
        DeValue::Boolean(_) => "a switch",
        DeValue::Datetime(_) => "a date",
        DeValue::Array(_) => "a list",
        DeValue::Table(_) => "a table",
    }
}
