"""Scripts and assets from memory, and tables as sources."""

import struct

import pytest

import burgeon
from burgeon._wkb import geometry_of_wkb
from conftest import FENCE

HOUSES = """
local Walls = module("Walls", "height")
local houses = lsystem({ object = footprint })
houses:axiom(source("plots"), function(feature)
  return footprint(feature.geometry), Walls(feature.height)
end)
houses:interpret("Walls(height)", function(this, height) this:walls({ height = height }) end)
houses:derive(0)
"""

PNG = bytes.fromhex(
    "89504e470d0a1a0a0000000d49484452000000010000000108060000001f15c489"
    "0000000d49444154789c63f8cfc0f01f00050001ff89993d1d0000000049454e44ae426082"
)


def square(x):
    return [[x, 0.0], [x + 8.0, 0.0], [x + 8.0, 8.0], [x, 8.0], [x, 0.0]]


def wkb(x, srid=None):
    code = 3 | (0x20000000 if srid else 0)
    head = struct.pack("<BI", 1, code) + (struct.pack("<I", srid) if srid else b"")
    return head + struct.pack("<II", 1, 5) + b"".join(struct.pack("<2d", *corner) for corner in square(x))


def built(rows, **options):
    table = burgeon.Table(rows, crs=25832, **options)
    model = burgeon.run("h.lua", loader={"h.lua": HOUSES}, sources={"plots": table})
    return model.to_bytes("glb"), [row["height"] for row in model.features]


def test_geojson_wkb_hex_and_objects_give_the_same_model():
    class Shape:
        def __init__(self, x):
            self.__geo_interface__ = {"type": "Polygon", "coordinates": (tuple(map(tuple, square(x))),)}

    forms = [
        lambda x: {"type": "Polygon", "coordinates": [square(x)]},
        wkb,
        lambda x: wkb(x, 25832).hex(),
        lambda x: memoryview(wkb(x)),
        Shape,
    ]
    made = [built([{"id": x, "height": 3 + x, "geometry": form(x)} for x in (0, 10)]) for form in forms]
    assert made[0][1] == [3, 13] and len(made[0][0]) > 200
    assert all(it == made[0] for it in made)


def test_data_frames_and_other_columns_are_read():
    pandas = pytest.importorskip("pandas")
    frame = pandas.DataFrame({"id": ["a", "b"], "height": [3, 4.5], "geom": [wkb(0), wkb(10)]})
    frame["built"] = pandas.to_datetime(["1900-01-01", None])
    content, heights = built(frame, geometry="geom")
    assert heights == [3, 4.5] and content


@pytest.mark.parametrize(
    "rows",
    [
        [{"height": 3, "geometry": b"\x01\x03"}],
        [{"height": 3, "geometry": wkb(0) + b"x"}],
        [{"height": 3, "geometry": b"\x07" + wkb(0)[1:]}],
        [{"height": 3, "geometry": struct.pack("<BII", 1, 2, 2**31)}],
        [{"height": 3, "geometry": "no hex"}],
        [{"height": 3, "geometry": 4}],
        ["text"],
        "text",
        3,
    ],
)
def test_rows_that_are_no_table_are_refused(rows):
    with pytest.raises((TypeError, ValueError)):
        built(rows)


def test_wkb_has_points_collections_heights_and_both_orders():
    point = struct.pack(">BI3d", 0, 1001, 1, 2, 3)
    assert geometry_of_wkb(point) == {"type": "Point", "coordinates": [1, 2, 3]}
    measured = struct.pack("<BI3d", 1, 2001, 1, 2, 9)
    assert geometry_of_wkb(measured) == {"type": "Point", "coordinates": [1, 2]}
    several = struct.pack("<BII", 1, 4, 2) + struct.pack("<BI2d", 1, 1, 1, 2) * 2
    assert geometry_of_wkb(several) == {"type": "MultiPoint", "coordinates": [[1, 2], [1, 2]]}
    both = struct.pack("<BII", 1, 7, 1) + several
    assert geometry_of_wkb(both)["geometries"] == [{"type": "MultiPoint", "coordinates": [[1, 2], [1, 2]]}]
    with pytest.raises(ValueError, match="collections"):
        geometry_of_wkb(struct.pack("<BII", 1, 7, 1) * 100 + point)


def test_scripts_data_and_textures_come_from_memory():
    script = """
    local height = require("parts/height")
    local Slab = module("Slab")
    local tower = lsystem({ object = extruder({ sides = 4 }) })
    tower:axiom(Slab())
    tower:interpret("Slab", function(this)
      this:material({ texture = "textures/it's 🌳.png" }):extrude(height)
    end)
    tower:derive(0)
    """
    files = {"s.lua": script, "parts/height.lua": "return 3", "textures/it's 🌳.png": PNG}
    asked = []

    def load(name):
        asked.append(name)
        return files.get(name)

    from_files, from_function = burgeon.run("s.lua", loader=files), burgeon.run("s.lua", loader=load)
    content = from_files.to_bytes("glb")
    assert content == from_function.to_bytes("glb") and PNG in content
    assert len(asked) == len(set(asked)) and {"s.lua", "parts/height.lua", "textures/it's 🌳.png"} <= set(asked)


def test_errors_name_files_in_memory_as_the_loader_does():
    with pytest.raises(burgeon.Error) as caught:
        burgeon.run("s.lua", loader={"s.lua": "require('parts/a')", "parts/a.lua": "\nerror('no')"})
    assert (caught.value.file, caught.value.line) == ("parts/a.lua", 2)
    with pytest.raises(burgeon.Error, match="script not found: s.lua"):
        burgeon.run("s.lua", loader={})
    with pytest.raises(burgeon.Error, match="not a name of a file"):
        burgeon.run("../s.lua", loader={"s.lua": FENCE})


@pytest.mark.parametrize("loader", [3, ["s.lua"], {"s.lua": 3}, {3: "s"}])
def test_loaders_of_other_types_are_refused(loader):
    with pytest.raises(TypeError):
        burgeon.run("s.lua", loader=loader)


def test_nothing_is_left_in_the_temporary_folder(tmp_path, monkeypatch):
    monkeypatch.setenv("TMPDIR", str(tmp_path))
    model = burgeon.run("s.lua", loader={"s.lua": FENCE})
    assert len(list(tmp_path.iterdir())) == 1
    del model
    assert list(tmp_path.iterdir()) == []
