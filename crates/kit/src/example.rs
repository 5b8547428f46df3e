//! Scripts that show what names do, for the reference.

/// A script that shows what some names do.
#[derive(Debug, Clone, Copy)]
pub struct ScriptExample {
    /// Its file's name without the extension, from the folder `scripts` of the member that has it: `extruder/bend`.
    pub name: &'static str,
    /// What it shows, as `burgeon api` takes it: `extruder:bend`, `extruder.along`, or a type or a function alone.
    pub shows: &'static [&'static str],
    /// Its text.
    pub script: &'static str,
}

/// A list of [`ScriptExample`]s, whose scripts lie in `scripts` beside the folder of the file that lists them.
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
