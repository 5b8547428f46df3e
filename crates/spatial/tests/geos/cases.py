"""Writes cases.json: geometries, pairs of them, and what GEOS makes of them, for tests/geos.rs.

    python3 -m venv venv && venv/bin/pip install shapely && venv/bin/python cases.py > cases.json

All geometries are made here, from the seed. Each result is told by measures that say nothing of the order of points:
the area, the length of lines, how many single points, and the centre.
"""

import json
import math
import random
import sys

import shapely
import shapely.affinity
from shapely import geometry as g
from shapely.ops import substring

random.seed(16)

HAND = [
    "POINT EMPTY", "LINESTRING EMPTY", "POLYGON EMPTY", "MULTIPOINT EMPTY", "GEOMETRYCOLLECTION EMPTY",
    "POINT (1 2)", "POINT (0 0)", "POINT (5 0)", "POINT (10 5)", "POINT (5 5)",
    "MULTIPOINT ((0 0), (5 5), (20 20))", "MULTIPOINT ((2 2), (2 2), (8 2))",
    "LINESTRING (0 0, 10 0)", "LINESTRING (0 0, 10 10)", "LINESTRING (-5 5, 15 5)", "LINESTRING (0 0, 5 0, 10 0)",
    "LINESTRING (0 10, 10 0)", "LINESTRING (5 -5, 5 15)", "LINESTRING (0 0, 10 0, 10 10, 0 10, 0 0)",
    "LINESTRING (0 0, 10 10, 10 0, 0 10)", "LINESTRING (2 0, 8 0, 8 3)", "LINESTRING (10 0, 10 10)",
    "LINESTRING (0 0, 4 0, 4 4, 2 4, 2 -2)", "LINESTRING (3 3, 3 3, 6 6)",
    "MULTILINESTRING ((0 0, 5 5), (5 5, 10 0))", "MULTILINESTRING ((0 0, 10 10), (0 10, 10 0))",
    "MULTILINESTRING ((0 0, 1 0), (1 0, 2 0), (1 0, 1 1))",
    "POLYGON ((0 0, 10 0, 10 10, 0 10, 0 0))", "POLYGON ((10 0, 20 0, 20 10, 10 10, 10 0))",
    "POLYGON ((10 2, 20 2, 20 8, 10 8, 10 2))", "POLYGON ((10 10, 20 10, 20 20, 10 20, 10 10))",
    "POLYGON ((5 5, 15 5, 15 15, 5 15, 5 5))", "POLYGON ((2 2, 8 2, 8 8, 2 8, 2 2))",
    "POLYGON ((0 0, 10 0, 10 10, 0 10, 0 0), (2 2, 8 2, 8 8, 2 8, 2 2))",
    "POLYGON ((0 0, 10 0, 10 10, 0 10, 0 0), (0 0, 6 2, 2 6, 0 0))",
    "POLYGON ((0 0, 10 0, 10 10, 0 10, 0 0), (2 2, 4 2, 4 4, 2 4, 2 2), (4 4, 6 4, 6 6, 4 6, 4 4))",
    "POLYGON ((0 0, 10 0, 10 10, 5 0.001, 0 10, 0 0))", "POLYGON ((0 0, 100 0.01, 0 0.02, 0 0))",
    "POLYGON ((0 0, 10 0, 10 3, 3 3, 3 7, 10 7, 10 10, 0 10, 0 0))", "POLYGON ((4 4, 12 4, 12 6, 4 6, 4 4))",
    "POLYGON ((3 3, 10 3, 10 7, 3 7, 3 3))", "POLYGON ((0 0, 5 5, 10 0, 0 0))", "POLYGON ((0 10, 5 5, 10 10, 0 10))",
    "MULTIPOLYGON (((0 0, 4 0, 4 4, 0 4, 0 0)), ((4 4, 8 4, 8 8, 4 8, 4 4)))",
    "MULTIPOLYGON (((0 0, 10 0, 10 10, 0 10, 0 0), (2 2, 8 2, 8 8, 2 8, 2 2)), ((4 4, 6 4, 6 6, 4 6, 4 4)))",
    "GEOMETRYCOLLECTION (POINT (12 5), LINESTRING (10 5, 11 5))",
]
ODD = [
    "POLYGON ((0 0, 10 10, 10 0, 0 10, 0 0))", "POLYGON ((0 0, 4 0, 4 4, 8 4, 8 8, 4 8, 4 4, 0 4, 0 0))",
    "POLYGON ((0 0, 10 0, 10 10, 0 10, 0 0), (5 5, 15 5, 15 8, 5 8, 5 5))",
    "POLYGON ((0 0, 10 0, 10 10, 0 10, 0 0), (20 20, 22 20, 22 22, 20 22, 20 20))",
    "POLYGON ((0 0, 5 0, 5 5, 5 0, 10 0, 10 10, 0 10, 0 0))", "LINESTRING (3 3, 3 3)",
    "MULTIPOLYGON (((0 0, 6 0, 6 6, 0 6, 0 0)), ((3 3, 9 3, 9 9, 3 9, 3 3)))",
]


def number(value):
    return float(f"{value:.6g}") if abs(value) < 1e5 else round(value, 3)


def star(x, y, least, most, count, far=0.0):
    angles = sorted(random.uniform(0, 2 * math.pi) for _ in range(count))
    ring = []
    for angle in angles:
        reach = random.uniform(least, most)
        ring.append((number(far + x + reach * math.cos(angle)), number(far + y + reach * math.sin(angle))))
    return g.Polygon(ring)


def made():
    found = []
    while len(found) < 60:
        far = random.choice([0.0, 0.0, 0.0, 1e6])
        x, y = random.uniform(0, 12), random.uniform(0, 12)
        shape = random.choice(["star", "star", "grid", "line", "walk", "holed", "points"])
        if shape == "star":
            one = star(x, y, 1, 7, random.randint(3, 12), far)
        elif shape == "grid":
            one = shapely.union_all([g.box(far + i, far + j, far + i + 2, far + j + 2)
                                     for i, j in ((random.randint(0, 9), random.randint(0, 9)) for _ in range(4))])
        elif shape == "holed":
            outer, inner = star(x, y, 5, 8, 9, far), star(x, y, 1, 2, 5, far)
            one = outer.difference(inner) if outer.is_valid and inner.is_valid else outer
            one = shapely.from_wkt(shapely.to_wkt(one, rounding_precision=3))
        elif shape == "points":
            one = g.MultiPoint([(far + random.randint(0, 12), far + random.randint(0, 12)) for _ in range(3)])
        else:
            whole = shape == "walk"
            one = g.LineString([(far + (random.randint(0, 12) if whole else number(random.uniform(0, 12))),
                                 far + (random.randint(0, 12) if whole else number(random.uniform(0, 12))))
                                for _ in range(random.randint(2, 6))])
        if one.is_valid and not one.is_empty:
            found.append((far, one))
    return found


def measures(shape):
    """Area, length of lines, number of single points, and the centre."""
    shape = shapely.force_2d(shape)
    area = length = points = 0
    for part in (shape.geoms if hasattr(shape, "geoms") else [shape]):
        if hasattr(part, "geoms"):
            inner = measures(part)
            area, length, points = area + inner[0], length + inner[1], points + inner[2]
        elif part.is_empty:
            continue
        elif part.geom_type == "Point":
            points += 1
        elif part.geom_type in ("LineString", "LinearRing"):
            length += part.length
        else:
            area += part.area
    centre = shape.centroid
    at = [] if centre.is_empty else [centre.x, centre.y]
    return [round(value, 9) for value in (area, length, points, *at)]


def of_one(shape):
    """At the origin, where GEOS has all of its digits; the test moves it where it was."""
    case = {"wkt": shapely.to_wkt(shape, rounding_precision=-1), "valid": shape.is_valid}
    case["measures"] = measures(shape)
    case["perimeter"] = sum(it.length for it in shapely.get_parts(shape) if it.area > 0) if shape.area else 0
    if not shape.is_valid:
        case["made_valid"] = measures(shapely.make_valid(shape))[0]
        return case
    if shape.is_empty:
        return case
    bounds = shape.bounds
    near = shapely.affinity.translate(shape, -bounds[0], -bounds[1])
    case["bounds"] = bounds
    case["hull"] = measures(shape.convex_hull)
    case["oriented"] = near.oriented_envelope.area
    case["boundary"] = measures(shape.boundary) if shape.geom_type != "GeometryCollection" else None
    case["points"] = int(shapely.get_num_coordinates(shape))
    case["buffers"] = [
        [distance, join, cap, near.buffer(distance, quad_segs=8, join_style=join, cap_style=cap, mitre_limit=5).area]
        for distance, join, cap in [(1.5, "round", "round"), (0.7, "mitre", "flat"), (1, "bevel", "square"),
                                    (-0.5, "round", "round")]
    ]
    case["simplified"] = measures(shape.simplify(0.6, preserve_topology=False))
    if shape.geom_type == "LineString" and shape.length > 0:
        case["interpolated"] = [[part, *shape.interpolate(part, normalized=True).coords[0]] for part in (0, 0.3, 1)]
        case["substring"] = substring(near, 0.2, 0.7, normalized=True).length
        case["located"] = [[x, y, shape.project(g.Point(bounds[0] + x, bounds[1] + y), normalized=True)]
                           for x, y in ((3, 1), (-2, 7))]
        if shape.is_simple and not shape.is_closed:
            case["offsets"] = [[d, near.offset_curve(d, quad_segs=8, join_style="round").length] for d in (0.3, -0.3)]
    return case


def of_two(a, b):
    case = {"a": shapely.to_wkt(a, rounding_precision=-1), "b": shapely.to_wkt(b, rounding_precision=-1)}
    case["relate"] = a.relate(b)
    case["is"] = [name for name in ("intersects", "contains", "within", "touches", "crosses", "overlaps", "covers",
                                    "equals", "disjoint") if getattr(a, name)(b)]
    case["distance"] = None if a.is_empty or b.is_empty else a.distance(b)
    for name in ("intersection", "union", "difference", "symmetric_difference"):
        case[name] = measures(getattr(a, name)(b))
    return case


def main():
    hand = [shapely.from_wkt(text) for text in HAND]
    random_ones = made()
    odd = [shapely.from_wkt(text) for text in ODD]
    ones = [of_one(shape) for shape in hand + odd + [shape for _, shape in random_ones]]
    pairs = [(a, b) for a in hand for b in hand]
    random.shuffle(pairs)
    # GEOS has operations on collections of mixed kinds for some pairs only.
    mixed = lambda shape: shape.geom_type == "GeometryCollection" and not shape.is_empty
    # It leaves points twice that are, as long as nothing else is to be done.
    twice = lambda shape: shape.geom_type == "MultiPoint" and len({it.wkt for it in shape.geoms}) < len(shape.geoms)
    pairs = [pair for pair in pairs if not any(mixed(it) or twice(it) for it in pair)][:330]
    for far in (0.0, 1e6):
        same = [shape for at, shape in random_ones if at == far]
        pairs += [tuple(random.sample(same, 2)) for _ in range(100 if far == 0.0 else 40)]
    twos = [of_two(a, b) for a, b in pairs]
    engine = f"shapely {shapely.__version__}, GEOS {shapely.geos_version_string}"
    json.dump({"engine": engine, "ones": ones, "twos": twos}, sys.stdout, separators=(",", ":"))
    print()


main()
