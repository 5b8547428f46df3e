"""Panel of models in the sidebar of the 3D view, and its commands."""

import os
import textwrap

import bpy
import burgeon
from bpy_extras.io_utils import ExportHelper, ImportHelper

from . import scene, values, work


def active_model(context: bpy.types.Context) -> bpy.types.Collection | None:
    """Returns the model of the active object or collection; otherwise the only model of the file."""
    found = work.models()
    active = context.view_layer.active_layer_collection.collection
    places = [active, *(context.object.users_collection if context.object else ())]
    for model in found:
        inside = {model, *model.children_recursive}
        if any(place in inside for place in places):
            return model
    return found[0] if len(found) == 1 else None


def activate(context: bpy.types.Context, collection: bpy.types.Collection) -> bool:
    """Makes a collection the active one, so that the panel shows its model. Returns false if the view layer lacks it."""
    pending = [context.view_layer.layer_collection]
    while pending:
        layer = pending.pop()
        if layer.collection == collection:
            context.view_layer.active_layer_collection = layer
            context.view_layer.objects.active = None
            return True
        pending.extend(layer.children)
    return False


class BURGEON_OT_add(bpy.types.Operator, ImportHelper):
    """Adds a model that a script makes"""

    bl_idname = "burgeon.add"
    bl_label = "Add Burgeon Model"
    bl_options = {"REGISTER", "UNDO"}

    filename_ext = ".lua"
    filter_glob: bpy.props.StringProperty(default="*.lua;*.luau", options={"HIDDEN"})

    def execute(self, context: bpy.types.Context) -> set[str]:
        name = os.path.splitext(os.path.basename(self.filepath))[0]
        collection = bpy.data.collections.new(name)
        context.scene.collection.children.link(collection)
        activate(context, collection)
        with work.one_request(collection):
            collection.burgeon.is_model = True
            collection.burgeon.script = self.filepath
        # The settings may have come from the last model.
        work.request(collection)
        if collection.burgeon.error:
            self.report({"ERROR"}, collection.burgeon.error)
        return {"FINISHED"}


class BURGEON_OT_choose(bpy.types.Operator):
    """Shows this model in the panel"""

    bl_idname = "burgeon.choose"
    bl_label = "Choose Model"

    name: bpy.props.StringProperty(options={"HIDDEN"})

    def execute(self, context: bpy.types.Context) -> set[str]:
        if activate(context, bpy.data.collections[self.name]):
            return {"FINISHED"}
        self.report({"ERROR"}, f"{self.name} is not in this view layer")
        return {"CANCELLED"}


class OfModel:
    """Operator that needs a model."""

    bl_options = {"REGISTER", "UNDO"}

    @classmethod
    def poll(cls, context: bpy.types.Context) -> bool:
        return active_model(context) is not None


class BURGEON_OT_run(OfModel, bpy.types.Operator):
    """Runs the script again"""

    bl_idname = "burgeon.run"
    bl_label = "Run Script"

    def execute(self, context: bpy.types.Context) -> set[str]:
        model = active_model(context)
        work.request(model)
        if model.burgeon.error:
            self.report({"ERROR"}, model.burgeon.error)
        return {"FINISHED"}


class BURGEON_OT_defaults(OfModel, bpy.types.Operator):
    """Sets all parameters to the defaults of the script"""

    bl_idname = "burgeon.defaults"
    bl_label = "Reset Values"

    def execute(self, context: bpy.types.Context) -> set[str]:
        model = active_model(context)
        with work.one_request(model):
            values.set_all(model, {})
            work.request(model)
        return {"FINISHED"}


class BURGEON_OT_remove(OfModel, bpy.types.Operator):
    """Removes the model and everything that its script has made"""

    bl_idname = "burgeon.remove"
    bl_label = "Remove Model"

    def execute(self, context: bpy.types.Context) -> set[str]:
        scene.remove(active_model(context))
        return {"FINISHED"}


class BURGEON_OT_apply(OfModel, bpy.types.Operator):
    """Keeps the objects as they are, and forgets the script"""

    bl_idname = "burgeon.apply"
    bl_label = "Apply Model"

    def execute(self, context: bpy.types.Context) -> set[str]:
        model = active_model(context)
        for item in (*model.all_objects, *model.children_recursive, *(it.data for it in model.all_objects if it.data)):
            if scene.KEY in item:
                del item[scene.KEY]
        model.burgeon.is_model = False
        return {"FINISHED"}


class BURGEON_OT_save(OfModel, bpy.types.Operator, ExportHelper):
    """Writes the model with Burgeon, in the format of the extension"""

    bl_idname = "burgeon.save"
    bl_label = "Save with Burgeon"
    bl_options = {"REGISTER"}

    filename_ext = ".glb"
    check_extension = None

    def execute(self, context: bpy.types.Context) -> set[str]:
        job = work.job_of(active_model(context))
        try:
            burgeon.run(job.script, print=None, **job.arguments).save(self.filepath)
        except burgeon.Error as error:
            self.report({"ERROR"}, str(error))
            return {"CANCELLED"}
        self.report({"INFO"}, f"Saved {self.filepath}")
        return {"FINISHED"}


def _lines(layout: bpy.types.UILayout, text: str, icon: str, width: int) -> None:
    """Shows a text in lines; the first one has the icon."""
    lines = [part for line in text.splitlines() for part in textwrap.wrap(line, max(20, width // 8)) or [""]]
    column = layout.column(align=True)
    for at, line in enumerate(lines):
        column.label(text=line, icon=icon if at == 0 else "BLANK1")


class BURGEON_PT_model(bpy.types.Panel):
    """Script, parameters and messages of a model"""

    bl_label = "Burgeon"
    bl_space_type = "VIEW_3D"
    bl_region_type = "UI"
    bl_category = "Burgeon"

    def draw(self, context: bpy.types.Context) -> None:
        layout = self.layout
        layout.use_property_split = True
        layout.use_property_decorate = False
        model = active_model(context)
        if model is None:
            for it in work.models():
                layout.operator("burgeon.choose", text=it.name, icon="OUTLINER_COLLECTION").name = it.name
            layout.operator("burgeon.add", icon="ADD")
            return
        settings = model.burgeon
        column = layout.column()
        column.prop(settings, "script")
        column.prop(settings, "data")
        column.prop(settings, "preset")
        column.prop(settings, "seed")
        column.prop(settings, "detail")
        column.prop(settings, "follows")
        shown = values.group(model)
        if shown is not None and values.listed(model):
            box = layout.box().column()
            for it, key in values.listed(model):
                if key:
                    box.prop(shown, key, slider=it.min is not None and it.max is not None)
                else:
                    box.label(text=f"{it.name}: edit it in the script", icon="CURVE_DATA")
            box.operator("burgeon.defaults", icon="LOOP_BACK")
        if settings.error:
            _lines(layout.box(), settings.error, "ERROR", context.region.width)
        if settings.warnings:
            _lines(layout.box(), settings.warnings, "INFO", context.region.width)
        running = (work.progress_of(model) or "Running") if work.is_running(model) else ""
        if running or not settings.error:
            layout.label(text=running or settings.message or "Not run with these settings yet")
        row = layout.row(align=True)
        row.operator("burgeon.run", icon="FILE_REFRESH", text="Run")
        row.operator("burgeon.save", icon="EXPORT", text="Save")
        row.operator("burgeon.apply", icon="CHECKMARK", text="Apply")
        row.operator("burgeon.remove", icon="TRASH", text="")


def _in_add_menu(self: bpy.types.Menu, _context: bpy.types.Context) -> None:
    self.layout.operator("burgeon.add", icon="OUTLINER_OB_VOLUME", text="Burgeon Model")


CLASSES = (
    BURGEON_OT_add,
    BURGEON_OT_choose,
    BURGEON_OT_run,
    BURGEON_OT_defaults,
    BURGEON_OT_remove,
    BURGEON_OT_apply,
    BURGEON_OT_save,
    BURGEON_PT_model,
)


def register() -> None:
    for made in CLASSES:
        bpy.utils.register_class(made)
    bpy.types.VIEW3D_MT_add.append(_in_add_menu)


def unregister() -> None:
    bpy.types.VIEW3D_MT_add.remove(_in_add_menu)
    for made in reversed(CLASSES):
        bpy.utils.unregister_class(made)
