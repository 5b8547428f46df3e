"""Geometries in well-known binary form (OGC Simple Features, and PostGIS's EWKB) as GeoJSON."""

from __future__ import annotations

import struct
from typing import Any

_NAMES = {
    1: "Point",
    2: "LineString",
    3: "Polygon",
    4: "MultiPoint",
    5: "MultiLineString",
    6: "MultiPolygon",
    7: "GeometryCollection",
}

#: Maximum depth of collections in collections.
_DEEPEST = 32


def geometry_of_wkb(content: bytes) -> dict[str, Any]:
    """Returns a geometry as a GeoJSON dictionary. M values are dropped.

    Raises ``ValueError`` if the bytes are no geometry, or have a rest.
    """
    reader = _Reader(content)
    try:
        geometry = reader.geometry(0)
    except struct.error:
        raise ValueError(f"the WKB geometry ends early, after {len(content)} bytes") from None
    if reader.at != len(content):
        raise ValueError(f"{len(content) - reader.at} bytes follow the WKB geometry")
    return geometry


class _Reader:
    def __init__(self, content: bytes) -> None:
        self.content = content
        self.at = 0

    def take(self, form: str) -> tuple[Any, ...]:
        values = struct.unpack_from(form, self.content, self.at)
        self.at += struct.calcsize(form)
        return values

    def geometry(self, depth: int) -> dict[str, Any]:
        if depth > _DEEPEST:
            raise ValueError("the WKB geometry has too many collections in collections")
        (order,) = self.take("<B")
        if order > 1:
            raise ValueError(f"a WKB geometry cannot begin with the byte {order}")
        end = "<" if order else ">"
        (code,) = self.take(f"{end}I")
        has_z, has_m = bool(code & 0x80000000), bool(code & 0x40000000)
        if code & 0x20000000:
            self.take(f"{end}I")
        code &= 0x0FFFFFFF
        has_z, has_m = has_z or code // 1000 in (1, 3), has_m or code // 1000 in (2, 3)
        name = _NAMES.get(code % 1000) if code < 4000 else None
        if name is None:
            raise ValueError(f"WKB geometries of the type {code} are not supported")
        width = 2 + has_z + has_m
        kept = 2 + has_z

        def count(least: int) -> int:
            (number,) = self.take(f"{end}I")
            if number * least > len(self.content) - self.at:
                raise ValueError(f"the WKB geometry cannot have {number} parts in {len(self.content)} bytes")
            return number

        def point() -> list[float]:
            return list(self.take(f"{end}{width}d")[:kept])

        def points() -> list[list[float]]:
            return [point() for _ in range(count(8 * width))]

        if name == "Point":
            corner = point()
            # An empty point has coordinates that are no numbers.
            return {"type": name, "coordinates": [] if corner[0] != corner[0] else corner}
        if name == "LineString":
            return {"type": name, "coordinates": points()}
        if name == "Polygon":
            return {"type": name, "coordinates": [points() for _ in range(count(4))]}
        parts = [self.geometry(depth + 1) for _ in range(count(5))]
        if name == "GeometryCollection":
            return {"type": name, "geometries": parts}
        return {"type": name, "coordinates": [part["coordinates"] for part in parts]}
