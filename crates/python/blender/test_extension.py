"""Tests of the Blender extension without a window: bpy from PyPI, the wheel, and this folder on the path.

    pip install bpy burgeon-*.whl pytest
    pytest test_extension.py
"""

import importlib.util
import sys
import time
from pathlib import Path

import pytest

bpy = pytest.importorskip("bpy")

import burgeon  # noqa: E402
import numpy as np  # noqa: E402

HERE = Path(__file__).parent

TOWER = """
local floors = param("floors", { default = 12, min = 1, max = 60, step = 1, doc = "Number of floors." })
local twist = param("twist", { default = 4, min = -15, max = 15, unit = "deg" })
local look = param("look", { default = "steel", choices = { "steel", "brick" } })
local tint = param("tint", { default = "#336699" })
local lit = param("lit", { default = true })
local Floor = module("Floor", "n")
local tower = lsystem({ object = extruder({ sides = 8, smooth = false }) })
tower:axiom(Floor(floors))
tower:rule("Floor(n)", { when = function(_, n) return n > 0 end }, function(_, n) return F(1), Floor(n - 1) end)
tower:rule("Floor", function() return nil end)
tower:interpret("F(h)", function(this, h) this:roll(twist):extrude(h) end)
tower:derive(floors + 1)
"""

FOREST = """
local Tree = module("Tree", "x")
local leaf = lsystem({ object = extruder({ sides = 3 }) })
leaf:axiom(F(1))
leaf:interpret("F(h)", function(this, h) this:extrude(h) end)
local one = leaf:derive(0)
local forest = lsystem({ object = turtle() })
forest:axiom(Tree(0), Tree(1), Tree(2))
forest:interpret("Tree(x)", function(this, x) this:place(one)
  this:advance(2)
end)
forest:derive(0)
"""


@pytest.fixture(scope="module")
def extension():
    spec = importlib.util.spec_from_file_location(
        "burgeon_extension", HERE / "extension" / "__init__.py", submodule_search_locations=[str(HERE / "extension")]
    )
    module = importlib.util.module_from_spec(spec)
    sys.modules["burgeon_extension"] = module
    spec.loader.exec_module(module)
    module.register()
    yield module
    module.unregister()


@pytest.fixture
def add(extension, tmp_path):
    bpy.ops.wm.read_homefile(use_empty=True)

    def added(text, name="model.lua"):
        path = tmp_path / name
        path.write_text(text, encoding="utf-8")
        assert bpy.ops.burgeon.add(filepath=str(path)) == {"FINISHED"}
        return bpy.data.collections[path.stem], path

    return added


def values_of(extension, model):
    """Returns the values of a model and the names of its properties by parameter."""
    listed = extension.values.listed(model)
    return extension.values.group(model), {it.name: key for it, key in listed}


def height(model):
    corners = [item.matrix_world @ vertex.co for item in model.all_objects for vertex in item.data.vertices]
    return max(corner.z for corner in corners)


def test_a_script_becomes_objects_and_its_parameters_properties(extension, add):
    model, _ = add(TOWER)
    assert model.burgeon.error == ""
    assert height(model) == pytest.approx(12, abs=1e-4)
    values, keys = values_of(extension, model)
    floors = values.bl_rna.properties[keys["floors"]]
    assert (floors.type, floors.hard_min, floors.hard_max, floors.description) == ("INT", 1, 60, "Number of floors.")
    assert values.bl_rna.properties[keys["twist"]].description == "(deg)"
    assert [it.identifier for it in values.bl_rna.properties[keys["look"]].enum_items] == ["steel", "brick"]
    assert list(getattr(values, keys["tint"])) == pytest.approx([0.2, 0.4, 0.6], abs=1e-3)
    assert getattr(values, keys["lit"]) is True


def test_a_slider_changes_the_model_and_keeps_the_objects(extension, add):
    model, _ = add(TOWER)
    item = next(iter(model.all_objects))
    item.modifiers.new("Bevel", "BEVEL")
    values, keys = values_of(extension, model)
    begun = time.perf_counter()
    setattr(values, keys["floors"], 30)
    took = time.perf_counter() - begun
    print(f"a slider to the changed tower: {1000 * took:.0f} ms")
    assert height(model) == pytest.approx(30, abs=1e-4)
    assert next(iter(model.all_objects)) is item or item.name in model.all_objects
    assert "Bevel" in item.modifiers
    assert bpy.ops.burgeon.defaults() == {"FINISHED"}
    assert height(model) == pytest.approx(12, abs=1e-4)


def test_an_error_stands_in_the_panel_with_its_line_and_leaves_the_model(extension, add):
    model, path = add(TOWER)
    path.write_text(TOWER.replace(":extrude(h)", ":extruded(h)"), encoding="utf-8")
    with pytest.raises(RuntimeError, match="extruded"):
        bpy.ops.burgeon.run()
    assert "model.lua:" in model.burgeon.error and "extruded" in model.burgeon.error
    assert height(model) == pytest.approx(12, abs=1e-4)
    path.write_text(TOWER, encoding="utf-8")
    assert bpy.ops.burgeon.run() == {"FINISHED"}
    assert model.burgeon.error == ""


def test_a_saved_script_with_other_parameters_keeps_the_values_of_those_that_stay(extension, add):
    model, path = add(TOWER)
    values, keys = values_of(extension, model)
    setattr(values, keys["floors"], 20)
    setattr(values, keys["look"], "brick")
    path.write_text(TOWER.replace('local lit = param("lit", { default = true })', ""), encoding="utf-8")
    assert bpy.ops.burgeon.run() == {"FINISHED"}
    assert model.burgeon.error == ""
    values, keys = values_of(extension, model)
    assert "lit" not in keys
    assert (getattr(values, keys["floors"]), getattr(values, keys["look"])) == (20, "brick")
    assert height(model) == pytest.approx(20, abs=1e-4)


def test_instances_share_a_mesh(extension, add):
    model, _ = add(FOREST)
    assert model.burgeon.error == ""
    assert len(model.all_objects) == 3
    assert len({item.data.name for item in model.all_objects}) == 1
    places = sorted(round(item.matrix_world.translation.length, 3) for item in model.all_objects)
    assert places == [0, 2, 4]


def test_a_file_that_is_opened_again_has_its_values_and_runs(extension, add, tmp_path):
    model, _ = add(TOWER)
    values, keys = values_of(extension, model)
    setattr(values, keys["floors"], 17)
    name, file = model.name, str(tmp_path / "it's “new” 🌱.blend")
    bpy.ops.wm.save_as_mainfile(filepath=file)
    bpy.ops.wm.open_mainfile(filepath=file)
    model = bpy.data.collections[name]
    values, keys = values_of(extension, model)
    assert getattr(values, keys["floors"]) == 17
    setattr(values, keys["floors"], 18)
    assert height(model) == pytest.approx(18, abs=1e-4)


def test_a_file_that_is_opened_again_has_no_object_twice(extension, add, tmp_path):
    model, _ = add(HOUSES)
    name, file = model.name, str(tmp_path / "again.blend")
    before = sorted(it.name for it in bpy.data.objects), sorted(it.name for it in bpy.data.meshes)
    bpy.ops.wm.save_as_mainfile(filepath=file)
    bpy.ops.wm.open_mainfile(filepath=file)
    model = bpy.data.collections[name]
    assert bpy.ops.burgeon.run() == {"FINISHED"}
    assert (sorted(it.name for it in bpy.data.objects), sorted(it.name for it in bpy.data.meshes)) == before
    assert sorted(it.name for it in model.children) == ["barn", "mill"]


def test_a_copy_of_a_model_and_the_model_change_alone(extension, add):
    model, _ = add(TOWER)
    copy = model.copy()
    bpy.context.scene.collection.children.link(copy)
    for item in list(copy.objects):
        copy.objects.unlink(item)
        copy.objects.link(item.copy())
    values, keys = values_of(extension, copy)
    setattr(values, keys["floors"], 20)
    assert (height(model), height(copy)) == (pytest.approx(12, abs=1e-4), pytest.approx(20, abs=1e-4))
    assert (len(model.all_objects), len(copy.all_objects)) == (1, 1)
    values, keys = values_of(extension, model)
    setattr(values, keys["floors"], 5)
    assert (height(model), height(copy)) == (pytest.approx(5, abs=1e-4), pytest.approx(20, abs=1e-4))


PAINTED = """
local s = lsystem({ object = extruder({ sides = 4 }) })
s:axiom(F(1))
s:interpret("F(h)", function(this, h) this:material({ name = "stone", color = "#COLOR" }):extrude(h) end)
s:derive(0)
"""


def test_two_models_with_materials_of_one_name_keep_their_colors(extension, add):
    red, path = add(PAINTED.replace("COLOR", "ff0000"), "red.lua")
    other = path.with_name("blue.lua")
    other.write_text(PAINTED.replace("COLOR", "0000ff"), encoding="utf-8")
    assert bpy.ops.burgeon.add(filepath=str(other)) == {"FINISHED"}

    def colors():
        shown = [bpy.data.collections[name].all_objects[0].material_slots[0].material for name in ("red", "blue")]
        return [tuple(round(part) for part in it.diffuse_color[:3]) for it in shown]

    assert colors() == [(1, 0, 0), (0, 0, 1)]
    path.write_text(PAINTED.replace("COLOR", "00ff00"), encoding="utf-8")
    assert bpy.ops.burgeon.choose(name="red") == {"FINISHED"}
    assert bpy.ops.burgeon.run() == {"FINISHED"}
    assert colors() == [(0, 1, 0), (0, 0, 1)]
    assert sorted(it.name for it in bpy.data.materials) == ["stone", "stone.001"]


STAINED = """
local s = lsystem({ object = extruder })
s:axiom(F(1))
s:interpret("F(h)", function(this, h)
  local wall = shape({ { 0, 0, 0 }, { 6, 0, 0 }, { 6, 0, 3 }, { 0, 0, 3 } })
  this:shape(wall:project(2, 2):project(6, 3, { set = "stain" }):material({
    DIRT
    roughness = 0.9,
  }))
end)
s:derive(0)
"""


def test_a_dirt_map_has_a_layer_of_its_own_and_multiplies_the_color(extension, add, tmp_path):
    for name, color in (("brick", (0.8, 0.4, 0.3)), ("stain", (0.5, 0.5, 0.5))):
        image = bpy.data.images.new(name, 4, 4)
        image.pixels[:] = [*color, 1.0] * 16
        image.filepath_raw, image.file_format = str(tmp_path / f"{name}.png"), "PNG"
        image.save()
    dirt = 'dirt = "stain.png", dirt_size = { 6, 3 }, dirt_set = "stain",'
    model, path = add(STAINED.replace("DIRT", f'texture = "brick.png", texture_size = {{ 2, 2 }}, {dirt}'))

    def looks():
        (item,) = model.all_objects
        tree = item.material_slots[0].material.node_tree
        surface = next(node for node in tree.nodes if node.type == "BSDF_PRINCIPLED")
        return item.data.uv_layers, surface.inputs["Base Color"]

    layers, color = looks()
    assert layers.keys() == ["UVMap", "Dirt"]
    uvs = [np.array([tuple(it.vector) for it in layer.uv]) for layer in layers]
    assert np.ptp(uvs[0], axis=0) == pytest.approx([6, 3]) and np.ptp(uvs[1], axis=0) == pytest.approx([6, 3])
    mix = color.links[0].from_node
    assert (mix.type, mix.blend_type, mix.data_type) == ("MIX", "MULTIPLY", "RGBA")
    sources = {it.identifier: it.links[0].from_node for it in mix.inputs if it.links}
    assert {key: Path(it.image.filepath).stem for key, it in sources.items()} == {"A_Color": "brick", "B_Color": "stain"}
    mapping = sources["B_Color"].inputs["Vector"].links[0].from_node
    assert mapping.inputs["Vector"].links[0].from_node.uv_map == "Dirt"
    assert tuple(mapping.inputs["Scale"].default_value) == pytest.approx((1 / 6, 1 / 3, 1))

    # Without a texture, the colour of the material is multiplied.
    path.write_text(STAINED.replace("DIRT", f'color = "#ff0000", {dirt}'), encoding="utf-8")
    assert bpy.ops.burgeon.run() == {"FINISHED"}
    mix = looks()[1].links[0].from_node
    base = next(it for it in mix.inputs if it.identifier == "A_Color")
    assert tuple(base.default_value)[:3] == pytest.approx((1, 0, 0)) and not base.links

    path.write_text(STAINED.replace("DIRT", 'texture = "brick.png",'), encoding="utf-8")
    assert bpy.ops.burgeon.run() == {"FINISHED"}
    layers, color = looks()
    assert layers.keys() == ["UVMap"] and color.links[0].from_node.type == "TEX_IMAGE"


def pulse_until_done(extension, limit=30):
    end = time.monotonic() + limit
    while extension.work._jobs or extension.work._waiting:
        assert time.monotonic() < end
        extension.work.pulse()
        time.sleep(0.01)


@pytest.fixture
def windowed(extension, monkeypatch):
    """Runs scripts in threads, as with a window; tests call ``pulse`` in the place of Blender."""
    monkeypatch.setattr(extension.work, "has_no_window", lambda: False)


SLOW = TOWER + "local sum = 0 for i = 1, 30000000 do sum += i % 7 end"


def test_a_file_that_is_saved_during_a_run_is_whole_and_the_run_goes_on(extension, windowed, add, tmp_path):
    model, _ = add(SLOW)
    extension.work.pulse()
    assert extension.work.is_running(model)
    file = str(tmp_path / "during.blend")
    assert bpy.ops.wm.save_as_mainfile(filepath=file) == {"FINISHED"}
    assert extension.work.is_running(model) and len(model.all_objects) == 0
    pulse_until_done(extension)
    assert (model.burgeon.error, height(model)) == ("", pytest.approx(12, abs=1e-4))
    bpy.ops.wm.open_mainfile(filepath=file)
    model = bpy.data.collections["model"]
    assert len(model.all_objects) == 0 and not extension.work.is_running(model)
    assert bpy.ops.burgeon.run() == {"FINISHED"}
    pulse_until_done(extension)
    assert height(model) == pytest.approx(12, abs=1e-4)


def test_a_run_ends_with_the_file_that_asked_for_it(extension, windowed, add, tmp_path):
    model, _ = add(TOWER)
    pulse_until_done(extension)
    file = str(tmp_path / "before.blend")
    bpy.ops.wm.save_as_mainfile(filepath=file)
    values, keys = values_of(extension, model)
    setattr(values, keys["floors"], 30)
    extension.work.pulse()
    assert extension.work.is_running(model)
    bpy.ops.wm.open_mainfile(filepath=file)
    pulse_until_done(extension)
    assert height(bpy.data.collections["model"]) == pytest.approx(12, abs=1e-4)


def test_sliders_moved_during_a_run_end_at_the_last_value(extension, windowed, add):
    model, _ = add(SLOW)
    pulse_until_done(extension)
    values, keys = values_of(extension, model)
    for floors in (20, 30, 40):
        setattr(values, keys["floors"], floors)
        extension.work.pulse()
    pulse_until_done(extension)
    assert height(model) == pytest.approx(40, abs=1e-4)


HOUSES = """
local Walls = module("Walls", "height")
local plots = {
  { id = "mill", levels = 2, name = "Mühle", outline = { { 0, 0 }, { 12, 0 }, { 12, 8 }, { 0, 8 } } },
  { id = "barn", levels = 1, name = "Barn", outline = { { 20, 0 }, { 30, 0 }, { 30, 15 }, { 20, 15 } } },
}
local houses = lsystem({ object = footprint })
houses:axiom(source(plots), function(feature)
  return footprint(feature.outline), Walls(3 * feature.levels)
end)
houses:interpret("Walls(height)", function(this, height) this:walls({ height = height }) end)
houses:derive()
"""


def test_features_become_collections_with_their_attributes(extension, add):
    model, _ = add(HOUSES)
    assert model.burgeon.error == ""
    assert sorted(it.name for it in model.children) == ["barn", "mill"]
    mill = model.children["mill"]
    assert (mill["levels"], mill["name"]) == (2, "Mühle")
    assert len(mill.objects) > 0
    assert all(slot.material.name for item in mill.objects for slot in item.material_slots)


def test_a_removed_model_leaves_nothing(extension, add):
    add(TOWER)
    assert bpy.ops.burgeon.remove() == {"FINISHED"}
    assert (len(bpy.data.objects), len(bpy.data.meshes), len(bpy.data.collections)) == (0, 0, 0)


def test_normals_and_triangles_are_those_of_the_model(extension, add):
    model, path = add(TOWER)
    made = burgeon.run(path, print=None)
    item = next(iter(model.all_objects))
    part = made.meshes[0].parts[0]
    normals = np.empty(3 * len(item.data.loops), np.float32)
    item.data.corner_normals.foreach_get("vector", normals)
    expected = part.normals[part.triangles.ravel()]
    assert np.abs(normals.reshape(-1, 3) - expected).max() < 0.02
    assert sum(len(it.data.polygons) for it in model.all_objects) == made.triangle_count


def test_a_million_triangles_take_seconds(extension, add):
    text = """
    local s = lsystem({ object = extruder({ sides = 1000 }) })
    local Ring = module("Ring")
    s:axiom(sequence((function() local all = {} for i = 1, 500 do all[i] = Ring() end return all end)()))
    s:interpret("Ring", function(this) this:extrude(0.1) end)
    s:derive(0)
    """
    begun = time.perf_counter()
    model, path = add(text)
    took = time.perf_counter() - begun
    assert model.burgeon.error == ""
    count = sum(len(item.data.polygons) for item in model.all_objects)
    print(f"{count:,} triangles: {took:.2f} s with the run")
    assert count > 990_000
