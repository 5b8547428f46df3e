"""Models as scenes of trimesh."""

from __future__ import annotations

from typing import TYPE_CHECKING

if TYPE_CHECKING:
    import trimesh

    from ._model import Material, Model, Part


def scene_of(model: Model) -> trimesh.Scene:
    """Returns a scene with a geometry for each part of each mesh, and a node for each of its instances."""
    import trimesh

    scene = trimesh.Scene()
    known: dict[tuple[int, int], str] = {}
    numbers = {id(mesh): number for number, mesh in enumerate(model.meshes)}
    for count, instance in enumerate(model.instances):
        number = numbers[id(instance.mesh)]
        for place, part in enumerate(instance.mesh.parts):
            node = f"{instance.name or 'instance'} {count}.{place}"
            if (number, place) in known:
                scene.graph.update(node, matrix=instance.transform, geometry=known[number, place])
                continue
            name = f"{instance.mesh.name or 'mesh'} {number}.{place}"
            scene.add_geometry(_geometry(part), node_name=node, geom_name=name, transform=instance.transform)
            known[number, place] = name
    return scene


def _geometry(part: Part) -> trimesh.Trimesh:
    import trimesh

    visual = trimesh.visual.TextureVisuals(uv=part.uvs, material=_material(part.material))
    return trimesh.Trimesh(
        vertices=part.positions,
        faces=part.triangles,
        vertex_normals=part.normals,
        visual=visual,
        process=False,
    )


def _material(material: Material) -> trimesh.visual.material.PBRMaterial:
    import trimesh

    return trimesh.visual.material.PBRMaterial(
        name=material.name or None,
        baseColorFactor=material.color,
        metallicFactor=material.metallic,
        roughnessFactor=material.roughness,
        emissiveFactor=material.emissive,
        doubleSided=material.double_sided,
    )
