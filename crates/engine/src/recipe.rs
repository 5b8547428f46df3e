//! Recipe of a run: the scripts, values and hashes with which its model can be made again.

use std::borrow::Cow;
use std::collections::{BTreeMap, BTreeSet};
use std::path::{Component, Path, PathBuf};

use crate::declare::{FeaturePart, Param, Session};
use crate::run::scene_package;
use burgeon_base::error::{Error, Limit, Result};
use burgeon_base::text::{grouped, without_passwords};
use burgeon_packages::{Packages, hash_file};
use burgeon_scene::{Recipe, RecipeData, RecipeFile, RecipeValue};

/// Recipe whose packages and data files have not been hashed yet.
pub struct RecipeDraft {
    recipe: Recipe,
    packages: Packages,
    used: BTreeSet<String>,
    /// Names and paths of the data files, sorted.
    data: Vec<(String, PathBuf)>,
    stdlib: Option<PathBuf>,
}

impl RecipeDraft {
    /// Returns the recipe, with the hashes of the files as they are now.
    ///
    /// Fails if a file cannot be read, or if the recipe is larger than [`Recipe::LARGEST`].
    pub fn complete(&self) -> Result<Recipe> {
        let mut recipe = self.recipe.clone();
        let locked = self.packages.lock(|name| self.used.contains(name))?;
        recipe.packages = locked.into_iter().map(scene_package).collect();
        let data =
            self.data.iter().map(|(name, path)| Ok(RecipeData { name: name.clone(), hash: hash(path)? }));
        recipe.data = data.collect::<Result<_>>()?;
        recipe.stdlib = self.stdlib.as_deref().map(hash).transpose()?;
        let size = serde_json::to_vec(&recipe).map_err(Error::internal)?.len();
        if size > Recipe::LARGEST {
            let (size, most) = (grouped(size), grouped(Recipe::LARGEST));
            let text = format!("the recipe of the model has {size} bytes, and at most {most} are allowed");
            return Err(Error::limit(Limit::Size, text)
                .help("leave it out: --no-recipe, or move parts of the script to a package"));
        }
        Ok(recipe)
    }
}

impl Session {
    /// Returns the recipe of a run with the parameters `params`.
    ///
    /// Paths are relative to the script's folder or to a data folder, so the recipe does not depend on the place of these
    /// folders. Passwords in addresses of databases are replaced.
    pub fn recipe(&self, params: &[Param]) -> RecipeDraft {
        let options = &self.options;
        let main = self.inner_name(self.path(), true);
        let script = main.unwrap_or_else(|| "script.lua".to_owned());
        let own = self.own_files().into_iter();
        let mut files: Vec<RecipeFile> = own.map(|(name, text)| RecipeFile { name, text }).collect();
        files.sort_by_key(|file| file.name != script);
        let recipe = Recipe {
            program: env!("CARGO_PKG_VERSION").to_owned(),
            script,
            files,
            values: params.iter().map(value).collect(),
            seed: options.seed,
            steps: options.steps,
            lod: options.lod,
            part: options.part.filter(|part| part.cell.is_none()).map(part),
            packages: Vec::new(),
            data: Vec::new(),
            databases: !options.inputs.databases.is_empty(),
            stdlib: None,
        };
        RecipeDraft {
            recipe,
            packages: self.packages().clone(),
            used: self.used_packages(),
            data: self.data_files(),
            stdlib: options.inputs.stdlib.clone(),
        }
    }

    /// Returns names and texts of the script files that do not belong to packages, sorted.
    fn own_files(&self) -> BTreeMap<String, String> {
        let own = self.own_texts().into_iter();
        own.filter_map(|(path, text)| {
            let text = match without_passwords(&text) {
                Cow::Owned(text) => text,
                Cow::Borrowed(_) => text,
            };
            Some((self.inner_name(&path, true)?, text))
        })
        .collect()
    }

    /// Returns names and paths of the files that the run has read as data, sorted.
    fn data_files(&self) -> Vec<(String, PathBuf)> {
        let (scripts, curves) = (self.files(), self.curves().path().to_path_buf());
        let curves = curves.canonicalize().unwrap_or(curves);
        let named = std::iter::once(self.script()).chain(self.options.inputs.stdlib.as_deref());
        let named: Vec<PathBuf> = named.filter_map(|path| path.canonicalize().ok()).collect();
        let mut data = BTreeMap::new();
        for (path, exists) in self.sought() {
            let real = path.canonicalize().ok().filter(|real| exists && real.is_file());
            let Some(real) =
                real.filter(|real| *real != curves && !scripts.contains(real) && !named.contains(real))
            else {
                continue;
            };
            // The name that the script uses may be that of a link.
            let name = self.inner_name(&path, false).or_else(|| self.inner_name(&real, false));
            if let Some(name) = name {
                data.entry(name).or_insert(real);
            }
        }
        data.into_iter().collect()
    }

    /// Returns the path of a file from the script's folder, or else, unless the file must be there, from a data folder;
    /// `None` for files of packages and for files elsewhere.
    fn inner_name(&self, path: &Path, is_beside: bool) -> Option<String> {
        if self.packages().order().iter().any(|package| path.starts_with(&package.folder)) {
            return None;
        }
        let roots = std::iter::once(self.root()).chain(self.data_roots().iter().map(PathBuf::as_path));
        let origin = self.origin(path);
        let inner = roots
            .take(if is_beside { 1 } else { usize::MAX })
            .find_map(|root| origin.strip_prefix(root).ok())?;
        let parts = inner.components().map(|part| match part {
            Component::Normal(name) => name.to_str(),
            _ => None,
        });
        let parts: Option<Vec<&str>> = parts.collect();
        parts.filter(|parts| !parts.is_empty()).map(|parts| parts.join("/"))
    }
}

/// Returns the hash of a file that the run has read.
fn hash(path: &Path) -> Result<String> {
    hash_file(path).map_err(|error| {
        Error::file(path, format!("cannot read {} for the recipe of the model: {error}", path.display()))
            .help("check its permissions, or leave the recipe out: --no-recipe")
    })
}

fn part(part: FeaturePart) -> (String, f64) {
    (format!("{}/{}", part.number, part.count), part.reach)
}

fn value(param: &Param) -> RecipeValue {
    let differs = param.value != param.default;
    RecipeValue {
        name: param.name.clone(),
        value: param.value.to_json(),
        default: differs.then(|| param.default.to_json()),
        unit: param.unit.clone(),
    }
}
