"""A model as objects of Blender.

Each mesh of the model is one mesh of the file; its instances are objects that share it. Features are collections with the
attributes as custom properties. What a run makes is reused by the next one, so that modifiers, constraints and changed
materials stay.
"""

from collections import Counter
from typing import Any

import bpy
import burgeon
import numpy as np
from mathutils import Matrix

# Custom property with the key of an object, a feature's collection, a mesh, a material or a node that a run has made.
KEY = "burgeon"
# Custom property with the facts from which a material was made. If they change, it is made again.
FACTS = "burgeon_facts"
# Texture coordinates of textures and normal maps, and of dirt maps.
LAYERS = ("UVMap", "Dirt")


class Owned:
    """What the last run of a model has made, by key.

    It is found by its place in the collection: a file that is opened again and a copy of a model have everything there.
    """

    def __init__(self, root: bpy.types.Collection) -> None:
        self.folders: dict[str, bpy.types.Collection] = {}
        self.objects: dict[str, bpy.types.Object] = {}
        # A second object or folder with the same key is a copy that the user has made, or comes from an older file.
        self.copies: list[bpy.types.ID] = []
        self._walk(root)
        objects = {*self.objects.values(), *(it for it in self.copies if isinstance(it, bpy.types.Object))}
        meshes = Counter(it.data for it in objects if it.data is not None and KEY in it.data)
        # A mesh that objects outside the model use stays as it is.
        self.meshes = {it[KEY]: it for it, count in meshes.items() if it.users == count}
        self.materials = Counter(it for mesh in self.meshes.values() for it in mesh.materials if it and KEY in it)

    def _walk(self, folder: bpy.types.Collection) -> None:
        for it in folder.objects:
            if KEY in it:
                self._add(it, self.objects)
        for it in folder.children:
            if it.burgeon.is_model:
                continue
            if KEY in it:
                self._add(it, self.folders)
            self._walk(it)

    def _add(self, it: bpy.types.ID, known: dict[str, Any]) -> None:
        if known.setdefault(it[KEY], it) != it:
            self.copies.append(it)


def show(model: burgeon.Model, root: bpy.types.Collection) -> int:
    """Replaces the content of a collection by a model, and returns the number of objects."""
    owned = Owned(root)
    by_material = {id(it): _material(it, owned) for it in model.materials}
    meshes = _meshes(model, root, owned, by_material)
    folders = _folders(model, root, owned)
    _objects(model, root, owned, meshes, folders)
    bpy.data.batch_remove(_left(owned))
    return len(model.instances)


def _left(owned: Owned) -> list[bpy.types.ID]:
    """Returns what the new run has not used again."""
    return [*owned.objects.values(), *owned.folders.values(), *owned.meshes.values(), *owned.copies]


def _material(it: burgeon.Material, owned: Owned) -> bpy.types.Material:
    images = (it.texture, it.texture_size, it.normal_map, it.normal_scale, it.dirt_map, it.dirt_size)
    facts = repr((it.color, it.metallic, it.roughness, it.emissive, images))
    name = it.name or "Burgeon"
    known = next((m for m in owned.materials if m[KEY] == name), None)
    is_shared = known is not None and known.users != owned.materials[known]
    if known is None or (known.get(FACTS) != facts and is_shared):
        same = (m for m in bpy.data.materials if m.get(KEY) == name and m.get(FACTS) == facts)
        known = next(same, None) or bpy.data.materials.new(name)
        known[KEY] = name
    if known.get(FACTS) == facts:
        return known
    known[FACTS] = facts
    if known.node_tree is None:
        known.use_nodes = True
    known.use_backface_culling = not it.double_sided
    known.diffuse_color = it.color
    surface = next((node for node in known.node_tree.nodes if node.type == "BSDF_PRINCIPLED"), None)
    if surface is None:
        return known
    surface.inputs["Base Color"].default_value = it.color
    surface.inputs["Metallic"].default_value = it.metallic
    surface.inputs["Roughness"].default_value = it.roughness
    surface.inputs["Alpha"].default_value = it.color[3]
    surface.inputs["Emission Color"].default_value = (*it.emissive, 1.0)
    surface.inputs["Emission Strength"].default_value = 1.0 if any(it.emissive) else 0.0
    for node in [node for node in known.node_tree.nodes if KEY in node]:
        known.node_tree.nodes.remove(node)
    if it.texture:
        texture = _image(known, surface, it.texture, it.texture_size, LAYERS[0])
        if texture is not None:
            known.node_tree.links.new(texture.outputs["Color"], surface.inputs["Base Color"])
    if it.dirt_map:
        _dirt(known, surface, it)
    if it.normal_map:
        _relief(known, surface, it)
    return known


def _relief(material: bpy.types.Material, surface: bpy.types.Node, it: burgeon.Material) -> None:
    """Adds the normal map of a material."""
    tree = material.node_tree
    texture = _image(material, surface, it.normal_map, it.texture_size, LAYERS[0])
    if texture is None:
        return
    texture.image.colorspace_settings.name = "Non-Color"
    relief = _node(tree, "ShaderNodeNormalMap")
    relief.uv_map = LAYERS[0]
    relief.inputs["Strength"].default_value = it.normal_scale
    relief.location = (surface.location.x, surface.location.y - 300)
    tree.links.new(texture.outputs["Color"], relief.inputs["Color"])
    tree.links.new(relief.outputs["Normal"], surface.inputs["Normal"])


def _dirt(material: bpy.types.Material, surface: bpy.types.Node, it: burgeon.Material) -> None:
    """Multiplies the colour of a material by its dirt map."""
    tree = material.node_tree
    texture = _image(material, surface, it.dirt_map, it.dirt_size, LAYERS[1])
    if texture is None:
        return
    color = surface.inputs["Base Color"]
    mix = _node(tree, "ShaderNodeMix")
    mix.data_type, mix.blend_type = "RGBA", "MULTIPLY"
    mix.location = (surface.location.x - 200, surface.location.y - 100)
    # The node has sockets of the same names for each type of data.
    factor = next(socket for socket in mix.inputs if socket.identifier == "Factor_Float")
    a, b = (next(socket for socket in mix.inputs if socket.identifier == name) for name in ("A_Color", "B_Color"))
    result = next(socket for socket in mix.outputs if socket.identifier == "Result_Color")
    factor.default_value = 1.0
    if color.links:
        tree.links.new(color.links[0].from_socket, a)
    else:
        a.default_value = color.default_value
    tree.links.new(texture.outputs["Color"], b)
    tree.links.new(result, color)


def _node(tree: bpy.types.NodeTree, kind: str) -> bpy.types.Node:
    """Adds a node, which is removed when the material is made again."""
    node = tree.nodes.new(kind)
    node[KEY] = kind
    return node


def _image(
    material: bpy.types.Material, surface: bpy.types.Node, path: str, size: list[float] | None, layer: str
) -> bpy.types.Node | None:
    """Adds the node of an image; texture coordinates are in metres. Returns None if it cannot be read."""
    tree = material.node_tree
    try:
        image = bpy.data.images.load(path, check_existing=True)
    except RuntimeError:
        return None
    texture = _node(tree, "ShaderNodeTexImage")
    texture.image = image
    mapping, source = _node(tree, "ShaderNodeMapping"), _node(tree, "ShaderNodeUVMap")
    source.uv_map = layer
    width, height = size or (1.0, 1.0)
    mapping.inputs["Scale"].default_value = (1.0 / width, 1.0 / height, 1.0)
    for at, node in enumerate((source, mapping, texture)):
        node.location = (surface.location.x - 600 + 200 * at, surface.location.y)
    tree.links.new(source.outputs["UV"], mapping.inputs["Vector"])
    tree.links.new(mapping.outputs["Vector"], texture.inputs["Vector"])
    return texture


def _meshes(
    model: burgeon.Model, root: bpy.types.Collection, owned: Owned, by_material: dict[int, bpy.types.Material]
) -> dict[int, bpy.types.Mesh]:
    """Returns the meshes by the identity of those of the model."""
    made = {}
    for at, it in enumerate(model.meshes):
        mesh = owned.meshes.pop(str(at), None) or bpy.data.meshes.new(it.name or root.name)
        mesh[KEY] = str(at)
        _fill(mesh, it, by_material)
        made[id(it)] = mesh
    return made


def _fill(mesh: bpy.types.Mesh, it: burgeon.Mesh, by_material: dict[int, bpy.types.Material]) -> None:
    """Replaces the content of a mesh. Each part has a slot for its material."""
    mesh.clear_geometry()
    mesh.materials.clear()
    parts = [part for part in it.parts if part.triangle_count]
    for part in parts:
        mesh.materials.append(by_material[id(part.material)])
    if not parts:
        return
    firsts = np.cumsum([0, *(part.vertex_count for part in parts)])
    points = np.concatenate([part.positions for part in parts])
    corners = np.concatenate([part.triangles + first for part, first in zip(parts, firsts)]).astype(np.int32).ravel()
    count = len(corners) // 3
    mesh.vertices.add(len(points))
    mesh.attributes["position"].data.foreach_set("vector", np.ascontiguousarray(points, np.float32).ravel())
    mesh.loops.add(3 * count)
    mesh.loops.foreach_set("vertex_index", corners)
    mesh.polygons.add(count)
    mesh.polygons.foreach_set("loop_start", np.arange(0, 3 * count, 3, dtype=np.int32))
    slots = np.repeat(np.arange(len(parts), dtype=np.int32), [part.triangle_count for part in parts])
    mesh.polygons.foreach_set("material_index", slots)
    if all(len(part.uvs) == part.vertex_count for part in parts):
        uvs = np.concatenate([part.uvs for part in parts]).astype(np.float32)
        mesh.uv_layers.new(name=LAYERS[0]).uv.foreach_set("vector", uvs[corners].ravel())
        if any(part.material.dirt_map for part in parts):
            uvs = np.concatenate([part.second_uvs for part in parts]).astype(np.float32)
            mesh.uv_layers.new(name=LAYERS[1]).uv.foreach_set("vector", uvs[corners].ravel())
    mesh.update(calc_edges=True)
    if all(len(part.normals) == part.vertex_count for part in parts):
        normals = np.concatenate([part.normals for part in parts]).astype(np.float32)
        attribute = mesh.attributes.new("custom_normal", "FLOAT_VECTOR", "POINT")
        attribute.data.foreach_set("vector", normals.ravel())


def _folders(model: burgeon.Model, root: bpy.types.Collection, owned: Owned) -> dict[str, bpy.types.Collection]:
    """Returns the collection of each feature, with its attributes as custom properties."""
    features = {it["id"]: it for it in model.features}
    made = {}
    for feature in dict.fromkeys(it.feature for it in model.instances if it.feature is not None):
        key = str(feature)
        folder = owned.folders.pop(key, None)
        if folder is None:
            folder = bpy.data.collections.new(key)
            root.children.link(folder)
        for name in [name for name in folder.keys() if name != KEY]:
            del folder[name]
        for name, value in features.get(feature, {}).items():
            if isinstance(value, (str, bool, int, float)) and name:
                # Names of custom properties are limited.
                folder[name[:63]] = value
        folder[KEY] = key
        made[feature] = folder
    return made


def _objects(
    model: burgeon.Model,
    root: bpy.types.Collection,
    owned: Owned,
    meshes: dict[int, bpy.types.Mesh],
    folders: dict[str, bpy.types.Collection],
) -> None:
    """Places the instances. An object keeps its key from run to run: feature, name and number among those."""
    numbers: Counter[tuple[str | None, str]] = Counter()
    transforms = np.array(model.transforms, np.float64).reshape(-1, 4, 4)
    for it, transform in zip(model.instances, transforms):
        numbers[it.feature, it.name] += 1
        key = f"{it.feature}:{it.name}:{numbers[it.feature, it.name]}"
        item = owned.objects.pop(key, None)
        mesh = meshes[id(it.mesh)]
        if item is None:
            item = bpy.data.objects.new(it.name or root.name, mesh)
            item[KEY] = key
            (folders[it.feature] if it.feature is not None else root).objects.link(item)
        elif item.data is not mesh:
            item.data = mesh
        item.matrix_world = Matrix(transform.tolist())


def remove(root: bpy.types.Collection) -> None:
    """Removes a model from the file, with everything that its runs have made."""
    bpy.data.batch_remove(_left(Owned(root)))
    bpy.data.collections.remove(root)
