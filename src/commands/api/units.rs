//! Numbers without a unit in the scripting API. A new number must have a unit in its doc, or be listed here.

use std::collections::BTreeSet;

use super::entry::{Entry, EntryGroup, Member, MemberKind};
use burgeon::language::CallForm;

/// Counts.
const COUNTS: [&str; 49] = [
    "ball sides",
    "cone sides",
    "cylinder sides",
    "derive.steps",
    "derived.modules",
    "derived.steps",
    "disk sides",
    "extruder.along",
    "extruder.around",
    "extruder.sides",
    "extruder:regular sides",
    "extruder:resolution along",
    "extruder:resolution around",
    "extruder:star points",
    "footprint:roof.details.count",
    "footprint:roof.details.flap",
    "footprint:roof.details.rows",
    "footprint:roof.levels",
    "geometry:buffer.quadrant_segments",
    "geometry:offset.quadrant_segments",
    "grid.columns",
    "grid.rows",
    "lsystem.max_depth",
    "network.existing.depth",
    "network.existing.lanes",
    "network.max_segments",
    "network.streets.lanes",
    "network:grow depth",
    "network:grow_to depth",
    "network:lead depth",
    "network:probe depth",
    "now.modules",
    "now.step",
    "planet.levels",
    "revolve.sides",
    "shadow_voxels.depth",
    "shape:array count",
    "shape:fillet segments",
    "shape:roof.levels",
    "shape:scatter count",
    "source.limit",
    "surface.degree",
    "surface.divisions",
    "system:derive steps",
    "system:derive.steps",
    "terrain.levels",
    "terrain.plants.density",
    "terrain:focus view",
    "turtle.sides",
];

/// Fractions, probabilities, weights and factors.
const FACTORS: [&str; 80] = [
    ".amount",
    ".metallic",
    ".noise",
    ".normal_scale",
    ".patches",
    ".roughness",
    "Elasticity elasticity",
    "SimpleElasticity elasticity",
    "Place scale",
    "curve:mix t",
    "curve:point t",
    "curve:tangent t",
    "discs.overlap",
    "ease.back t",
    "ease.in t",
    "ease.inout t",
    "ease.out t",
    "ease.sine t",
    "ease.smooth t",
    "extruder:place scale",
    "extruder:scale scale",
    "extruder:scale y",
    "extruder:star inner",
    "extruder:taper scale",
    "extruder:taper y",
    "footprint:roof.details.chance",
    "footprint:roof.details.scale",
    "geometry:line_interpolate part",
    "geometry:line_substring from",
    "geometry:line_substring to",
    "geometry:random_point u",
    "geometry:random_point v",
    "hsv saturation",
    "hsv value",
    "lerp t",
    "mix t",
    "network:join_dead_ends detour",
    "network:joinable detour",
    "network:lots.elongation",
    "network:lots.jitter",
    "network:lots.parks",
    "network:sites.shrink",
    "noise x",
    "noise y",
    "noise z",
    "obstacles:mesh scale",
    "planet.closeness",
    "planet.error",
    "ramp:mix t",
    "rule.weight",
    "shadow_voxels.decay",
    "shadow_voxels.strength",
    "shape:project.offset",
    "shape:reduce share",
    "shape:sweep.scale",
    "shape:taper scale",
    "surface.weights",
    "surface:mix t",
    "surface:normal u",
    "surface:normal v",
    "surface:point u",
    "surface:point v",
    "system:decompose.weight",
    "system:interpret.weight",
    "system:rule.weight",
    "template.weight",
    "terrain.plants.size",
    "turtle.elasticity",
    "turtle:add_torque elasticity",
    "turtle:add_tropism elasticity",
    "turtle.simple_elasticity",
    "turtle.simple_increment",
    "turtle:elasticity elasticity",
    "turtle:simple_elasticity elasticity",
    "turtle:simple_tropism elasticity",
    "turtle:place scale",
    "turtle:scale factor",
    "turtle:surface scale",
    "turtle:tropism elasticity",
    "vector:lerp t",
];

/// Indices, codes and seeds.
const NUMBERS: [&str; 39] = [
    ".seed",
    "Paint number",
    "derived:chain number",
    "discs:add vigor",
    "elevation.crs",
    "extruder:mesh faces",
    "footprint:edge_facing edge",
    "footprint:edge_has edge",
    "footprint:edge_length edge",
    "footprint:edge_start edge",
    "footprint:shared edge",
    "geometry:geometry_n number",
    "geometry:point_n number",
    "network.existing.level",
    "network:arrived junction",
    "network:degree junction",
    "network:end_junction junction",
    "network:face junction",
    "network:fate junction",
    "network:grow junction",
    "network:grow_to junction",
    "network:lead junction",
    "network:move_to junction",
    "network:open_end junction",
    "network:outcome junction",
    "network:place junction",
    "network:probe junction",
    "network:reached junction",
    "network:stand junction",
    "noise seed",
    "shadow_voxels:shade amount",
    "source.crs",
    "turtle:mesh faces",
    "turtle:paint number",
    "universe:galaxy x",
    "universe:galaxy y",
    "universe:galaxy z",
    "universe:planet index",
    "universe:star index",
];

/// Values in any unit that the script or the file uses.
const ANY: [&str; 45] = [
    ".time",
    "beta a",
    "beta b",
    "beta r",
    "binomial n",
    "binomial p",
    "binomial r",
    "choose r",
    "choose weights",
    "elevation.bounds",
    "expect tolerance",
    "footprint:roof.direction",
    "lerp a",
    "lerp b",
    "normal deviation",
    "normal mean",
    "normal r",
    "param.default",
    "param.max",
    "param.min",
    "param.step",
    "poisson mean",
    "poisson r",
    "ramp:at x",
    "ramp:integral a",
    "ramp:integral b",
    "ramp:slope x",
    "random a",
    "random b",
    "remap from",
    "remap high",
    "remap low",
    "remap to",
    "remap x",
    "report value",
    "shape:envelope limits",
    "soil.amount",
    "soil:add amount",
    "soil:take amount",
    "source.within",
    "stream ...",
    "surface.u_knots",
    "surface.v_knots",
    "volumes:claim value",
    "volumes:rank value",
];

/// Returns true if a value of this type is a number or contains numbers.
fn is_number(luau: &str) -> bool {
    luau.replace(": number", "").replace("[number]", "").contains("number")
}

fn of_forms(found: &mut BTreeSet<String>, name: &str, forms: &[CallForm]) {
    let arguments = forms.iter().flat_map(|form| &form.arguments);
    let alone = arguments.filter(|argument| argument.fields.is_empty() && argument.unit.is_none());
    let without = alone.filter(|argument| is_number(&argument.luau));
    found.extend(without.map(|argument| format!("{name} {}", argument.name)));
}

fn of_members(found: &mut BTreeSet<String>, owner: &str, members: &[Member]) {
    for member in members {
        let name = member.full_name(owner);
        let is_alone = member.what == MemberKind::Field && member.fields.is_empty();
        if is_alone && member.unit.is_none() && is_number(&member.luau) {
            found.insert(name.clone());
        }
        of_forms(found, &name, &member.forms);
        of_members(found, &name, &member.fields);
    }
}

/// Returns the numbers without a unit in `entries`, qualified as `burgeon api` names them.
fn without_unit(entries: &[Entry]) -> BTreeSet<String> {
    let mut found = BTreeSet::new();
    for entry in entries.iter().filter(|entry| entry.group != EntryGroup::Luau) {
        of_forms(&mut found, &entry.name, &entry.forms);
        of_members(&mut found, &entry.name, &entry.members);
    }
    found
}

#[test]
fn every_number_has_a_unit_or_a_reason_to_have_none() {
    let found = without_unit(&super::command::entries(&burgeon::registry()));
    let listed: Vec<&str> = [&COUNTS[..], &FACTORS, &NUMBERS, &ANY].concat();
    // Numbers of many tables are listed by their own name only.
    let matches = |name: &str, known: &str| name == known || known.starts_with('.') && name.ends_with(known);
    let new: Vec<&String> = found.iter().filter(|name| !listed.iter().any(|it| matches(name, it))).collect();
    assert_eq!(new, [""; 0], "tell the unit of each in round brackets in its doc, or list it here");
    let gone: Vec<&&str> = listed.iter().filter(|it| !found.iter().any(|name| matches(name, it))).collect();
    assert_eq!(gone, [&""; 0], "these have a unit, or are gone");
    assert_eq!(listed.iter().collect::<BTreeSet<_>>().len(), listed.len(), "one is listed twice");
}
