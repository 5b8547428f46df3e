"""Runs of scripts."""

from __future__ import annotations

import builtins
import json
import os
from collections.abc import Callable, Iterable, Mapping
from contextlib import ExitStack
from dataclasses import dataclass
from typing import Any

from . import _burgeon
from ._arguments import Loader, PathLike, files, paths, seconds, value_texts, whole
from ._errors import show
from ._model import Model
from ._tables import Table, table_folder


@dataclass(frozen=True)
class Progress:
    """Progress of a run."""

    #: Last completed derivation step.
    step: int
    #: Maximum number of steps, if there is one.
    steps: int | None
    #: Number of modules of the chain.
    modules: int
    #: Time (s) since the run began.
    seconds: float
    #: Message for users, with the rate and the remaining time.
    text: str


def run(
    script: PathLike,
    *,
    seed: int = 0,
    values: Mapping[str, Any] | None = None,
    data: PathLike | Iterable[PathLike] = (),
    sources: Mapping[str, Any] | None = None,
    loader: Loader | None = None,
    mods: PathLike | Iterable[PathLike] = (),
    databases: Iterable[str] = (),
    preset: str | None = None,
    steps: int | None = None,
    lod: int = 3,
    threads: int | None = None,
    strict: bool = False,
    time_limit: float = 300.0,
    memory_limit: int | None = None,
    module_limit: int | None = None,
    triangle_limit: int | None = None,
    progress: Callable[[Progress], object] | None = None,
    print: Callable[[str], object] | None = builtins.print,
) -> Model:
    """Runs a script and returns its model.

    Other threads of Python continue during the run, and Ctrl-C cancels it.

    script: path of the script, or its name in ``loader``.
    seed: seed of all random numbers, from 0.
    values: values of parameters by name: numbers, booleans, strings or lists of points.
    data: folders whose data files the script may read.
    sources: tables that the script reads as ``source("NAME")``: rows with a geometry, see ``Table``.
    loader: files in memory in the place of the script's folder: a dictionary of texts and bytes by name, or a function
        that returns the content of a name, or ``None``.
    mods: folders of packages, or single packages.
    databases: addresses of databases that the script may query.
    preset: preset of the script; ``values`` override it, and its seed is ignored.
    steps: maximum number of derivation steps of each system.
    lod: level of detail, from 0 for footprints to 3 for full detail.
    threads: number of threads, which does not affect the result; all cores if ``None``.
    strict: raise an exception for the first warning.
    time_limit: time limit (s).
    memory_limit: memory limit (MB).
    module_limit, triangle_limit: maximum numbers of modules and triangles of a system.
    progress: function that is called with the progress several times a second.
    print: function that receives the texts that the script prints; ``None`` discards them.

    Raises ``Error`` if the script or its data fail, and the exceptions of the functions that it calls. Warnings are
    shown as ``BurgeonWarning``.
    """
    options: dict[str, Any] = {
        "seed": whole("seed", seed),
        "values": value_texts(values),
        "mods": paths("mods", mods),
        "databases": list(databases),
        "preset": preset,
        "lod": whole("lod", lod, 3),
        "strict": bool(strict),
        "time_limit": seconds("time_limit", time_limit),
    }
    counts = {
        "steps": steps,
        "threads": threads,
        "memory_limit": memory_limit,
        "module_limit": module_limit,
        "triangle_limit": triangle_limit,
    }
    options.update({name: whole(name, value) for name, value in counts.items() if value is not None})
    with ExitStack() as stack:
        folders = paths("data", data)
        if sources:
            folders.append(stack.enter_context(table_folder(sources)))
        options["data"] = folders
        raw = _burgeon.run(
            os.fspath(script),
            json.dumps(options),
            print,
            progress and (lambda state: progress(Progress(**state))),
            files(loader),
        )
    model = Model(raw)
    show(model.warnings, 2)
    return model


__all__ = ["Progress", "Table", "run"]
