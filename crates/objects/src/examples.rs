//! Scripts that demonstrate methods and fields, for the reference.

use burgeon_kit::{ScriptExample, examples};

/// Scripts that draw: each has one render.
pub const EXAMPLES: &[ScriptExample] = examples! {
    "attractors" shows "attractors" "attractors:add" "attractors:count" "attractors:direction" "attractors:remaining";
    "discs" shows "discs" "discs:add" "discs:dominated";
    "shadow_voxels" shows "shadow_voxels" "shadow_voxels:shade" "shadow_voxels:light" "shadow_voxels:brightest";
    "obstacles" shows "obstacles" "obstacles:sphere" "obstacles:contains" "obstacles:distance";
    "soil" shows "soil" "soil:take" "soil:taken" "soil:gradient";
    "extruder" shows "extruder";
    "shape" shows "shape" "shape:roof" "shape:color";
    "volumes" shows "volumes" "volumes:claim";
    "footprint" shows "footprint";
    "planet" shows "planet";
    "terrain" shows "terrain";
    "turtle" shows "turtle";
    "obstacles/mesh" shows "obstacles:mesh";
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
    "extruder/shape" shows "extruder:shape";
    "extruder/shift" shows "extruder:shift";
    "extruder/smooth" shows "extruder:smooth" "extruder.smooth";
    "extruder/star" shows "extruder:star";
    "extruder/taper" shows "extruder:taper";
    "extruder/turn" shows "extruder:turn";
    "extruder/twist" shows "extruder:twist";
    "footprint/groundwork" shows "footprint:groundwork";
    "footprint/roof" shows "footprint:roof";
    "footprint/shape" shows "footprint:shape" "footprint:plan";
    "footprint/walls" shows "footprint:walls";
    "terrain/cut" shows "terrain:cut";
    "terrain/dig" shows "terrain:dig";
    "terrain/flatten" shows "terrain:flatten";
    "terrain/river" shows "terrain:river";
    "turtle/add_torque" shows "turtle:add_torque";
    "turtle/add_tropism" shows "turtle:add_tropism";
    "turtle/advance" shows "turtle:advance";
    "turtle/begin_polygon" shows "turtle:begin_polygon" "turtle:point" "turtle:end_polygon";
    "turtle/begin_cylinder" shows "turtle:begin_cylinder" "turtle:end_cylinder";
    "turtle/contour" shows "turtle:contour";
    "turtle/face" shows "turtle:face";
    "turtle/forward" shows "turtle:forward" "turtle.step" "turtle:color" "turtle.color";
    "turtle/joints" shows "turtle.joints";
    "turtle/jump" shows "turtle:jump" "turtle.position";
    "turtle/level" shows "turtle:level";
    "turtle/line_to" shows "turtle:line_to";
    "turtle/mesh" shows "turtle:mesh";
    "turtle/paint" shows "turtle:paint" "turtle.palette";
    "turtle/pitch" shows "turtle:pitch" "turtle:pitch_up";
    "turtle/place" shows "turtle:place";
    "turtle/roll" shows "turtle:roll" "turtle:roll_back";
    "turtle/scale" shows "turtle:scale";
    "turtle/shape" shows "turtle:shape";
    "turtle/simple_tropism" shows "turtle:simple_tropism" "turtle:simple_elasticity" "turtle.simple_tropism"
        "turtle.simple_elasticity" "turtle.simple_increment";
    "turtle/sphere" shows "turtle:sphere";
    "turtle/surface" shows "turtle:surface";
    "turtle/tropism" shows "turtle:tropism" "turtle:elasticity" "turtle.tropism" "turtle.elasticity";
    "turtle/turn" shows "turtle:turn" "turtle:turn_right";
    "turtle/turn_around" shows "turtle:turn_around";
    "turtle/width" shows "turtle:width" "turtle.width";
};

/// Scripts without a render: most of them call read methods.
pub const PLAIN_EXAMPLES: &[ScriptExample] = examples! {
    "curve/length" shows "curve:length" "curve:point" "curve:tangent" "curve:mix";
    "elevation/height" shows "elevation:height" "elevation:low" "elevation:high" "elevation:step";
    "extruder/position" shows "extruder:position" "extruder:heading" "extruder:distance"
        "extruder:open_edges";
    "facade/fits" shows "facade:fits";
    "facade/sizes" shows "bordered:min_width" "bordered:max_width" "bordered:min_height"
        "bordered:max_height" "bordered:fits" "extruded:min_width" "extruded:max_width"
        "extruded:min_height" "extruded:max_height" "extruded:fits" "grid:min_width" "grid:max_width"
        "grid:min_height" "grid:max_height" "grid:fits" "list:min_width" "list:max_width"
        "list:min_height" "list:max_height" "list:fits" "panel:min_width" "panel:max_width"
        "panel:min_height" "panel:max_height" "panel:fits";
    "footprint/edges" shows "footprint:edges" "footprint:edge_length" "footprint:edge_start"
        "footprint:edge_facing" "footprint:edge_has" "footprint:street_edge";
    "footprint/keywords" shows "footprint:attribute" "footprint:has";
    "footprint/measures" shows "footprint:area" "footprint:perimeter" "footprint:convexity"
        "footprint:lowest" "footprint:highest" "footprint:height";
    "footprint/neighbors" shows "footprint:shared" "footprint:neighbors" "footprint:distance";
    "geometry/around" shows "geometry:envelope" "geometry:convex_hull" "geometry:oriented_envelope";
    "geometry/line" shows "geometry:point_n" "geometry:start_point" "geometry:end_point"
        "geometry:offset" "geometry:simplify" "geometry:direction" "geometry:line_interpolate"
        "geometry:line_substring" "geometry:line_locate";
    "geometry/measures" shows "geometry:num_points" "geometry:x" "geometry:y" "geometry:z"
        "geometry:place" "geometry:area" "geometry:length" "geometry:perimeter" "geometry:envelope_width"
        "geometry:envelope_height" "geometry:distance" "geometry:nearest_point" "geometry:wkt";
    "geometry/parts" shows "geometry:exterior_ring" "geometry:interior_rings" "geometry:point_on_surface"
        "geometry:segments" "geometry:boundary" "geometry:geometries" "geometry:num_geometries"
        "geometry:is_empty";
    "geometry/relate" shows "geometry:equals" "geometry:disjoint" "geometry:intersects"
        "geometry:touches" "geometry:crosses" "geometry:within" "geometry:contains" "geometry:covers"
        "geometry:overlaps" "geometry:relate";
    "geometry/skeleton" shows "geometry:straight_skeleton" "geometry:skeleton_faces" "geometry:inset";
    "geometry/together" shows "geometry:union" "geometry:intersection" "geometry:sym_difference";
    "geometry/valid" shows "geometry:is_valid" "geometry:validity" "geometry:make_valid";
    "model/size" shows "model:low" "model:high";
    "network/dead_ends" shows "network:grow" "network:join_dead_ends" "network:remove_dead_ends"
        "network:open_ends" "network:joinable" "network:dead_ends";
    "network/existing" shows "network:omitted";
    "network/outcome" shows "network:end_junction" "network:outcome" "network:probe" "network:place"
        "network:places" "network:degree";
    "network/lots" shows "network:measures" "network:size" "network:distance" "network:streets"
        "network:junctions" "network:blocks" "network:lots" "network:height" "network:verge"
        "network:sites" "network:face";
    "network/walk" shows "network:grow_to" "network:walk" "network:turn" "network:move_to";
    "obstacles/hit" shows "obstacles:box" "obstacles:prism" "obstacles:count" "obstacles:nearest"
        "obstacles:normal" "obstacles:hit";
    "planet/height" shows "planet:focus" "planet:height" "planet:surface" "planet:symbol"
        "planet:heights";
    "ramp/slope" shows "ramp:slope" "ramp:at" "ramp:integral" "ramp:mix";
    "shape/appearance" shows "shape:smooth" "shape:material" "shape:project" "shape:face_color";
    "shape/components" shows "shape:faces" "shape:matches" "shape:edges" "shape:edge_kind" "shape:holes"
        "shape:without_holes" "shape:geometry" "shape:joined_faces" "shape:pieces" "shape:components";
    "shape/measures" shows "shape:size" "shape:position" "shape:center" "shape:x_axis" "shape:y_axis"
        "shape:z_axis" "shape:volume" "shape:area" "shape:length" "shape:slope" "shape:face_count"
        "shape:open_edges" "shape:points" "shape:is_solid";
    "shape/moves" shows "shape:translate" "shape:shift" "shape:rotate" "shape:resize" "shape:mirror"
        "shape:reverse" "shape:align" "shape:fit" "shape:array";
    "shape/parts" shows "shape:split" "shape:split_area" "shape:index" "shape:count" "shape:entry"
        "shape:get" "shape:with";
    "shape/plans" shows "shape:offset" "shape:setback" "shape:border" "shape:wings"
        "shape:setback_to_area" "shape:envelope" "shape:inner_rectangle" "shape:scatter";
    "shape/repair" shows "shape:ground_plan" "shape:rectify" "shape:convexify" "shape:reduce";
    "shape/relations" shows "shape:contains" "shape:overlaps" "shape:touches" "shape:distance";
    "shape/sets" shows "shape:union" "shape:subtract" "shape:intersect" "shape:trim";
    "shape/solids" shows "shape:extrude" "shape:taper" "shape:molding" "shape:loft" "shape:chamfer"
        "shape:fillet" "shape:crop" "shape:recess" "shape:cut_hole";
    "shape/sweep" shows "shape:sweep";
    "shape/tags" shows "shape:tag" "shape:untag" "shape:tags" "shape:has_tag" "shape:recompose";
    "shape/trim_to" shows "shape:trim_to";
    "volumes/distance" shows "volumes:has" "volumes:count" "volumes:is_free" "volumes:distance" "volumes:rank"
        "volumes:is_visible";
    "soil/total" shows "soil:add" "soil:diffuse" "soil:amount" "soil:total";
    "streets/distance" shows "streets:distance";
    "surface/normal" shows "surface:normal" "surface:point" "surface:mix";
    "terrain/height" shows "terrain:focus" "terrain:height" "terrain:normal" "terrain:slope"
        "terrain:symbol" "terrain:heights" "terrain:is_source"
        "terrain:river_cut";
    "turtle/material" shows "turtle:material";
    "turtle/position" shows "turtle:position" "turtle:heading" "turtle:left" "turtle:up"
        "turtle:distance";
    "universe/planet" shows "universe:galaxy" "universe:star" "universe:planet";
    "template" shows "template:fits";
};

#[cfg(test)]
mod tests {
    use std::path::Path;

    use burgeon_kit::Kind;

    use super::*;

    #[test]
    fn every_script_shows_something_that_there_is_and_every_method_is_shown() {
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
        for shown in EXAMPLES.iter().chain(PLAIN_EXAMPLES).flat_map(|example| example.shows) {
            assert!(named(shown), "{shown}");
        }
        for kind in registry.kinds() {
            for method in kind.methods.iter().filter(|it| kind.deprecation(&it.name).is_none()) {
                let name = format!("{}:{}", kind.name, method.name);
                let shows = |list: &[ScriptExample]| list.iter().any(|it| it.shows.contains(&&*name));
                let drawn = kind.has_capability::<dyn burgeon_kit::Draw>()
                    && method.call.changes()
                    && name != "turtle:material";
                assert!(!drawn || shows(EXAMPLES), "no picture shows {name}");
                let called = kind.example.contains(&format!(":{}(", method.name));
                assert!(called || shows(EXAMPLES) || shows(PLAIN_EXAMPLES), "{name} is shown by no script");
            }
        }
        for example in PLAIN_EXAMPLES {
            let called =
                |name: &&str| example.script.contains(&format!(":{}(", name.split(':').nth(1).unwrap()));
            assert!(example.shows.iter().all(called), "{} calls not all that it shows", example.name);
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
                let mut all = EXAMPLES.iter().chain(PLAIN_EXAMPLES);
                assert!(all.any(|example| example.name == name), "{name}");
                count += 1;
            }
        }
        assert!(count > 65, "{count}");
    }
}
