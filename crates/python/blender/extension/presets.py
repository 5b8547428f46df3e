"""Presets of scripts: the file ``NAME.presets.json`` beside a script."""

import json
import os

import bpy

NONE = "NONE"

# Blender needs the texts of choices to stay alive while it shows them.
_shown: list[tuple[str, str, str]] = []


def read(script: str) -> dict[str, dict]:
    """Returns the presets by name; none if the file is missing or is not valid."""
    try:
        with open(os.path.splitext(bpy.path.abspath(script))[0] + ".presets.json", encoding="utf-8") as file:
            found = json.load(file)
    except (OSError, ValueError):
        return {}
    return {name: it for name, it in found.items() if isinstance(it, dict)} if isinstance(found, dict) else {}


def items(settings: bpy.types.PropertyGroup, _context: bpy.types.Context | None) -> list[tuple[str, str, str]]:
    """Returns the choices of the property ``preset``."""
    names = read(settings.script)
    _shown[:] = [(NONE, "None", "Values of the panel"), *((name, name, "") for name in names)]
    return _shown


def use(collection: bpy.types.Collection) -> None:
    """Sets the values and the seed of the chosen preset; parameters that it does not name get their defaults."""
    from . import values, work

    settings = collection.burgeon
    chosen = read(settings.script).get(settings.preset)
    if chosen is None:
        return
    with work.one_request(collection):
        values.set_all(collection, chosen.get("params", {}))
        if isinstance(chosen.get("seed"), int):
            settings.seed = chosen["seed"]
