"""Models: results of runs."""

from __future__ import annotations

import json
import os
import tempfile
from dataclasses import dataclass
from functools import cached_property
from typing import TYPE_CHECKING, Any

from . import _burgeon
from ._arguments import PathLike
from ._difference import ModelDifference, difference_of
from ._display import html_of
from ._errors import BurgeonWarning, show

if TYPE_CHECKING:
    import numpy
    import trimesh


def as_array(buffer: _burgeon.Buffer) -> Any:
    """Returns a NumPy array in the memory of a buffer. Without NumPy, returns a copy as a ``memoryview``."""
    try:
        import numpy
    except ImportError:
        form: Any = {"f4": "f", "f8": "d", "u4": "I"}[buffer.typestr[1:]]
        view = memoryview(buffer.tobytes())
        # A view of several dimensions cannot be empty.
        return view.cast(form, buffer.shape) if len(buffer) else view.cast(form)
    return numpy.asarray(buffer)


@dataclass(frozen=True)
class Format:
    """A format of files."""

    #: Extension without the dot.
    extension: str
    #: Name for users.
    title: str
    #: Set if it describes layers with geometries, not the drawing.
    layers: bool
    #: ``one``, or ``several`` if more files can be written next to it.
    files: str


def formats() -> list[Format]:
    """Returns the formats that ``Model.save`` writes."""
    return [Format(**fields) for fields in json.loads(_burgeon.formats())]


@dataclass(frozen=True)
class Material:
    """A metallic-roughness material; colours are linear, from 0 to 1."""

    name: str
    #: Red, green, blue and opacity.
    color: tuple[float, float, float, float]
    metallic: float
    roughness: float
    #: Red, green and blue of the light that the surface emits.
    emissive: tuple[float, float, float]
    #: Set if both sides are visible.
    double_sided: bool
    #: Path of the texture, if there is one.
    texture: str | None
    #: Width and height (m) of one repetition of the texture and of the normal map.
    texture_size: list[float] | None
    #: Path of the normal map, if there is one.
    normal_map: str | None
    #: Factor of the slopes of the normal map.
    normal_scale: float
    #: Path of the dirt map, by which the colour is multiplied, if there is one.
    dirt_map: str | None
    #: Width and height (m) of one repetition of the dirt map.
    dirt_size: list[float] | None


@dataclass(frozen=True)
class Layer:
    """A table of geometries and attributes."""

    name: str
    columns: tuple[str, ...]
    #: Number of rows.
    count: int


class Part:
    """The triangles of a mesh that have one material.

    Arrays are read-only, in the coordinates of the mesh (m), z up. ``positions`` and ``uvs`` are in the memory of the
    model; the model stores ``normals`` and ``triangles`` in a shorter form, which is expanded once.
    """

    def __init__(self, model: Model, mesh: int, part: int, facts: dict[str, Any]) -> None:
        self._raw = model._raw
        self._place = (mesh, part)
        #: Material.
        self.material: Material = model.materials[facts["material"]]
        #: Number of corners.
        self.vertex_count: int = facts["vertices"]
        #: Number of triangles.
        self.triangle_count: int = facts["triangles"]

    @cached_property
    def positions(self) -> numpy.ndarray:
        """Points (m), of the shape (n, 3)."""
        return as_array(self._raw.positions(*self._place))

    @cached_property
    def normals(self) -> numpy.ndarray:
        """Unit vectors, of the shape (n, 3)."""
        return as_array(self._raw.normals(*self._place))

    @cached_property
    def uvs(self) -> numpy.ndarray:
        """Texture coordinates (m), of the shape (n, 2)."""
        return as_array(self._raw.uvs(*self._place))

    @cached_property
    def second_uvs(self) -> numpy.ndarray:
        """Texture coordinates (m) of the dirt map, of the shape (n, 2); those of the texture unless it has its own."""
        return as_array(self._raw.second_uvs(*self._place))

    @cached_property
    def triangles(self) -> numpy.ndarray:
        """Corners of the triangles, of the shape (n, 3), counter-clockwise seen from outside."""
        return as_array(self._raw.triangles(*self._place))

    def __repr__(self) -> str:
        return f"<burgeon.Part: {self.triangle_count:,} triangles of {self.material.name or 'a material'}>"


class Mesh:
    """A shape in its own coordinates, which instances place."""

    def __init__(self, model: Model, mesh: int, facts: dict[str, Any]) -> None:
        #: Name for display; may repeat, may be empty.
        self.name: str = facts["name"]
        #: Parts, one for each material.
        self.parts: list[Part] = [Part(model, mesh, part, it) for part, it in enumerate(facts["parts"])]

    def __repr__(self) -> str:
        return f"<burgeon.Mesh {self.name!r}: {len(self.parts)} parts>"


@dataclass(frozen=True)
class Instance:
    """A placed mesh."""

    mesh: Mesh
    #: Name for display; may repeat, may be empty.
    name: str
    #: Id of the feature that it was made from, if any.
    feature: str | None
    #: Matrix of the shape (4, 4) from the coordinates of the mesh to the world (m).
    transform: numpy.ndarray


class Model:
    """The result of a run. Coordinates are in metres, z up."""

    def __init__(self, raw: _burgeon.ScriptModel) -> None:
        self._raw = raw
        self._facts: dict[str, Any] = json.loads(raw.facts())
        #: Warnings of the run.
        self.warnings: list[BurgeonWarning] = [BurgeonWarning._of(it) for it in self._facts["warnings"]]

    @property
    def script(self) -> str:
        """Path or name of the script."""
        return self._facts["script"]

    @property
    def seed(self) -> int:
        """Seed of the run."""
        return self._facts["seed"]

    @property
    def values(self) -> dict[str, Any]:
        """Values of the parameters in this run."""
        return self._facts["values"]

    @property
    def triangle_count(self) -> int:
        """Number of triangles of all instances."""
        return self._facts["triangles"]

    @property
    def module_count(self) -> int:
        """Number of modules of the final chains."""
        return self._facts["modules"]

    @property
    def steps(self) -> list[int]:
        """Number of derivation steps of each system."""
        return self._facts["steps"]

    @property
    def bounds(self) -> list[list[float]] | None:
        """Minimum and maximum corner (m) of the bounding box; ``None`` for an empty model."""
        return self._facts["bounds"]

    @property
    def notes(self) -> list[str]:
        """Remarks about the data that are not warnings."""
        return self._facts["notes"]

    @property
    def report(self) -> dict[str, Any]:
        """Numbers of features, skipped and simplified features, and the remarks about them."""
        return self._facts["report"]

    @property
    def place(self) -> dict[str, Any] | None:
        """Projection and origin on the earth, if the script read data."""
        return self._facts["place"]

    @property
    def times(self) -> dict[str, float]:
        """Time (s) of the phases of the run."""
        return self._facts["seconds"]

    @cached_property
    def materials(self) -> list[Material]:
        """Materials of the parts."""
        rows = self._facts["materials"]
        return [Material(**{**it, "color": tuple(it["color"]), "emissive": tuple(it["emissive"])}) for it in rows]

    @cached_property
    def meshes(self) -> list[Mesh]:
        """Shapes, each in its own coordinates."""
        return [Mesh(self, number, facts) for number, facts in enumerate(self._facts["meshes"])]

    @cached_property
    def transforms(self) -> numpy.ndarray:
        """Matrices of all instances, of the shape (n, 4, 4)."""
        return as_array(self._raw.transforms())

    @cached_property
    def instances(self) -> list[Instance]:
        """Placed meshes, in the order of the chains."""
        rows = json.loads(self._raw.instances())
        matrices = self.transforms if hasattr(self.transforms, "reshape") else self.transforms.tolist()
        return [
            Instance(self.meshes[mesh], name, feature, matrix)
            for (mesh, name, feature), matrix in zip(rows, matrices)
        ]

    @cached_property
    def features(self) -> list[dict[str, Any]]:
        """Rows of the features that the script has read: their attributes, with ``id``, ``system`` and ``source``."""
        found: list[dict[str, Any]] = []
        for table in json.loads(self._raw.features()):
            known = {"system": table["system"], "source": table["source"]}
            found.extend({**row["values"], **known, "id": row["id"]} for row in table["rows"])
        return found

    @cached_property
    def layers(self) -> list[Layer]:
        """Layers: lists of the script, layers of objects, and modules that have a geometry."""
        rows = json.loads(self._raw.layers())
        return [Layer(it["name"], tuple(it["columns"]), it["count"]) for it in rows]

    def difference(self, after: Model) -> ModelDifference:
        """Returns what changes from this model to ``after``, a later one: features, materials, numbers and bounds."""
        if not isinstance(after, Model):
            raise TypeError(f"difference takes a model, not {type(after).__name__}")
        return difference_of(json.loads(self._raw.difference(after._raw)), lambda fields: Material(**fields))

    def save(self, path: PathLike, *, metadata: bool = False, layer: str | None = None, recipe: bool = True, **picture: Any) -> None:
        """Writes the model in the format of the extension of ``path``; ``formats()`` lists them.

        metadata: write ids and attributes of features to glTF files.
        layer: name of the only layer to write, for formats of layers.
        recipe: write the script and its values to glTF files and pages, so that ``burgeon open`` shows them live again.
        picture: settings of a render: ``width``, ``height``, ``azimuth``, ``elevation``, ``background``, ``ground`` and
            ``quality``.

        Raises ``Error`` if the file cannot be written; it is then as before.
        """
        self._save(path, metadata, layer, recipe, picture, 3)

    def to_bytes(self, extension: str, *, metadata: bool = False, layer: str | None = None, recipe: bool = True, **picture: Any) -> bytes:
        """Returns the content of a file with this extension, such as ``glb``; other arguments are those of ``save``.

        Raises ``ValueError`` for a model that needs several files.
        """
        return self._bytes(extension, metadata, layer, recipe, picture, 3)

    def geojson(self, layer: str | None = None) -> bytes:
        """Returns the layers, or one of them, as GeoJSON."""
        return self._bytes("geojson", False, layer, False, {}, 3)

    def geopackage(self, layer: str | None = None) -> bytes:
        """Returns the layers, or one of them, as a GeoPackage."""
        return self._bytes("gpkg", False, layer, False, {}, 3)

    def to_trimesh(self) -> trimesh.Scene:
        """Returns the model as a scene of trimesh, with a node for each part of each instance.

        Needs the packages trimesh and NumPy.
        """
        from ._trimesh import scene_of

        return scene_of(self)

    def _save(
        self, path: PathLike, metadata: bool, layer: str | None, recipe: bool, picture: dict[str, Any], stacklevel: int
    ) -> None:
        settings = json.dumps({"picture": picture, "metadata": metadata, "layer": layer, "recipe": recipe})
        found = json.loads(self._raw.export(os.fspath(path), settings))
        warnings = [BurgeonWarning._of(it) for it in found]
        of_layers = {it.extension for it in formats() if it.layers}
        if str(os.fspath(path)).rsplit(".", 1)[-1].lower() in of_layers and not any(it.count for it in self.layers):
            text = "no layers to write: no module of the final chains has a geometry"
            warnings.append(BurgeonWarning(f"{self.script}: {text}", kind="empty-model"))
        show(warnings, stacklevel)

    def _bytes(
        self, extension: str, metadata: bool, layer: str | None, recipe: bool, picture: dict[str, Any], stacklevel: int
    ) -> bytes:
        with tempfile.TemporaryDirectory(prefix="burgeon-") as folder:
            name = f"model.{extension.lstrip('.')}"
            self._save(os.path.join(folder, name), metadata, layer, recipe, picture, stacklevel + 1)
            if len(os.listdir(folder)) > 1:
                raise ValueError(f"the model has several files as .{extension}: use save, or a format of one file such as glb")
            with open(os.path.join(folder, name), "rb") as file:
                return file.read()

    def _repr_html_(self) -> str:
        return html_of(self)

    def __repr__(self) -> str:
        return f"<burgeon.Model {self.script}: {self.triangle_count:,} triangles, seed {self.seed}>"
