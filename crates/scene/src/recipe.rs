//! Recipe of a model: everything that is needed to make it again, except packages and data, which it names with their hashes.

use serde::{Deserialize, Serialize};

/// Recipe of a model. It contains no path outside the folders of the script and of its data, and no password.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Recipe {
    /// Version of the program that made the model.
    pub program: String,
    /// Name of the main script among [`files`](Self::files).
    pub script: String,
    /// Texts of the script's own files, the main script first.
    pub files: Vec<RecipeFile>,
    /// Values of all parameters, in the order of their declaration.
    #[serde(default)]
    pub values: Vec<RecipeValue>,
    /// Seed of all random numbers.
    #[serde(default)]
    pub seed: u64,
    /// Maximum number of derivation steps; `None` leaves it to the script.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub steps: Option<usize>,
    /// Level of detail, from 0 to 3.
    #[serde(default = "full_detail")]
    pub lod: u8,
    /// Part of the features, such as `2/4`, and the reach (m) within which other features are derived too.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub part: Option<(String, f64)>,
    /// Packages that the script used.
    #[serde(default)]
    pub packages: Vec<ScenePackage>,
    /// Data files, models and textures that the script read, sorted by name.
    #[serde(default)]
    pub data: Vec<RecipeData>,
    /// Set if the script may query databases, whose content the recipe cannot name.
    #[serde(default, skip_serializing_if = "is_false")]
    pub databases: bool,
    /// Hash of the file that replaced the standard library.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub stdlib: Option<String>,
}

/// File of a script.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
pub struct RecipeFile {
    /// Path from the script's folder, with `/` between its parts.
    pub name: String,
    /// Content of the file.
    pub text: String,
}

/// Value of a parameter.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct RecipeValue {
    /// Name of the parameter; a parameter of a package has the package as a prefix.
    pub name: String,
    /// Value: a number, a boolean, a text or a list of points.
    pub value: serde_json::Value,
    /// Default value from the script, if the value differs from it.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub default: Option<serde_json::Value>,
    /// Display unit; may be empty.
    #[serde(default, skip_serializing_if = "String::is_empty")]
    pub unit: String,
}

/// File that a script read.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
pub struct RecipeData {
    /// Path from the script's folder or from a data folder, with `/` between its parts.
    pub name: String,
    /// Hash of its content, with the name of the method as a prefix.
    pub hash: String,
}

/// Package of scripts that a scene was made with.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
pub struct ScenePackage {
    /// Name of the package.
    pub name: String,
    /// Version, three numbers.
    pub version: String,
    /// Hash of its files, with the name of the method as a prefix.
    pub hash: String,
}

impl Recipe {
    /// Maximum size (bytes) of a recipe as JSON.
    pub const LARGEST: usize = 1_000_000;

    /// Returns the text of the main script; `None` if the recipe is incomplete.
    pub fn main_text(&self) -> Option<&str> {
        self.files.iter().find(|file| file.name == self.script).map(|file| file.text.as_str())
    }
}

impl RecipeValue {
    /// Returns the value as text, as the command line takes it.
    pub fn text(&self) -> String {
        match &self.value {
            serde_json::Value::String(text) => text.clone(),
            value => value.to_string(),
        }
    }
}

fn full_detail() -> u8 {
    3
}

#[allow(clippy::trivially_copy_pass_by_ref, reason = "serde passes references")]
fn is_false(value: &bool) -> bool {
    !value
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_recipe_reads_back_and_older_ones_may_have_less() {
        let recipe = Recipe {
            program: "0.1.0".into(),
            script: "a \"b\" </script>\u{1f331}.lua".into(),
            files: vec![RecipeFile {
                name: "a \"b\" </script>\u{1f331}.lua".into(),
                text: "-- \u{1f331}\n".into(),
            }],
            values: vec![RecipeValue {
                name: "n".into(),
                value: 3.5.into(),
                default: Some(2.0.into()),
                unit: "m".into(),
            }],
            seed: u64::MAX,
            steps: Some(4),
            lod: 2,
            part: Some(("2/4".into(), 30.0)),
            packages: vec![ScenePackage {
                name: "castle".into(),
                version: "1.2.0".into(),
                hash: "blake3:0".into(),
            }],
            data: vec![RecipeData { name: "a/b.csv".into(), hash: "blake3:1".into() }],
            databases: true,
            stdlib: Some("blake3:2".into()),
        };
        let text = serde_json::to_string(&recipe).unwrap();
        assert_eq!(serde_json::from_str::<Recipe>(&text).unwrap(), recipe);
        assert_eq!(recipe.main_text(), Some("-- \u{1f331}\n"));
        let least: Recipe =
            serde_json::from_str(r#"{"program":"9","script":"a.lua","files":[],"more":1}"#).unwrap();
        assert_eq!((least.lod, least.seed, least.main_text()), (3, 0, None));
        assert!(serde_json::from_str::<Recipe>(r#"{"program":"9"}"#).is_err());
    }

    #[test]
    fn values_become_the_text_of_the_command_line() {
        let text = |value: serde_json::Value| {
            RecipeValue { name: "a".into(), value, default: None, unit: String::new() }.text()
        };
        assert_eq!(text("#ff0000".into()), "#ff0000");
        assert_eq!(
            (text(true.into()), text(serde_json::json!([[0.0, 1.5]]))),
            ("true".into(), "[[0.0,1.5]]".into())
        );
    }
}
