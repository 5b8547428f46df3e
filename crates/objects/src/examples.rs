//! Scripts that show what methods and fields do, for the reference: each draws one picture.

/// A script that shows what some methods or fields do.
#[derive(Debug, Clone, Copy)]
pub struct MemberExample {
    /// Its file's name without the extension, from the folder `scripts`: `extruder/bend`.
    pub name: &'static str,
    /// What it shows, as `burgeon api` takes it: `extruder:bend`, `extruder.along`, or a type alone.
    pub shows: &'static [&'static str],
    /// Its text.
    pub script: &'static str,
}

macro_rules! examples {
    ($($name:literal shows $($shown:literal)+;)*) => {
        &[$(MemberExample {
            name: $name,
            shows: &[$($shown),+],
            script: include_str!(concat!("../scripts/", $name, ".lua")),
        }),*]
    };
}

/// All of them.
pub const EXAMPLES: &[MemberExample] = examples! {
    "extruder" shows "extruder";
    "footprint" shows "footprint";
    "planet" shows "planet";
    "terrain" shows "terrain";
    "turtle" shows "turtle";
    "extruder/advance" shows "extruder:advance";
    "extruder/bend" shows "extruder:bend";
    "extruder/caps" shows "extruder:caps" "extruder.caps";
    "extruder/color" shows "extruder:color" "extruder.color";
    "extruder/direction" shows "extruder:direction";
    "extruder/extrude" shows "extruder:extrude";
    "extruder/jump" shows "extruder:jump" "extruder.position";
    "extruder/material" shows "extruder:material" "extruder.roughness" "extruder.metallic";
    "extruder/mesh" shows "extruder:mesh";
    "extruder/pitch" shows "extruder:pitch";
    "extruder/place" shows "extruder:place";
    "extruder/polygon" shows "extruder:polygon" "extruder.shape";
    "extruder/rectangle" shows "extruder:rectangle";
    "extruder/regular" shows "extruder:regular" "extruder.sides";
    "extruder/resolution" shows "extruder:resolution" "extruder.along" "extruder.around";
    "extruder/roll" shows "extruder:roll";
    "extruder/scale" shows "extruder:scale";
    "extruder/shift" shows "extruder:shift";
    "extruder/smooth" shows "extruder:smooth" "extruder.smooth";
    "extruder/star" shows "extruder:star";
    "extruder/taper" shows "extruder:taper";
    "extruder/turn" shows "extruder:turn";
    "extruder/twist" shows "extruder:twist";
    "footprint/groundwork" shows "footprint:groundwork";
    "footprint/roof" shows "footprint:roof";
    "footprint/walls" shows "footprint:walls";
    "terrain/cut" shows "terrain:cut";
    "terrain/dig" shows "terrain:dig";
    "terrain/flatten" shows "terrain:flatten";
    "terrain/river" shows "terrain:river";
    "turtle/advance" shows "turtle:advance";
    "turtle/begin_polygon" shows "turtle:begin_polygon" "turtle:point" "turtle:end_polygon";
    "turtle/face" shows "turtle:face";
    "turtle/forward" shows "turtle:forward" "turtle.step" "turtle:color" "turtle.color";
    "turtle/jump" shows "turtle:jump" "turtle.position";
    "turtle/level" shows "turtle:level";
    "turtle/mesh" shows "turtle:mesh";
    "turtle/paint" shows "turtle:paint" "turtle.palette";
    "turtle/pitch" shows "turtle:pitch" "turtle:pitch_up";
    "turtle/place" shows "turtle:place";
    "turtle/roll" shows "turtle:roll" "turtle:roll_back";
    "turtle/sphere" shows "turtle:sphere";
    "turtle/tropism" shows "turtle:tropism" "turtle:elasticity" "turtle.tropism" "turtle.elasticity";
    "turtle/turn" shows "turtle:turn" "turtle:turn_right";
    "turtle/turn_around" shows "turtle:turn_around";
    "turtle/width" shows "turtle:width" "turtle.width";
};

#[cfg(test)]
mod tests {
    use std::path::Path;

    use burgeon_kit::Kind;

    use super::*;

    #[test]
    fn every_script_shows_something_that_there_is_and_every_method_that_draws_is_shown() {
        let registry = crate::registry();
        let named = |name: &str| {
            let (kind, member) = name.split_once([':', '.']).unwrap_or((name, ""));
            let kind: &Kind = registry.get(kind).unwrap_or_else(|| panic!("{name}"));
            member.is_empty()
                || if name.contains(':') {
                    kind.method(member).is_some()
                } else {
                    kind.fields.iter().any(|it| it.name == member)
                }
        };
        for shown in EXAMPLES.iter().flat_map(|example| example.shows) {
            assert!(named(shown), "{shown}");
        }
        for kind in registry.kinds().filter(|kind| kind.draw.is_some()) {
            for method in kind.methods.iter().filter(|method| method.call.changes()) {
                let name = format!("{}:{}", kind.name, method.name);
                let shown = EXAMPLES.iter().any(|example| example.shows.contains(&&*name));
                assert!(shown || ["turtle:material"].contains(&&*name), "{name} is shown by no script");
            }
        }
    }

    #[test]
    fn every_script_for_a_method_is_among_them() {
        let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("scripts");
        let mut count = 0;
        for kind in std::fs::read_dir(&folder)
            .unwrap()
            .map(|entry| entry.unwrap().path())
            .filter(|path| path.is_dir())
        {
            for script in std::fs::read_dir(&kind).unwrap() {
                let path = script.unwrap().path().with_extension("");
                let name = path.strip_prefix(&folder).unwrap().display().to_string();
                assert!(EXAMPLES.iter().any(|example| example.name == name), "{name}");
                count += 1;
            }
        }
        assert!(count > 40, "{count}");
    }
}
