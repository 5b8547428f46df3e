//! Example scripts of the API reference.

/// Script that demonstrates some names of the scripting API.
#[derive(Debug, Clone, Copy)]
pub struct ScriptExample {
    /// Name of its file without the extension, relative to the folder `scripts` of its crate: `extruder/bend`.
    pub name: &'static str,
    /// Demonstrated names, as `burgeon api` takes them: `extruder:bend`, `extruder.along`, or a type or a function
    /// alone.
    pub shows: &'static [&'static str],
    /// Source text of the script.
    pub script: &'static str,
}

/// Creates a list of [`ScriptExample`]s. Their scripts are in the folder `scripts`, next to the folder of the file that
/// lists them.
#[macro_export]
macro_rules! examples {
    ($($name:literal shows $($shown:literal)+;)*) => {
        &[$($crate::ScriptExample {
            name: $name,
            shows: &[$($shown),+],
            script: include_str!(concat!("../scripts/", $name, ".lua")),
        }),*]
    };
}
