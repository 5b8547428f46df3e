"""Tables of Python as sources of scripts."""

from __future__ import annotations

import json
import math
import os
import tempfile
from collections.abc import Iterator, Mapping
from contextlib import contextmanager
from typing import Any

from ._wkb import geometry_of_wkb


class Table:
    """Rows with a geometry and attributes, which a script reads with ``source``.

    rows: dictionaries, a data frame, or an object with ``__geo_interface__`` such as a ``GeoDataFrame``.
    geometry: column of the geometries: GeoJSON dictionaries, WKB or EWKB as bytes or as hexadecimal text, or objects with
        ``__geo_interface__``. The column ``id`` contains the ids.
    crs: EPSG code of the coordinates. Without it, they are longitude and latitude (WGS 84), unless ``rows`` know their own.
    """

    def __init__(self, rows: Any, *, geometry: str = "geometry", crs: int | None = None) -> None:
        self.rows = rows
        self.geometry = geometry
        self.crs = crs

    def geojson(self) -> dict[str, Any]:
        """Returns the table as a GeoJSON feature collection."""
        crs = self.crs if self.crs is not None else _known_crs(self.rows)
        collection: dict[str, Any] = {"type": "FeatureCollection"}
        if crs is not None:
            collection["crs"] = {"type": "name", "properties": {"name": f"EPSG:{int(crs)}"}}
        collection["features"] = list(self._features())
        return collection

    def _features(self) -> Iterator[dict[str, Any]]:
        interface = getattr(self.rows, "__geo_interface__", None)
        if interface is not None:
            for feature in interface.get("features", [interface]):
                yield _plain(feature if feature.get("type") == "Feature" else _feature(feature, {}))
            return
        for number, row in enumerate(_rows(self.rows)):
            if not isinstance(row, Mapping):
                raise TypeError(f"row {number} is no dictionary, but {type(row).__name__}")
            values = {str(name): value for name, value in row.items() if name != self.geometry}
            try:
                geometry = _geometry(row.get(self.geometry))
            except (TypeError, ValueError) as error:
                raise type(error)(f"row {number}: {error}") from error
            yield _feature(geometry, _plain(values))


@contextmanager
def table_folder(sources: Mapping[str, Any]) -> Iterator[str]:
    """Writes tables to a temporary folder for one run, each to a file with its name."""
    with tempfile.TemporaryDirectory(prefix="burgeon-tables-") as folder:
        for name, rows in sources.items():
            if not isinstance(name, str) or not name or name in (".", "..") or any(mark in name for mark in "/\\:*?\0"):
                raise ValueError(f"{name!r} is no name of a table: use a word such as houses, without / \\ : * and ?")
            table = rows if isinstance(rows, Table) else Table(rows)
            with open(os.path.join(folder, name), "w", encoding="utf-8") as file:
                json.dump(table.geojson(), file, allow_nan=False)
        yield folder


def _known_crs(rows: Any) -> int | None:
    """Returns the EPSG code that a data frame with geometries has."""
    crs: Any = getattr(rows, "crs", None)
    return crs.to_epsg() if hasattr(crs, "to_epsg") else None


def _rows(rows: Any) -> Any:
    if hasattr(rows, "to_dict") and hasattr(rows, "columns"):
        return rows.to_dict("records")
    if isinstance(rows, (str, bytes, Mapping)) or not hasattr(rows, "__iter__"):
        raise TypeError(f"a table is a list of dictionaries or a data frame, not {type(rows).__name__}")
    return rows


def _feature(geometry: Any, values: dict[str, Any]) -> dict[str, Any]:
    feature: dict[str, Any] = {"type": "Feature"}
    if values.get("id") is not None:
        feature["id"] = values.pop("id")
    return {**feature, "geometry": geometry, "properties": values}


def _geometry(value: Any) -> Any:
    if value is None or (isinstance(value, float) and math.isnan(value)):
        return None
    if isinstance(value, (bytes, bytearray, memoryview)):
        return geometry_of_wkb(bytes(value))
    if isinstance(value, str):
        try:
            content = bytes.fromhex(value)
        except ValueError:
            raise ValueError("a geometry as text must be hexadecimal WKB") from None
        return geometry_of_wkb(content)
    if hasattr(value, "__geo_interface__"):
        return _plain(value.__geo_interface__)
    if isinstance(value, Mapping):
        return _plain(value)
    raise TypeError(f"a geometry must be GeoJSON, WKB or an object with __geo_interface__, not {type(value).__name__}")


def _plain(value: Any) -> Any:
    """Returns a value as JSON has it: numbers of NumPy and dates become plain, and missing numbers ``None``."""
    if hasattr(value, "tolist"):
        value = value.tolist()
    if value is None or isinstance(value, (bool, int, str)):
        return value
    if isinstance(value, float):
        return value if math.isfinite(value) else None
    if isinstance(value, Mapping):
        return {str(name): _plain(part) for name, part in value.items()}
    if isinstance(value, (list, tuple)):
        return [_plain(part) for part in value]
    if hasattr(value, "isoformat"):
        text = value.isoformat()
        return None if text == "NaT" else text
    text = str(value)
    return None if text in ("<NA>", "NaT") else text
