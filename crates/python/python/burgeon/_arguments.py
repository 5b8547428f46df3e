"""Arguments of runs, checked and converted for the compiled part."""

from __future__ import annotations

import json
import math
import operator
import os
from collections.abc import Callable, Iterable, Mapping
from typing import Any, Union

#: A path, as text or as an object.
PathLike = Union[str, "os.PathLike[str]"]

#: Files in memory: texts and bytes by name, or a function that returns one of them, or ``None``, for a name.
Loader = Union[Mapping[str, Union[str, bytes]], Callable[[str], Union[str, bytes, None]]]


def paths(name: str, value: PathLike | Iterable[PathLike]) -> list[str]:
    """Returns a list of paths from one path or several."""
    if isinstance(value, (str, os.PathLike)):
        value = [value]
    found = [os.fspath(path) for path in value]
    for path in found:
        if not isinstance(path, str):
            raise TypeError(f"{name} must be paths as text, not {type(path).__name__}")
    return found


def whole(name: str, value: Any, most: int = 2**64 - 1) -> int:
    """Returns a whole number from 0 to ``most``."""
    try:
        number = operator.index(value)
    except TypeError:
        raise TypeError(f"{name} must be a whole number, not {type(value).__name__}") from None
    if not 0 <= number <= most:
        raise ValueError(f"{name} must be between 0 and {most}, not {number}")
    return number


def value_text(name: str, value: Any) -> str:
    """Returns the value of a parameter as the text that scripts accept."""
    if hasattr(value, "tolist"):
        # Numbers and arrays of NumPy.
        value = value.tolist()
    if isinstance(value, bool):
        return "true" if value else "false"
    if isinstance(value, (int, float)):
        return repr(value)
    if isinstance(value, str):
        return value
    if isinstance(value, (list, tuple)):
        return json.dumps(value)
    kind = type(value).__name__
    raise TypeError(f"the value of {name!r} must be a number, a boolean, a string or a list of points, not {kind}")


def value_texts(values: Mapping[str, Any] | None) -> dict[str, str]:
    """Returns the values of parameters as texts."""
    texts = {}
    for name, value in (values or {}).items():
        if not isinstance(name, str):
            raise TypeError(f"names of parameters are strings, not {type(name).__name__}")
        texts[name] = value_text(name, value)
    return texts


def seconds(name: str, value: float) -> float:
    """Returns a time (s) above 0."""
    value = float(value)
    if not (value > 0 and math.isfinite(value)):
        raise ValueError(f"{name} must be above 0 s, not {value}")
    return value


def files(loader: Loader | None) -> Any:
    """Returns a loader as the compiled part takes it: a dictionary, a function or ``None``."""
    if loader is None or callable(loader):
        return loader
    if not isinstance(loader, Mapping):
        raise TypeError(f"loader must be a dictionary or a function, not {type(loader).__name__}")
    found = {}
    for name, content in loader.items():
        if not isinstance(name, str) or not isinstance(content, (str, bytes, bytearray, memoryview)):
            raise TypeError(f"the loader has {name!r}: names are strings, files are strings or bytes")
        found[name] = content if isinstance(content, str) else bytes(content)
    return found
