//! Shapes in modules: splits, components and claims of volumes.

use super::scripts::{chain, error, run};

const PARTS: &str = r#"
local Mass, Floor, Wall, Roof = module("Mass", "s"), module("Floor", "n"), module("Wall", "w"), module("Roof", "a")
local building = lsystem({ object = extruder() })
building:axiom(Mass(cuboid(6, 4, 10)))
"#;

#[test]
fn parts_of_a_split_become_modules_in_ascending_order() {
    let script = format!(
        r#"{PARTS}
        local function floor(s) return Floor(s:size().z) end
        building:rule("Mass(s)", function(this, s)
          return split(s, "z", {{ {{ 4, floor }}, {{ 1, false }}, {{ "~2*", floor }}, {{ 1, function(s) return Roof(s:index()) end }} }})
        end)
        building:derive(1)"#
    );
    assert_eq!(chain(&script), "Floor(4) Floor(2) Floor(2) Roof(5)");
}

#[test]
fn a_component_becomes_the_first_module_whose_selector_it_matches() {
    let script = format!(
        r#"{PARTS}
        building:rule("Mass(s)", function(this, s)
          return components(s, "faces", {{
            {{ "front", function(f) return Wall(f:size().x) end }},
            {{ function(f) return f:area() > 50 end, function(f) return Wall(0) end }},
            {{ "side", function(f) return Wall(f:size().x) end }},
            {{ "top", function(f) return Roof(f:area()) end }},
          }})
        end)
        building:derive(1)"#
    );
    assert_eq!(chain(&script), "Wall(6) Wall(4) Wall(0) Wall(4) Roof(24)");
}

#[test]
fn further_values_of_a_part_become_further_parameters() {
    let script = |rest: &str| {
        format!(
            r#"
        local Mass, Part, Name = module("Mass", "s"), module("Part", "s", "a?", "b?"), module("Name", "text")
        local building = lsystem({{ object = extruder() }})
        building:axiom(Mass(cuboid(6, 4, 10)))
        local function same(...) return Part(...) end
        building:rule("Mass(s)", function(this, s)
          return Name("first"), {{ split(s, "z", {{ {{ 4, Part, 7 }}, {{ 1, false }}, {{ "~2.4*", {rest}, "x", true }} }}) }},
            components(s, "faces", {{ {{ "side", Part, 1.5 }}, {{ "top", Part }} }}), Name("last")
        end)
        building:derive(1)"#
        )
    };
    let wanted = r#"Name("first") [ Part(box of 6 x 4 x 4 m,7) Part(box of 6 x 4 x 2.5 m,"x",true) Part(box of 6 x 4 x 2.5 m,"x",true) ] Part(rectangle of 6 x 10 m,1.5) Part(rectangle of 4 x 10 m,1.5) Part(rectangle of 6 x 10 m,1.5) Part(rectangle of 4 x 10 m,1.5) Part(rectangle of 6 x 4 m) Name("last")"#;
    assert_eq!(chain(&script("Part")), wanted);
    assert_eq!(chain(&script("same")), wanted, "by functions");
}

#[test]
fn modules_of_parts_have_the_required_parameters() {
    let script = format!(
        "{PARTS}
        local Two = module('Two', 's', 'n')
        building:rule('Mass(s)', function(this, s) return split(s, 'z', {{ {{ '~4*', Two }} }}) end)
        building:derive(1)"
    );
    let told = error(&script);
    assert!(told.contains("Two has 2 parameters; n is missing"), "{told}");
    let told = error(&script.replace("Two }", "Two, 1, 2 }"));
    assert!(told.contains("Two has 2 parameters, not 3"), "{told}");
    let told = error(&script.replace("'~4*', Two", "nil, Two"));
    assert!(told.contains("split: a part has no size"), "{told}");
}

#[test]
fn the_first_of_two_shapes_that_exclude_each_other_stays_for_any_number_of_threads() {
    let script = r#"
        local Box, Kept = module("Box", "s"), module("Kept", "x")
        local space = volumes()
        local boxes = lsystem({ object = extruder(), environment = { space } })
        local list = {}
        for number = 0, 9 do list[number + 1] = Box(cuboid(3, 3, 3):translate(vec(2 * number, 0, 0))) end
        boxes:axiom(sequence(list))
        boxes:interpret("Box(s)", function(this, s) space:claim(s, "box") end)
        boxes:rule("Box(s)", function(this, s) if space:has(s) then return Kept(s:position().x) end return nil end)
        boxes:derive(1)"#;
    assert_eq!(chain(script), "Kept(0) Kept(4) Kept(8) Kept(12) Kept(16)");
}

#[test]
fn an_error_in_a_predicate_has_its_line() {
    let script = format!(
        "{PARTS}
        building:rule('Mass(s)', function(this, s)
          return components(s, 'faces', {{ {{ function(f) return f:sise().x > 1 end, Wall }} }})
        end)
        building:derive(1)"
    );
    let told = error(&script);
    assert!(told.contains("unknown method or field `sise` of shape") && told.contains("Mass"), "{told}");
}

#[test]
fn measures_of_operations_are_exact() {
    run(r#"
        local function near(found: any, wanted: number) expect(math.abs(found - wanted) < 1e-6, true) end
        local lot = rectangle(30, 20)
        near(lot:setback({ front = 5, side = 3 })[1]:area(), 24 * 12)
        near(lot:wings({ front = 8, left = 6 })[1]:area(), 30 * 8 + 12 * 6)
        near(lot:offset(2)[1]:area(), 34 * 24)
        near(lot:setback_to_area(300)[1]:area(), 300)
        near(lot:envelope(20, { front = { 9, 45 } }):volume(), 30 * 20 * 20 - 30 * 11 * 11 / 2)
        near(lot:roof({ kind = "hip", height = 4 }):volume(), 4 * (20 * 10 / 2 + 20 * 20 / 3))
        near(lot:taper(6):volume(), 30 * 20 * 6 / 3)
        near(lot:molding({ { 0, 0 }, { 1, 0 }, { 1, 2 }, { 0, 2 } }):volume(), (32 * 22 - 600) * 2)
        local block, hole = cuboid(4, 4, 4), cuboid(2, 2, 6):translate(vec(1, 1, -1))
        local ring, both, all = block:subtract(hole), block:intersect(hole), block:union(hole)
        assert(ring and both and all)
        near(ring:volume(), 48)
        near(both:volume(), 16)
        near(all:volume(), 72)
        expect(ring:is_solid() and both:is_solid() and all:is_solid(), true)
        near(shape(block:split("x", { "1*" })):recompose():face_count(), 6)
        expect(block:chamfer(0.5, "corner"):face_count(), 10)
        expect(block:overlaps(hole), true)
        expect(block:touches(block:translate(vec(4, 0, 0))), true)
        near(block:distance(block:translate(vec(7, 8, 0))), 5)
    "#);
}

#[test]
fn claims_are_ranked_and_hide_what_is_behind_them() {
    let script = r#"
        local Box, Kept = module("Box", "s", "value"), module("Kept", "rank", "left", "right")
        local space = volumes()
        local boxes = lsystem({ object = extruder(), environment = { space } })
        local list = {}
        for number = 0, 4 do list[number + 1] = Box(cuboid(1, 1, 1):translate(vec(3 * number, 0, 0)), number * 7 % 5) end
        boxes:axiom(sequence(list))
        boxes:interpret("Box(s, value)", function(this, s, value) space:claim(s, if value > 2 then "tall" else "low", value) end)
        boxes:rule("Box(s, value)", function(this, s, value)
          local at = s:center()
          local step = vec(0.6, 0, 0)
          local function free(to) return space:is_visible(at + if to > at.x then step else -step, vec(to, 0.5, 0.5), "tall") end
          return Kept(space:rank(value), free(-5), free(20))
        end)
        boxes:derive(1)"#;
    // The values are 0, 2, 4, 1 and 3, of which the third and the last one are tall.
    assert_eq!(
        chain(script),
        "Kept(5,true,false) Kept(3,true,false) Kept(1,true,false) Kept(4,false,false) Kept(2,false,true)"
    );
}

#[test]
fn entries_that_differ_in_one_value_divide_differently() {
    // Equal entries are read once; those of other rules and applications differ in sizes, modules, values or groups.
    let script = format!(
        r#"{PARTS}
        local Cut, Part = module("Cut", "s", "n"), module("Part", "s", "a?")
        building:rule("Mass(s)", function(this, s)
          return Cut(s, 1), Cut(s, 2), Cut(s, 1), Cut(s, 3), Cut(s, 4)
        end)
        building:rule("Cut(s, n)", {{ when = function(this, s, n) return n < 4 end }}, function(this, s, n)
          return split(s, "x", {{ {{ n, Part, n }}, {{ "~1", if n == 3 then Part else false }} }})
        end)
        building:rule("Cut(s, n)", function(this, s, n)
          return split(s, "x", {{ {{ {{ 1, Part, 1 }}, {{ "~2", Part }} }} }})
        end)
        building:derive(2)"#
    );
    let part = |x: u32, more: &str| format!("Part(box of {x} x 4 x 10 m{more})");
    let pairs = [part(1, ",1"), part(2, "")].join(" ");
    let wanted =
        [part(1, ",1"), part(2, ",2"), part(1, ",1"), part(3, ",3"), part(3, ""), pairs.clone(), pairs]
            .join(" ");
    assert_eq!(chain(&script), wanted);
}

#[test]
fn an_entry_with_a_name_is_not_lost_after_equal_entries_without_it() {
    let script = format!(
        r#"{PARTS}
        local Cut, Part = module("Cut", "s", "n"), module("Part", "s")
        building:rule("Mass(s)", function(this, s) return Cut(s, 1), Cut(s, 2) end)
        building:rule("Cut(s, n)", function(this, s, n)
          local entries = {{ {{ "~1", Part }} }} :: any
          if n == 2 then entries.named = {{ 2, Part }} end
          return split(s, "x", entries)
        end)
        building:derive(2)"#
    );
    let part = |x: u32| format!("Part(box of {x} x 4 x 10 m)");
    assert_eq!(chain(&script), [part(6), part(4), part(2)].join(" "));
}

#[test]
fn a_rule_with_other_sizes_in_each_application_needs_no_more_memory() {
    let script = format!(
        r#"{PARTS}
        local Cut, Part = module("Cut", "s", "n"), module("Part", "s")
        building:rule("Mass(s)", function(this, s)
          local list = {{}}
          for n = 1, 2000 do list[n] = Cut(s, n / 500) end
          return sequence(list)
        end)
        building:rule("Cut(s, n)", function(this, s, n)
          return split(s, "x", {{ {{ n, Part }}, {{ "~1", false }} }})
        end)
        building:derive(2)"#
    );
    let text = chain(&script);
    assert_eq!(text.matches("Part(").count(), 2000);
    assert!(text.contains("Part(box of 3.4 x 4 x 10 m)") && text.contains("Part(box of 0.002 x 4 x 10 m)"));
}

#[test]
fn points_in_an_upright_plane_are_an_upright_face_with_holes() {
    run(r#"
        local wall = shape({
          { { 0, 2, 0 }, { 4, 2, 0 }, { 4, 2, 3 }, { 2, 2, 5 }, { 0, 2, 3 } },
          { { 1, 2, 1 }, { 2, 2, 1 }, { 2, 2, 2 }, { 1, 2, 2 } },
        })
        assert(math.abs(wall:area() - 15) < 1e-9)
        assert((wall:z_axis() - vec(0, -1, 0)):length() < 1e-9)
        assert(#wall:holes() == 1)
        local size = wall:size()
        assert(math.abs(size.x - 4) < 1e-9 and math.abs(size.y - 5) < 1e-9 and size.z == 0)
        local front = cuboid(3, 1, 2):faces("front")[1]
        local same = shape({ { 0, 0, 0 }, { 3, 0, 0 }, { 3, 0, 2 }, { 0, 0, 2 } })
        assert((same:z_axis() - front:z_axis()):length() < 1e-9 and (same:center() - front:center()):length() < 1e-9)
        local ok, reason = pcall(shape, { { 0, 0, 0 }, { 3, 0, 0 }, { 3, 1, 2 }, { 0, -1, 2 } })
        assert(not ok and string.find(tostring(reason), "not flat"), tostring(reason))
        -- A plan with heights is a face on the ground, as before.
        assert(shape({ { 0, 0, 1 }, { 4, 0, 2 }, { 4, 3, 1 } }):position().z == 0)
    "#);
}
