"""Parameters of scripts as properties with bounds, choices, units and descriptions.

Blender's properties belong to classes, so each list of parameters has a class of its own, with a name that depends on the
list. A collection refers to the class of its script by this name; a file that is opened again gets the class from there.
"""

import hashlib
import json
import math
from typing import Any

import bpy
from burgeon import Parameter

from . import work

PREFIX = "burgeon_values_"

# Classes by name, with their parameters.
_classes: dict[str, tuple[type, list[Parameter]]] = {}


def _changed(values: bpy.types.PropertyGroup, _context: bpy.types.Context) -> None:
    work.request(values.id_data)


def _is_whole(it: Parameter) -> bool:
    """Returns true for a number whose step and default are whole, and whose bounds fit Blender's integers."""
    numbers = [it.default, it.min or 0, it.max or 0]
    return bool(it.step) and all(float(n).is_integer() and abs(n) < 2**31 for n in [it.step, *numbers])


def _hex_to_rgb(text: str) -> tuple[float, ...]:
    digits = text.lstrip("#")
    if len(digits) == 3:
        digits = "".join(digit * 2 for digit in digits)
    return tuple(int(digits[at : at + 2], 16) / 255 for at in (0, 2, 4))


def _property(it: Parameter) -> Any:
    """Returns the declaration of a parameter; ``None`` for one that Blender has no field for."""
    common = {"name": it.name, "description": " ".join(filter(None, [it.doc, it.unit and f"({it.unit})"]))}
    common["update"] = _changed
    if it.kind == "number":
        bounds = {key: value for key, value in (("min", it.min), ("max", it.max)) if value is not None}
        if _is_whole(it):
            bounds = {key: int(value) for key, value in bounds.items()}
            return bpy.props.IntProperty(default=int(it.default), step=max(1, int(it.step)), **bounds, **common)
        digits = 3 if not it.step else min(6, max(1, math.ceil(-math.log10(it.step))))
        step = 100 * (it.step or 0.1)
        return bpy.props.FloatProperty(default=it.default, step=max(1, round(step)), precision=digits, **bounds, **common)
    if it.kind == "boolean":
        return bpy.props.BoolProperty(default=it.default, **common)
    if it.kind == "choice":
        choices = [(choice, choice, "") for choice in it.choices]
        return bpy.props.EnumProperty(items=choices, default=it.default, **common)
    if it.kind == "color":
        limits = {"subtype": "COLOR_GAMMA", "size": 3, "min": 0.0, "max": 1.0}
        return bpy.props.FloatVectorProperty(default=_hex_to_rgb(it.default), **limits, **common)
    if it.kind == "text":
        return bpy.props.StringProperty(default=it.default, **common)
    return None


def _declaration(parameters: list[Parameter]) -> str:
    fields = [[it.name, it.kind, it.default, it.min, it.max, it.step, it.choices, it.unit, it.doc] for it in parameters]
    return json.dumps(fields)


def adopt(collection: bpy.types.Collection, parameters: dict[str, Parameter]) -> None:
    """Gives a collection properties for these parameters. Values of parameters that stay are kept."""
    listed = list(parameters.values())
    name = PREFIX + hashlib.blake2b(_declaration(listed).encode(), digest_size=8).hexdigest()
    settings = collection.burgeon
    if name not in _classes:
        fields = {f"p{at}": _property(it) for at, it in enumerate(listed)}
        fields = {key: declared for key, declared in fields.items() if declared is not None}
        made = type(name, (bpy.types.PropertyGroup,), {"__annotations__": fields})
        bpy.utils.register_class(made)
        setattr(bpy.types.Collection, name, bpy.props.PointerProperty(type=made))
        _classes[name] = (made, listed)
    if settings.values_class != name:
        before = changed_values(collection)
        settings.values_class = name
        with work.one_request(collection, runs=False):
            for known, value in before.items():
                _set(collection, known, value)


def listed(collection: bpy.types.Collection) -> list[tuple[Parameter, str | None]]:
    """Returns the parameters of a collection's script, with the names of their properties if they have one."""
    found = _classes.get(collection.burgeon.values_class)
    if found is None:
        return []
    made, parameters = found
    keys = made.__annotations__
    return [(it, f"p{at}" if f"p{at}" in keys else None) for at, it in enumerate(parameters)]


def group(collection: bpy.types.Collection) -> bpy.types.PropertyGroup | None:
    """Returns the values of a collection's parameters; ``None`` if its script is not known yet."""
    name = collection.burgeon.values_class
    return getattr(collection, name) if name in _classes else None


def _read(it: Parameter, value: Any) -> Any:
    if it.kind == "color":
        return "#" + "".join(f"{round(part * 255):02x}" for part in value)
    return value


def changed_values(collection: bpy.types.Collection) -> dict[str, Any]:
    """Returns the values that users have changed, by the names of the parameters."""
    values = group(collection)
    if values is None:
        return {}
    keys = [(it, key) for it, key in listed(collection) if key and values.is_property_set(key)]
    return {it.name: _read(it, getattr(values, key)) for it, key in keys}


def _set(collection: bpy.types.Collection, name: str, value: Any) -> None:
    values = group(collection)
    for it, key in listed(collection):
        if it.name == name and key:
            try:
                setattr(values, key, _hex_to_rgb(value) if it.kind == "color" else value)
            except (TypeError, ValueError):
                # The parameter has another type or other choices now, so its default is used.
                values.property_unset(key)


def set_all(collection: bpy.types.Collection, chosen: dict[str, Any]) -> None:
    """Sets the values of a preset, and all others to their defaults."""
    values = group(collection)
    if values is None:
        return
    for _, key in listed(collection):
        if key:
            values.property_unset(key)
    for name, value in chosen.items():
        _set(collection, name, value)


def register() -> None:
    pass


def unregister() -> None:
    for name, (made, _) in _classes.items():
        delattr(bpy.types.Collection, name)
        bpy.utils.unregister_class(made)
    _classes.clear()
