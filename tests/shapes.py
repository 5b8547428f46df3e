"""Compares solids and plans of random trees of shape operations with manifold3d and shapely.

    python3 tests/shapes.py BURGEON [TREES [SEED]]

Needs numpy, manifold3d and shapely. Each tree combines random convex solids by unions, differences, intersections and cuts by
planes; each plan is a random polygon with a hole that is offset, set back and split.
"""

import json
import math
import pathlib
import random
import re
import subprocess
import sys
import tempfile

import manifold3d
import numpy
import shapely

# Largest relative error of a volume or an area, and the size (m³, m²) below which the error is absolute.
ERROR, LEAST = 1e-6, 1e-2

PRELUDE = """
local function both(a: Shape?, b: Shape?): Shape?
  return if a and b then a:union(b) else a or b
end
local function less(a: Shape?, b: Shape?): Shape?
  return if a and b then a:subtract(b) else a
end
local function common(a: Shape?, b: Shape?): Shape?
  return if a and b then a:intersect(b) else nil
end
local function below(a: Shape?, x: number, y: number, z: number, nx: number, ny: number, nz: number): Shape?
  return if a then a:trim(vec(x, y, z), vec(nx, ny, nz)) else nil
end
local function area(shapes: { Shape }): number
  local sum = 0
  for _, part in shapes do
    sum += part:area()
  end
  return sum
end
local function tell(name: string, ...: number)
  print(`{name} {table.concat({ ... } :: { any }, " ")}`)
end
local function solid(number: number, shape: Shape?)
  if shape then
    tell(`solid {number}`, shape:volume(), shape:area(), shape:open_edges())
  else
    tell(`solid {number}`, 0, 0, 0)
  end
end
local function corners(number: number, shape: Shape)
  for _, at in shape:points() do
    tell(`corner {number}`, at.x, at.y, at.z)
  end
end
"""


class Trees:
    """Random trees, as Lua and as functions of the primitives' solids."""

    def __init__(self, generator):
        self.random = generator
        self.primitives = []

    def primitive(self):
        number = self.random.uniform
        size = lambda: round(number(0.5, 3.0), 3)
        kind = self.random.choice(["cuboid", "cylinder", "cone", "ball"])
        sides = self.random.randint(3, 12)
        text = {
            "cuboid": f"cuboid({size()}, {size()}, {size()})",
            "cylinder": f"cylinder({size()}, {size()}, {sides})",
            "cone": f"cone({size()}, {size()}, {sides})",
            "ball": f"ball({size()}, {max(sides, 4)})",
        }[kind]
        if self.random.random() < 0.6:
            axis = ", ".join(f"{number(-1, 1):.3f}" for _ in range(3))
            text += f":rotate({number(-180, 180):.3f}, vec({axis}))"
        # Whole steps make faces and edges coincide.
        step = self.random.choice([1, 1000])
        offset = ", ".join(str(round(number(-2, 2) * step) / step) for _ in range(3))
        text += f":translate(vec({offset}))"
        self.primitives.append(text)
        index = len(self.primitives)
        return f"p[{index}]", lambda solids: solids[index]

    def tree(self, depth):
        if depth == 0 or self.random.random() < 0.15:
            return self.primitive()
        kind = self.random.choice(["both", "less", "common", "both", "less", "below"])
        text, make = self.tree(depth - 1)
        if kind == "below":
            at = [round(self.random.uniform(-1, 1), 3) for _ in range(3)]
            normal = numpy.array([self.random.uniform(-1, 1) for _ in range(3)])
            normal = [round(x, 6) for x in normal / numpy.linalg.norm(normal)]
            length = math.sqrt(sum(x * x for x in normal))
            unit = [x / length for x in normal]
            height = sum(x * y for x, y in zip(at, unit))
            text = f"below({text}, {', '.join(map(str, at + normal))})"
            return text, lambda solids: make(solids).trim_by_plane([-x for x in unit], -height)
        other, make_other = self.tree(depth - 1)
        operation = {"both": lambda a, b: a + b, "less": lambda a, b: a - b, "common": lambda a, b: a ^ b}[kind]
        return f"{kind}({text}, {other})", lambda solids: operation(make(solids), make_other(solids))


def polygon(generator):
    """Returns a random polygon with a hole, if one fits."""
    def ring(least, most, count):
        turn = generator.uniform(0, 1)
        angles = [2 * math.pi * (step + turn) / count for step in range(count)]
        radii = [generator.uniform(least, most) for _ in angles]
        return [(round(r * math.cos(a), 3), round(r * math.sin(a), 3)) for r, a in zip(radii, angles)]

    outer = ring(4, 10, generator.randint(3, 12))
    found = shapely.Polygon(outer)
    hole = ring(0.6, 1.6, generator.randint(3, 7))[::-1]
    with_hole = shapely.Polygon(outer, [hole])
    if generator.random() < 0.5 and with_hole.is_valid and found.buffer(-0.5).contains(shapely.Polygon(hole)):
        return with_hole
    return found


def lua_rings(plan):
    rings = [plan.exterior, *plan.interiors]
    points = lambda ring: ", ".join(f"{{ {x}, {y} }}" for x, y in ring.coords[:-1])
    return "{ " + ", ".join(f"{{ {points(ring)} }}" for ring in rings) + " }"


def run(burgeon, script, folder):
    """Runs a script, and returns the printed lines by their first words, and the warnings."""
    path = pathlib.Path(folder) / "shapes.lua"
    path.write_text(script)
    done = subprocess.run(
        [burgeon, "run", "--json", "--time-limit", "600", str(path)], capture_output=True, text=True, check=False
    )
    if done.returncode != 0:
        raise SystemExit(done.stdout + done.stderr)
    lines = {}
    for line in done.stderr.splitlines():
        words = line.split()
        if len(words) > 2 and words[0] in ("solid", "corner", "plan"):
            lines.setdefault((words[0], int(words[1])), []).append([float(word) for word in words[2:]])
    return lines, json.loads(done.stdout)["warnings"]


def differs(found, wanted):
    return abs(found - wanted) > ERROR * max(abs(wanted), LEAST)


def compare_solids(burgeon, count, seed, folder):
    generator = random.Random(seed)
    trees = Trees(generator)
    built = [trees.tree(generator.randint(1, 3)) for _ in range(count)]
    lines = [PRELUDE, "local p: { Shape } = {}"]
    for index, text in enumerate(trees.primitives, 1):
        lines += [f"p[{index}] = {text}", f"corners({index}, p[{index}])"]
    lines += [f"solid({index}, {text})" for index, (text, _) in enumerate(built)]
    printed, warnings = run(burgeon, "\n".join(lines), folder)
    solids = {
        index: manifold3d.Manifold.hull_points(numpy.array(printed["corner", index]))
        for index in range(1, len(trees.primitives) + 1)
    }
    wrong = []
    for index, (text, make) in enumerate(built):
        wanted = make(solids)
        if wanted.status() != manifold3d.Error.NoError:
            continue
        volume, area, open_edges = printed["solid", index][0]
        if open_edges or differs(volume, wanted.volume()) or (
            volume > LEAST and differs(area, wanted.surface_area())
        ):
            used = re.sub(r"p\[(\d+)\]", lambda found: trees.primitives[int(found[1]) - 1], text)
            wrong.append(f"{used}: {volume} m³, {area} m², {open_edges} open edges; manifold3d has "
                         f"{wanted.volume()} m³, {wanted.surface_area()} m², {wanted.status()}")
    return wrong, warnings


def compare_plans(burgeon, count, seed, folder):
    generator = random.Random(seed)
    lines, plans = [PRELUDE], []
    for index in range(count):
        plan = polygon(generator)
        out, into = round(generator.uniform(0.1, 0.4), 3), round(generator.uniform(0.1, 3), 3)
        cut = round(generator.uniform(-3, 3), 3)
        plans.append((plan, out, into, cut))
        lines.append(
            f"do local s: Shape = shape({lua_rings(plan)}) "
            f"tell('plan {index}', s:area(), area(s:offset({out})), area(s:setback({into})), area(s:offset(-{into})), "
            f"area({{ s:trim(vec({cut}, 0, 0), vec(1, 0, 0)) }}), s:extrude(2):volume(), area(s:border({into}))) end"
        )
    printed, warnings = run(burgeon, "\n".join(lines), folder)
    wrong = []
    for index, (plan, out, into, cut) in enumerate(plans):
        offset = lambda distance: plan.buffer(distance, join_style="mitre", mitre_limit=1e6).area
        half = plan.intersection(shapely.box(-100, -100, cut, 100)).area
        inner = offset(-into)
        wanted = [plan.area, offset(out), inner, inner, half, 2 * plan.area, plan.area - inner]
        found = printed["plan", index][0]
        names = ["area", "outwards", "setback", "inwards", "half", "volume", "border"]
        for name, own, other in zip(names, found, wanted):
            if differs(own, other):
                wrong.append(f"{lua_rings(plan)}: {name} is {own}, shapely has {other} ({out}, {into}, {cut})")
    return wrong, warnings


def main():
    burgeon = sys.argv[1]
    count = int(sys.argv[2]) if len(sys.argv) > 2 else 1000
    seed = int(sys.argv[3]) if len(sys.argv) > 3 else 1
    wrong, warned = [], []
    with tempfile.TemporaryDirectory() as folder:
        for begin in range(0, count, 500):
            some = min(500, count - begin)
            for compare in [compare_solids, compare_plans]:
                failures, warnings = compare(burgeon, some, seed + begin, folder)
                wrong += failures
                warned += warnings
    for text in wrong[:20] + warned[:20]:
        print(text)
    print(f"{count} trees and {count} plans, {len(wrong)} differ, {len(warned)} warnings")
    sys.exit(1 if wrong or warned else 0)


if __name__ == "__main__":
    main()
