"""Reads files of Burgeon with other programs and compares triangles, volume and bounds.

    python3 tests/clients.py BURGEON

Needs numpy; programs that are not installed are skipped with a message: trimesh (with lxml and networkx), assimp-py,
lib3mf, usd-core and ezdxf. Volumes are sums over signed tetrahedra, which are also defined for open surfaces.
"""

import json
import pathlib
import subprocess
import sys
import tempfile

import numpy

ROOT = pathlib.Path(__file__).resolve().parent.parent

# Name, script, further arguments.
MODELS = [
    ("tower", "scripts/tower.lua", []),
    ("town", "scripts/town.lua", ["--data", "examples/data", "--part", "2/10"]),
    ("sponge", "tests/clients/menger.lua", []),
    ("bush", "scripts/bush.lua", []),
]

# Relative errors of the volume and of the bounds that formats cause by rounding.
VOLUME, BOUNDS = 1e-4, 1e-4

# Relative error of the volume of a file with integers. Its meshes are rounded to 1/65,535 of their size.
INTEGERS = 1e-3


def y_up(triangles):
    """Converts triangles from y up to z up."""
    x, y, z = numpy.moveaxis(triangles, -1, 0)
    return numpy.stack([x, -z, y], axis=-1)


def affine(triangles, matrix):
    """Applies a 4 by 4 matrix of column vectors."""
    return triangles @ matrix[:3, :3].T + matrix[:3, 3]


def read_trimesh(path):
    import trimesh

    scene = trimesh.load(path, process=False)
    mesh = scene.to_mesh() if isinstance(scene, trimesh.Scene) else scene
    return numpy.asarray(mesh.triangles, dtype=float)


def read_assimp(path):
    import assimp_py

    flags = assimp_py.Process_Triangulate | assimp_py.Process_PreTransformVertices
    scene = assimp_py.import_file(str(path), flags)
    parts = []
    for mesh in scene.meshes:
        points = numpy.asarray(mesh.vertices, dtype=float).reshape(-1, 3)
        parts.append(points[numpy.asarray(mesh.indices).reshape(-1, 3)])
    return numpy.concatenate(parts)


def read_lib3mf(path):
    import lib3mf

    model = lib3mf.get_wrapper().CreateModel()
    reader = model.QueryReader("3mf")
    reader.SetStrictModeActive(True)
    reader.ReadFromFile(str(path))
    if reader.GetWarningCount():
        raise AssertionError(f"lib3mf warns: {reader.GetWarning(0)}")
    meshes = {}

    def matrix(transform):
        fields = numpy.array([list(column) for column in transform.Fields], dtype=float)
        result = numpy.eye(4)
        result[:3, :] = fields.T
        return result

    def triangles(item, place):
        if item.IsComponentsObject():
            for index in range(item.GetComponentCount()):
                component = item.GetComponent(index)
                inner = matrix(component.GetTransform()) if component.HasTransform() else numpy.eye(4)
                yield from triangles(component.GetObjectResource(), place @ inner)
            return
        key = item.GetResourceID()
        if key not in meshes:
            points = numpy.array([list(vertex.Coordinates) for vertex in item.GetVertices()], dtype=float)
            faces = numpy.array([list(face.Indices) for face in item.GetTriangleIndices()])
            meshes[key] = points[faces]
        yield affine(meshes[key], place)

    parts = []
    items = model.GetBuildItems()
    while items.MoveNext():
        item = items.GetCurrent()
        place = matrix(item.GetObjectTransform()) if item.HasObjectTransform() else numpy.eye(4)
        parts.extend(triangles(item.GetObjectResource(), place))
    return numpy.concatenate(parts)


def read_usd(path):
    from pxr import Usd, UsdGeom, UsdShade

    stage = Usd.Stage.Open(str(path))
    if UsdGeom.GetStageMetersPerUnit(stage) != 1 or UsdGeom.GetStageUpAxis(stage) != "Z":
        raise AssertionError("wrong unit or up axis")
    cache = UsdGeom.XformCache()
    parts = []

    def matrix(transform):
        return numpy.array(transform, dtype=float).T

    def mesh(prim):
        geometry = UsdGeom.Mesh(prim)
        points = numpy.array(geometry.GetPointsAttr().Get(), dtype=float)
        faces = numpy.array(geometry.GetFaceVertexIndicesAttr().Get()).reshape(-1, 3)
        material, _ = UsdShade.MaterialBindingAPI(prim).ComputeBoundMaterial()
        if not material:
            raise AssertionError(f"{prim.GetPath()} has no material")
        return points[faces]

    def below(prim):
        return Usd.PrimRange(prim, Usd.TraverseInstanceProxies())

    prims = iter(below(stage.GetDefaultPrim()))
    for prim in prims:
        if prim.IsA(UsdGeom.PointInstancer):
            prims.PruneChildren()
            instancer = UsdGeom.PointInstancer(prim)
            places = instancer.ComputeInstanceTransformsAtTime(Usd.TimeCode.Default(), Usd.TimeCode.Default())
            world = matrix(cache.GetLocalToWorldTransform(prim))
            root = stage.GetPrimAtPath(instancer.GetPrototypesRel().GetTargets()[0])
            inverse = numpy.linalg.inv(matrix(cache.GetLocalToWorldTransform(root)))
            inner = [
                affine(mesh(child), inverse @ matrix(cache.GetLocalToWorldTransform(child)))
                for child in below(root)
                if child.IsA(UsdGeom.Mesh)
            ]
            for place in places:
                total = world @ matrix(place)
                turned = numpy.linalg.det(total[:3, :3]) < 0
                for triangles in inner:
                    placed = affine(triangles, total)
                    parts.append(placed[:, ::-1] if turned else placed)
        elif prim.IsA(UsdGeom.Mesh):
            total = matrix(cache.GetLocalToWorldTransform(prim))
            placed = affine(mesh(prim), total)
            parts.append(placed[:, ::-1] if numpy.linalg.det(total[:3, :3]) < 0 else placed)
    return numpy.concatenate(parts)


# Extension, arguments, program, function, factor to metres, y up.
CLIENTS = [
    ("glb", ["--instances", "nodes"], "trimesh", read_trimesh, 1, True),
    ("glb", ["--instances", "expanded"], "trimesh", read_trimesh, 1, True),
    ("glb", ["--instances", "nodes", "--quantize"], "trimesh", read_trimesh, 1, True),
    ("glb", ["--instances", "nodes"], "assimp_py", read_assimp, 1, True),
    ("glb", ["--instances", "expanded"], "assimp_py", read_assimp, 1, True),
    ("obj", [], "trimesh", read_trimesh, 1, True),
    ("obj", [], "assimp_py", read_assimp, 1, True),
    ("stl", [], "trimesh", read_trimesh, 1e-3, False),
    ("stl", [], "assimp_py", read_assimp, 1e-3, False),
    ("ply", [], "trimesh", read_trimesh, 1, False),
    ("ply", [], "assimp_py", read_assimp, 1, False),
    ("3mf", [], "trimesh", read_trimesh, 1e-3, False),
    ("3mf", [], "lib3mf", read_lib3mf, 1e-3, False),
    ("usda", [], "pxr", read_usd, 1, False),
]


def measures(triangles):
    a, b, c = triangles[:, 0], triangles[:, 1], triangles[:, 2]
    volume = float(numpy.einsum("ij,ij->i", a, numpy.cross(b, c)).sum() / 6)
    points = triangles.reshape(-1, 3)
    return len(triangles), volume, points.min(axis=0), points.max(axis=0)


def is_installed(module):
    import importlib.util

    return importlib.util.find_spec(module) is not None


def run(burgeon, script, arguments, output):
    command = [burgeon, "run", script, "--json", *arguments, "-o", str(output)]
    done = subprocess.run(command, cwd=ROOT, capture_output=True, text=True)
    if done.returncode != 0:
        raise AssertionError(f"{' '.join(command)}: {done.stdout}{done.stderr}")
    return json.loads(done.stdout)


def compare(burgeon, folder):
    """Compares all models in all formats. Returns the numbers of passed, failed and skipped comparisons."""
    passed = failed = skipped = 0
    print("| model | file | program | triangles | volume (m³) | size (m) | result |")
    print("| --- | --- | --- | --- | --- | --- | --- |")
    for name, script, arguments in MODELS:
        expected = None
        written = {}
        for extension, options, module, read, factor, is_y_up in CLIENTS:
            label = " ".join([f".{extension}", *options])
            if not is_installed(module):
                print(f"| {name} | {label} | {module} | | | | skipped: {module} is not installed |")
                skipped += 1
                continue
            if label not in written:
                path = folder / f"{name}{''.join(options)}.{extension}"
                written[label] = (path, run(burgeon, script, arguments + options, path)["triangles"])
            path, count = written[label]
            try:
                triangles = read(path)
                found = measures((y_up(triangles) if is_y_up else triangles) * factor)
                size = found[3] - found[2]
                expected = expected or found
                faults = []
                if found[0] != count:
                    faults.append(f"{count} triangles expected")
                volume = INTEGERS if "--quantize" in options else VOLUME
                if abs(found[1] - expected[1]) > volume * max(abs(expected[1]), 1e-9):
                    faults.append(f"{expected[1]:.4f} m³ expected")
                extent = numpy.abs(expected[3] - expected[2]).max()
                if max(numpy.abs(found[side] - expected[side]).max() for side in (2, 3)) > BOUNDS * extent:
                    faults.append(f"{expected[2]} to {expected[3]} expected, not {found[2]} to {found[3]}")
                shown = " x ".join(f"{length:.2f}" for length in size)
                result = "; ".join(faults) or "equal"
                print(f"| {name} | {label} | {module} | {found[0]:,} | {found[1]:.3f} | {shown} | {result} |")
            except Exception as error:
                faults = [f"{type(error).__name__}: {error}"]
                print(f"| {name} | {label} | {module} | | | | {faults[0]} |")
            failed += bool(faults)
            passed += not faults
    return passed, failed, skipped


def check_drawing(burgeon, folder):
    """Reads a drawing with ezdxf: layers, closed polylines with their areas, and no errors of the audit."""
    if not is_installed("ezdxf"):
        print("skipped: ezdxf is not installed")
        return 0, 0, 1
    import ezdxf
    from ezdxf.math import area

    path = folder / "lots.dxf"
    run(burgeon, "tests/clients/lots.lua", [], path)
    drawing = ezdxf.readfile(path)
    errors = [error.message for error in drawing.audit().errors]
    found = {}
    for entity in drawing.modelspace():
        if entity.dxftype() == "POLYLINE":
            value = round(abs(area(entity.points())), 6) if entity.is_closed else 0
        else:
            value = tuple(entity.dxf.location)
        found.setdefault(entity.dxf.layer, []).append(value)
    expected = {"LOT": [500, 500], "STREET": [0], "WELL": [(5, 5, 0)]}
    is_equal = found == expected and not errors
    print(f"lots.dxf in ezdxf: {found}{'' if is_equal else f', expected {expected}, errors {errors}'}")
    return int(is_equal), int(not is_equal), 0


def main():
    with tempfile.TemporaryDirectory() as folder:
        folder = pathlib.Path(folder)
        counts = [compare(sys.argv[1], folder), check_drawing(sys.argv[1], folder)]
    passed, failed, skipped = map(sum, zip(*counts))
    print(f"{passed} passed, {failed} failed, {skipped} skipped")
    return 1 if failed or not passed else 0


if __name__ == "__main__":
    sys.exit(main())
