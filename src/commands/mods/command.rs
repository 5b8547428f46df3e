//! `burgeon mods` and its subcommands: `check`, `explain`, `new`, `add`, `disable` and `enable`.

use std::collections::{BTreeMap, BTreeSet};
use std::path::{Path, PathBuf};

use burgeon::packages::{self, Package, PackageSearch, Packages, is_name};
use burgeon::script::{Param, RunInputs, RunOptions, api_version};
use burgeon::{Error, Result, ScriptCheck, Warning};
use clap::{Args, Subcommand};
use serde_json::json;

use super::super::report;
use super::super::shared::user_mods;
use super::create::create;
use super::text;

/// Lists the packages that scripts can use, and what they replace; checks, explains, makes, adds and disables them
#[derive(Args)]
#[command(args_conflicts_with_subcommands = false)]
pub(crate) struct ModsCommand {
    #[command(subcommand)]
    command: Option<ModsAction>,

    /// Script whose packages to use (mods/ next to it) [default: packages in ./mods]
    #[arg(long, value_name = "SCRIPT", global = true)]
    script: Option<PathBuf>,

    /// Adds a folder of packages, or one package; may be repeated
    #[arg(long, value_name = "FOLDER", global = true)]
    mods: Vec<PathBuf>,

    /// Prints machine-readable JSON instead of text
    #[arg(long, global = true)]
    json: bool,
}

#[derive(Subcommand)]
enum ModsAction {
    /// Reports the problems of packages: in mod.toml, in scripts, and missing files
    Check {
        /// Folder of a package [default: all packages]
        folder: Option<PathBuf>,
    },
    /// Explains where a package comes from, its load order and its replacements
    Explain {
        /// Name of the package
        name: String,
    },
    /// Creates a starter package, in mods next to the script or in ./mods
    New {
        /// Name of the package
        name: String,
    },
    /// Copies a package from a folder or a zip
    Add {
        /// Folder that contains the mod.toml, or a zip of it
        #[arg(value_name = "FOLDER|ZIP")]
        from: PathBuf,

        /// Packages folder to install into [default: mods next to the script, or ./mods]
        #[arg(long, value_name = "FOLDER")]
        into: Option<PathBuf>,

        /// Replaces an installed package of that name
        #[arg(long)]
        replace: bool,
    },
    /// Disables a package for the scripts of the folder, wherever the package is
    Disable {
        /// Name of the package
        name: String,
    },
    /// Enables a disabled package
    Enable {
        /// Name of the package
        name: String,
    },
}

impl ModsCommand {
    pub(crate) fn json(&self) -> bool {
        self.json
    }

    pub(crate) fn run(&self) -> Result<()> {
        match &self.command {
            None => self.list(),
            Some(ModsAction::Check { folder }) => self.check(folder.as_deref()),
            Some(ModsAction::Explain { name }) => self.explain(name),
            Some(ModsAction::New { name }) => self.create(name),
            Some(ModsAction::Add { from, into, replace }) => self.add(from, into.as_deref(), *replace),
            Some(ModsAction::Disable { name }) => self.switch(name, false),
            Some(ModsAction::Enable { name }) => self.switch(name, true),
        }
    }

    /// Returns the folder of the script.
    fn beside(&self) -> Result<PathBuf> {
        let Some(script) = &self.script else { return Ok(PathBuf::new()) };
        if !script.is_file() {
            let shown = script.display();
            return Err(Error::not_found("script", &shown, [], format!("script not found: {shown}"))
                .help("--script needs the script whose packages to use"));
        }
        Ok(script.parent().map(Path::to_path_buf).unwrap_or_default())
    }

    fn packages(&self) -> Result<Packages> {
        let (beside, user) = (self.beside()?, user_mods());
        let search = PackageSearch { script: Some(&beside), given: &self.mods, user: user.as_deref() };
        Ok(Packages::find(search, &api_version()))
    }

    fn list(&self) -> Result<()> {
        let packages = self.packages()?;
        report::print(&match self.json {
            true => format!("{}\n", text::list_json(&packages)),
            false => text::list(&packages),
        })
    }

    fn create(&self, name: &str) -> Result<()> {
        let folder = create(&self.beside()?.join("mods"), name)?;
        if self.json {
            return report::print(&format!("{}\n", json!({ "ok": true, "folder": folder })));
        }
        report::eprint(&format!("created {}; now: require(\"@{name}\")\n", folder.display()));
        Ok(())
    }

    fn explain(&self, name: &str) -> Result<()> {
        let packages = self.packages()?;
        let Some(package) = packages.get(name.trim_start_matches('@')) else {
            let known = packages.order().iter().map(|package| package.manifest.name.as_str());
            let error = Error::not_found("package", name, known, format!("unknown package `{name}`"));
            return Err(error.help("run burgeon mods to list the packages"));
        };
        report::print(&match self.json {
            true => {
                let mut document = text::package_json(&packages, package);
                document["ok"] = true.into();
                format!("{document}\n")
            }
            false => text::explain(&packages, package),
        })
    }

    fn check(&self, folder: Option<&Path>) -> Result<()> {
        let mut given = self.mods.clone();
        given.extend(folder.map(Path::to_path_buf));
        let (beside, user) = (self.beside()?, user_mods());
        let search = PackageSearch { script: Some(&beside), given: &given, user: user.as_deref() };
        let mut packages = Packages::find(search, &api_version());
        let mut problems = std::mem::take(&mut packages.problems);
        if folder.is_none() {
            problems.extend(std::mem::take(&mut packages.broken).into_iter().map(|broken| broken.error));
        }
        let mut declared: BTreeMap<&str, Vec<Param>> = BTreeMap::new();
        let mut warnings: Vec<Warning> = std::mem::take(&mut packages.warnings);
        let meant = match folder {
            None => packages.order().iter().collect(),
            Some(folder) => {
                let folder = folder.canonicalize().unwrap_or_else(|_| folder.to_path_buf());
                packages.order().iter().filter(|package| package.folder == folder).collect::<Vec<_>>()
            }
        };
        if let (Some(folder), true, true) = (folder, meant.is_empty(), problems.is_empty()) {
            let shown = folder.display();
            let problem =
                Error::not_found("package", &shown, [], format!("{shown} contains no package in use"));
            problems.push(
                problem.help("specify the folder that contains the mod.toml; run burgeon mods to list all"),
            );
        }
        // A problem of one package is also a problem of the packages that require it.
        let mut known: BTreeSet<String> = problems.iter().map(ToString::to_string).collect();
        let of_packages = meant.iter().flat_map(|package| &package.problems);
        problems.extend(of_packages.filter(|problem| known.insert(problem.to_string())).cloned());
        // Packages that conflict cannot be run.
        if problems.is_empty() {
            for package in &meant {
                let checked = self.declared(package, search, &mut declared);
                match checked {
                    Ok(more) => warnings.extend(more),
                    Err(error) => problems.extend(error.problems().map(Error::without_others)),
                }
                problems.extend(self.check_params(&packages, package, search, &mut declared));
            }
        }
        if !problems.is_empty() {
            return Err(Error::several(problems));
        }
        if self.json {
            let names: Vec<_> = meant.iter().map(|package| text::package_json(&packages, package)).collect();
            let warnings = report::warnings_json(&warnings);
            return report::print(&format!(
                "{}\n",
                json!({ "ok": true, "packages": names, "warnings": warnings })
            ));
        }
        report::eprint(&report::warnings(&warnings));
        for package in meant {
            let (name, version) = (&package.manifest.name, &package.manifest.version);
            let scripts = package.scripts().len();
            let s = if scripts == 1 { "" } else { "s" };
            report::eprint(&format!("{name} {version}: no problems in {scripts} script{s}\n"));
        }
        Ok(())
    }

    /// Checks the scripts of a package, and stores the parameters that they declare.
    fn declared<'p>(
        &self,
        package: &'p Package,
        search: PackageSearch<'_>,
        declared: &mut BTreeMap<&'p str, Vec<Param>>,
    ) -> Result<Vec<Warning>> {
        let beside = search.script.map(|script| script.join("mods")).filter(|mods| mods.is_dir());
        // The displayed path of a package determines how its files are named in messages.
        let mods = std::iter::once(&package.shown).chain(search.given).chain(&beside).cloned().collect();
        let user_mods = search.user.map(Path::to_path_buf);
        let inputs = RunInputs { mods, user_mods, ..RunInputs::default() };
        let options = RunOptions { inputs, ..burgeon::options() };
        let ScriptCheck { params, warnings, .. } = burgeon::check_package(&package.shown, options)?;
        declared.insert(&package.manifest.name, params);
        Ok(warnings)
    }

    /// Returns the errors of default values for parameters that the other package does not declare, or that do not
    /// accept them.
    fn check_params<'p>(
        &self,
        packages: &'p Packages,
        package: &Package,
        search: PackageSearch<'_>,
        declared: &mut BTreeMap<&'p str, Vec<Param>>,
    ) -> Vec<Error> {
        let mut problems = Vec::new();
        for default in &package.manifest.params {
            let Some(other) = packages.get(&default.package) else { continue };
            // Problems of the other package are reported for that package.
            let name = default.package.as_str();
            if !declared.contains_key(name) && self.declared(other, search, declared).is_err() {
                continue;
            }
            let Some(params) = declared.get(name) else { continue };
            let of_package =
                || params.iter().filter(|param| param.package.as_ref() == Some(&default.package));
            if !of_package().any(|param| param.short_name() == default.name) {
                let names = of_package().map(burgeon::script::Param::short_name);
                let message =
                    format!("unknown parameter of the package {}: `{}`", default.package, default.name);
                let error = Error::not_found("parameter", &default.name, names, message);
                let error = error
                    .help(format!("run burgeon mods explain {} to list its parameters", default.package));
                problems.push(error.at(Some(default.place(&package.manifest))));
            }
        }
        problems
    }

    /// Enables or disables the package `name` for the scripts of the folder.
    fn switch(&self, name: &str, on: bool) -> Result<()> {
        let name = name.trim_start_matches('@');
        let packages = self.packages()?;
        let known = packages.order().iter().map(|package| package.manifest.name.as_str());
        let known = known.chain(packages.disabled.iter().map(|package| package.name.as_str()));
        let known: Vec<&str> = known.collect();
        // A deleted package can still be disabled.
        if !known.contains(&name) && (!on || !is_name(name)) {
            let error = Error::not_found("package", name, known, format!("unknown package `{name}`"));
            return Err(error.help("run burgeon mods to list the packages"));
        }
        let (file, changed) = packages::switch(&self.beside()?, name, on)?;
        if self.json {
            let document =
                json!({ "ok": true, "name": name, "enabled": on, "changed": changed, "file": file });
            return report::print(&format!("{document}\n"));
        }
        let state = if on { "enabled" } else { "disabled" };
        let file = file.display();
        report::eprint(&match (changed, on) {
            (false, _) => format!("{name} is already {state}\n"),
            (true, false) => {
                format!("disabled {name} in {file}; to enable it: burgeon mods enable {name}\n")
            }
            (true, true) => format!("enabled {name}\n"),
        });
        Ok(())
    }

    fn add(&self, from: &Path, into: Option<&Path>, replace: bool) -> Result<()> {
        let into = match into {
            Some(into) => into.to_path_buf(),
            None => self.beside()?.join("mods"),
        };
        let (beside, user) = (self.beside()?, user_mods());
        let given: Vec<PathBuf> = self.mods.iter().chain(into.is_dir().then_some(&into)).cloned().collect();
        let search = PackageSearch { script: Some(&beside), given: &given, user: user.as_deref() };
        // Required packages may be in other folders than the one that the package is added to.
        let available = Packages::find(search, &api_version());
        let added = packages::install(from, &into, replace, |manifest| available.check_needs(manifest))?;
        let (name, version) = (&added.manifest.name, &added.manifest.version);
        let replaced = added.replaced.as_ref();
        if self.json {
            return report::print(&format!(
                "{}\n",
                json!({
                    "ok": true, "name": name, "version": version.to_string(), "folder": added.folder,
                    "replaced": replaced.map(ToString::to_string), "files": added.files, "bytes": added.bytes,
                })
            ));
        }
        let instead = replaced.map_or_else(String::new, |old| format!(" instead of {old}"));
        let folder = added.folder.display();
        report::eprint(&format!(
            "added {name} {version} to {folder}{instead}; scripts use it with require(\"@{name}\")\n"
        ));
        Ok(())
    }
}
