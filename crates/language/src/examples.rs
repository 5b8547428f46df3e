//! Example scripts for the names of the language, for the API reference.

use burgeon_kit::{ScriptExample, examples};

/// All example scripts of this crate.
pub const EXAMPLES: &[ScriptExample] = examples! {
    "BeginPolygon" shows "BeginPolygon" "Point" "EndPolygon";
    "Color" shows "Color";
    "Cut" shows "Cut";
    "Draw" shows "Draw";
    "Elasticity" shows "Elasticity";
    "F" shows "F" "G";
    "Level" shows "Level";
    "Material" shows "Material";
    "Paint" shows "Paint";
    "Pitch" shows "Pitch" "Down" "Up";
    "Place" shows "Place";
    "Roll" shows "Roll" "RollLeft" "RollRight";
    "SimpleElasticity" shows "SimpleElasticity";
    "Sphere" shows "Sphere";
    "Turn" shows "Turn" "Left" "Right";
    "TurnAround" shows "TurnAround";
    "Width" shows "Width";
    "abop" shows "abop";
    "api" shows "api" "api.has";
    "beta" shows "beta";
    "binomial" shows "binomial";
    "camera" shows "camera";
    "choose" shows "choose";
    "color" shows "color";
    "components" shows "components";
    "consider" shows "system:consider";
    "cuboid" shows "cuboid" "rectangle" "disk" "cylinder" "cone" "ball" "revolve";
    "decompose" shows "system:decompose";
    "derived" shows "derived" "derived:chain";
    "ease" shows "ease" "ease.in" "ease.out" "ease.inout" "ease.smooth" "ease.sine" "ease.back";
    "expect" shows "expect";
    "extend" shows "extend";
    "feature" shows "feature";
    "fragment" shows "fragment";
    "geometry" shows "geometry";
    "hsv" shows "hsv";
    "layer" shows "layer";
    "lerp" shows "lerp";
    "line" shows "line";
    "lod" shows "lod";
    "lsystem" shows "lsystem";
    "mix" shows "mix";
    "module" shows "module";
    "noise" shows "noise";
    "normal" shows "normal";
    "object" shows "object";
    "param" shows "param";
    "point" shows "point";
    "poisson" shows "poisson";
    "polar" shows "polar";
    "polygon" shows "polygon";
    "prototype" shows "prototype";
    "query" shows "query";
    "random" shows "random";
    "remap" shows "remap";
    "report" shows "report";
    "require" shows "require";
    "rgb" shows "rgb";
    "rule" shows "rule" "system:rule";
    "sequence" shows "sequence";
    "shape" shows "shape";
    "source" shows "source";
    "split" shows "split";
    "step" shows "step";
    "stop" shows "stop" "system:after_step" "now";
    "stream" shows "stream";
    "subsystem" shows "system:subsystem";
    "system" shows "system" "system:axiom" "system:ignore" "system:interpret" "system:derive";
    "text" shows "text";
    "time" shows "time" "derive";
    "use_group" shows "use_group" "system:before_step";
    "variables" shows "variables" "system:at_start" "system:at_end";
    "vec" shows "vec";
    "vector" shows "vector" "vector:dot" "vector:cross" "vector:length" "vector:unit" "vector:distance"
        "vector:lerp";
    "warn" shows "warn";
};

#[cfg(test)]
mod tests {
    use std::collections::BTreeSet;
    use std::path::Path;

    use super::*;
    use crate::names::{NameKind, names};

    #[test]
    fn every_name_of_burgeon_is_shown_by_a_script_and_nothing_else_is() {
        let mut wanted = BTreeSet::new();
        for name in names().iter().filter(|name| name.sort != NameKind::Luau) {
            wanted.insert(name.name.to_string());
            let separator = if name.sort == NameKind::Given { ':' } else { '.' };
            wanted
                .extend(name.functions.iter().map(|inner| format!("{}{separator}{}", name.name, inner.name)));
        }
        let shown: Vec<&str> = EXAMPLES.iter().flat_map(|example| example.shows).copied().collect();
        assert_eq!(shown.iter().map(|name| (*name).to_owned()).collect::<BTreeSet<_>>(), wanted);
        assert_eq!(shown.len(), wanted.len(), "a name is shown by two scripts");
        for example in EXAMPLES {
            assert!(example.script.starts_with("-- "), "{} does not say what there is to see", example.name);
        }
        let folder = std::fs::read_dir(Path::new(env!("CARGO_MANIFEST_DIR")).join("scripts")).unwrap();
        assert_eq!(folder.count(), EXAMPLES.len(), "a script is not in the list");
    }
}
