"""Settings of a model, which its collection stores."""

import bpy

from . import presets, work


def changed(settings: bpy.types.PropertyGroup, _context: bpy.types.Context) -> None:
    """Runs the script of a model again."""
    work.request(settings.id_data)


def script_changed(settings: bpy.types.PropertyGroup, _context: bpy.types.Context) -> None:
    """Runs another script: the values of the last one have no meaning for it."""
    settings.preset = presets.NONE
    settings.values_class = ""
    work.request(settings.id_data)


def preset_changed(settings: bpy.types.PropertyGroup, _context: bpy.types.Context) -> None:
    presets.use(settings.id_data)


class BurgeonModel(bpy.types.PropertyGroup):
    """Script of a model and the options of its run."""

    is_model: bpy.props.BoolProperty(options={"HIDDEN"})
    script: bpy.props.StringProperty(
        name="Script", description="Script in Lua that makes the model", subtype="FILE_PATH", update=script_changed
    )
    data: bpy.props.StringProperty(
        name="Data", description="Folder whose data files the script may read", subtype="DIR_PATH", update=changed
    )
    seed: bpy.props.IntProperty(
        name="Seed", description="Seed of all random numbers", min=0, max=2**31 - 1, update=changed
    )
    preset: bpy.props.EnumProperty(
        name="Preset", description="Values and a seed with a name", items=presets.items, update=preset_changed
    )
    detail: bpy.props.IntProperty(
        name="Level of detail", description="From 0 for footprints to 3 for full detail", min=0, max=3, default=3,
        update=changed,
    )
    follows: bpy.props.BoolProperty(
        name="Follow saves", description="Run the script again whenever it or its packages are saved", default=True
    )
    values_class: bpy.props.StringProperty(options={"HIDDEN"})
    error: bpy.props.StringProperty(options={"HIDDEN"})
    message: bpy.props.StringProperty(options={"HIDDEN"})
    warnings: bpy.props.StringProperty(options={"HIDDEN"})


def register() -> None:
    bpy.utils.register_class(BurgeonModel)
    bpy.types.Collection.burgeon = bpy.props.PointerProperty(type=BurgeonModel)


def unregister() -> None:
    del bpy.types.Collection.burgeon
    bpy.utils.unregister_class(BurgeonModel)
