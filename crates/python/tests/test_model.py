"""Models: arrays, files, features and layers."""

import gc
import json
import subprocess
import sys
import time

import numpy
import pytest

import burgeon

LAYERS = """
local Lot = module("Lot", "shape", "use")
local lots = lsystem({})
lots:axiom(source("plots"), function(feature) return Lot(feature.geometry, feature.use) end)
lots:derive(0)
"""


#: 131,072 posts of 12 triangles.
POSTS = """
local Post = module("Post", "n")
local posts = lsystem({ object = extruder({ sides = 4 }) })
posts:axiom(Post(17))
posts:rule("Post(n)", function(this, n)
  if n > 0 then
    return Post(n - 1), Post(n - 1)
  end
end)
posts:interpret("Post(n)", function(this, n) this:scale(0.1):extrude(1.2):shift(2, 0) end)
posts:derive(17)
"""


def plots():
    def square(x):
        return {"type": "Polygon", "coordinates": [[[x, 0], [x + 8, 0], [x + 8, 8], [x, 8], [x, 0]]]}

    rows = [{"id": str(x), "use": "shop" if x else 'home "🏡"', "geometry": square(x)} for x in (0, 10)]
    return burgeon.Table(rows, crs=25832)


def test_arrays_are_the_memory_of_the_model_and_outlive_it(tower):
    model = burgeon.run(tower, values={"floors": 3})
    part = model.meshes[0].parts[0]
    raw = part._raw.positions(*part._place)
    address = raw.__array_interface__["data"][0]
    assert part.positions.__array_interface__["data"][0] == address
    assert not part.positions.flags.writeable and part.positions.shape == (part.vertex_count, 3)
    kept = part.positions
    before = kept.copy()
    del model, part, raw
    gc.collect()
    burgeon.run(tower, values={"floors": 3}, seed=8)
    assert (kept == before).all()


def test_triangles_have_corners_and_outward_normals(tower):
    model = burgeon.run(tower, values={"floors": 3})
    triangles = 0
    for mesh in model.meshes:
        for part in mesh.parts:
            assert part.triangles.max() < part.vertex_count and part.triangles.shape == (part.triangle_count, 3)
            assert numpy.allclose(numpy.linalg.norm(part.normals, axis=1), 1, atol=1e-5)
            a, b, c = (part.positions[part.triangles[:, corner]].astype(float) for corner in range(3))
            across = numpy.cross(b - a, c - a)
            assert (numpy.einsum("ij,ij->i", across, part.normals[part.triangles[:, 0]]) > 0).mean() > 0.95
            assert part.uvs.shape == (part.vertex_count, 2)
    for instance in model.instances:
        triangles += sum(part.triangle_count for part in instance.mesh.parts)
    assert triangles == model.triangle_count > 100


def test_bounds_are_those_of_the_placed_corners(tower):
    model = burgeon.run(tower, values={"floors": 3})
    corners = [
        part.positions @ instance.transform[:3, :3].T + instance.transform[:3, 3]
        for instance in model.instances
        for part in instance.mesh.parts
    ]
    corners = numpy.concatenate(corners)
    assert numpy.allclose([corners.min(axis=0), corners.max(axis=0)], model.bounds, atol=1e-4)


def test_the_same_seed_gives_the_same_bytes_for_any_number_of_threads(root):
    script = root / "scripts" / "bush.lua"
    one, two = (burgeon.run(script, seed=3, threads=threads).to_bytes("glb") for threads in (1, 2))
    assert one == two != burgeon.run(script, seed=4).to_bytes("glb")


def test_every_format_of_drawings_can_be_saved(tower, tmp_path):
    model = burgeon.run(tower, values={"floors": 2})
    count = 0
    for format in burgeon.formats():
        if format.layers:
            continue
        path = tmp_path / f"it's \"a\" 🌳.{format.extension}"
        settings = {"width": 40, "height": 30} if format.extension == "png" else {}
        model.save(path, **settings)
        # A table without reports has only its head.
        assert path.stat().st_size > 14, format
        count += 1
    assert count > 8


def test_a_refused_file_stays_as_it_was(tower, tmp_path):
    model = burgeon.run(tower, values={"floors": 2})
    with pytest.raises(ValueError, match="several files"):
        model.to_bytes("obj")
    path = tmp_path / "a.png"
    path.write_text("old")
    for settings in ({"width": 0}, {"widht": 3}):
        with pytest.raises(burgeon.Error):
            model.save(path, **settings)
    with pytest.raises(burgeon.Error, match="unknown file extension") as caught:
        model.save(tmp_path / "a.gld")
    assert ".glb" in caught.value.remedy
    assert path.read_text() == "old"


def test_features_are_rows_and_layers_are_files():
    model = burgeon.run("lots.lua", loader={"lots.lua": LAYERS}, sources={"plots": plots()})
    assert [(row["id"], row["use"]) for row in model.features] == [("0", 'home "🏡"'), ("10", "shop")]
    assert [(layer.name, layer.count) for layer in model.layers] == [("Lot", 2)]
    content = json.loads(model.geojson("Lot"))
    assert [feature["properties"]["use"] for feature in content["features"]] == ['home "🏡"', "shop"]
    assert model.geopackage().startswith(b"SQLite format 3")
    with pytest.raises(burgeon.Error) as caught:
        model.geojson("Lott")
    assert "Lot" in caught.value.remedy


def test_a_model_without_layers_says_so(tower):
    model = burgeon.run(tower, values={"floors": 2})
    with pytest.warns(burgeon.BurgeonWarning, match="no layers"):
        model.geojson()


def test_trimesh_gets_the_same_triangles_and_bounds(tower):
    pytest.importorskip("trimesh")
    model = burgeon.run(tower, values={"floors": 3})
    scene = model.to_trimesh()
    assert len(scene.to_geometry().faces) == model.triangle_count
    assert numpy.allclose(scene.bounds, model.bounds, atol=1e-4)


def test_a_notebook_shows_a_model(tower):
    shown = burgeon.run(tower, values={"floors": 2})._repr_html_()
    assert shown.startswith(("<img src=\"data:image/png;base64,", "<iframe srcdoc=\"")) and len(shown) > 2000


def test_without_numpy_arrays_are_views_of_copies(tower):
    code = f"""
import sys
sys.modules["numpy"] = None
import burgeon
part = burgeon.run({str(tower)!r}, values={{"floors": 2}}).meshes[0].parts[0]
assert part.positions.shape == (part.vertex_count, 3) and part.positions.format == "f"
assert part.triangles.tolist()[0][0] < part.vertex_count
"""
    subprocess.run([sys.executable, "-c", code], check=True)


def test_a_million_triangles_reach_numpy_at_once():
    model = burgeon.run("posts.lua", loader={"posts.lua": POSTS})
    assert model.triangle_count > 1_000_000
    begin = time.perf_counter()
    count = sum(len(part.positions) for mesh in model.meshes for part in mesh.parts)
    assert time.perf_counter() - begin < 0.5 and count > 500_000


LOTS = """
local height = param("height", { default = 3 })
local lots = lsystem({ object = footprint })
local House = module("House", "height")
lots:axiom(source("plots"), function(feature)
  return footprint(feature.geometry, { color = if feature.use == "shop" then "red" else "white" }), House(if feature.use == "shop" then height else 3)
end)
lots:interpret("House(height)", function(this, height) this:walls({ height = height }):roof({ kind = "flat" }) end)
lots:derive(0)
"""


def test_a_difference_lists_features_materials_numbers_and_bounds():
    def model(**values):
        return burgeon.run("lots.lua", loader={"lots.lua": LOTS}, sources={"plots": plots()}, values=values)

    before, after = model(), model(height=6)
    assert not before.difference(model())
    found = before.difference(after)
    assert found and [feature.id for feature in found.changed] == ["10"]
    assert (found.added, found.removed, found.unchanged, found.others_changed) == ([], [], 1, False)
    assert found.counts.before.triangles == before.triangle_count
    assert found.bounds.after[1][2] - found.bounds.before[1][2] == pytest.approx(3)
    with pytest.raises(TypeError, match="not int"):
        before.difference(3)


def test_a_loader_function_can_list_names():
    files = {
        "use.lua": 'print(require("@castle/size"))',
        "mods/castle/mod.toml": 'name = "castle"\nversion = "1.0.0"\napi = "1.0"\n',
        "mods/castle/size.lua": "return 7",
    }

    def load(name):
        return files.get(name)

    with pytest.raises(burgeon.Error, match="castle"):
        burgeon.run("use.lua", loader=load)
    load.names = list(files)
    printed = []
    burgeon.run("use.lua", loader=load, print=printed.append)
    assert "".join(printed).strip() == "7"
