"""Parameters that scripts declare."""

from __future__ import annotations

import json
import os
from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from typing import Any

from . import _burgeon
from ._arguments import Loader, PathLike, files, paths, value_texts


@dataclass(frozen=True)
class Parameter:
    """A value that users can change without editing the script."""

    #: Name with which it is set; a parameter of a package has the package as prefix, ``castle.size``.
    name: str
    #: ``number``, ``boolean``, ``choice``, ``color``, ``text`` or ``points``.
    kind: str
    #: Value with the given values.
    value: Any
    #: Default value of the script.
    default: Any
    #: Minimum and maximum of a number, and the distance between its values, if the script sets them.
    min: float | None = None
    max: float | None = None
    step: float | None = None
    #: Choices of a choice.
    choices: tuple[str, ...] = ()
    #: Heading that it shares with other parameters; may be empty.
    group: str = ""
    #: Unit for display; may be empty.
    unit: str = ""
    #: Description; may be empty.
    doc: str = ""
    #: Package that declares it, if any.
    package: str | None = None


def parameters(
    script: PathLike,
    *,
    values: Mapping[str, Any] | None = None,
    data: PathLike | Iterable[PathLike] = (),
    mods: PathLike | Iterable[PathLike] = (),
    loader: Loader | None = None,
) -> dict[str, Parameter]:
    """Returns the parameters of a script by name, in the order of their declaration, without running its rules.

    script: path of the script, or its name in ``loader``.
    values: values of parameters, on which others may depend.
    data, mods, loader: as in ``run``.

    Raises ``Error`` with all problems that are found in the script.
    """
    options = {"values": value_texts(values), "data": paths("data", data), "mods": paths("mods", mods)}
    found = json.loads(_burgeon.parameters(os.fspath(script), json.dumps(options), files(loader)))
    for fields in found:
        fields["choices"] = tuple(fields.get("choices", ()))
    return {fields["name"]: Parameter(**fields) for fields in found}
