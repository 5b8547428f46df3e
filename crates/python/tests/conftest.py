"""Fixtures of all tests."""

from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parents[3]


@pytest.fixture
def root() -> Path:
    """Folder of the repository, with its scripts and examples."""
    return ROOT


@pytest.fixture
def tower(root: Path) -> Path:
    return root / "scripts" / "tower.lua"


#: A fence of posts, as a script in memory.
FENCE = """
local count = param("count", { default = 3, min = 1, max = 1000000, step = 1, unit = "posts", doc = "Number of posts" })
local Post = module("Post", "left")
local fence = lsystem({ object = extruder({ sides = 4 }) })
fence:axiom(Post(count))
fence:rule("Post(left)", function(this, left)
  if left > 1 then
    return Post(0), Post(left - 1)
  end
end)
fence:interpret("Post", function(this) this:scale(0.1):extrude(1.2):shift(2, 0) end)
fence:derive(count)
"""

#: A script that runs until it is cancelled.
ENDLESS = """
local A = module("A", "n")
local endless = lsystem({ object = extruder({}) })
endless:axiom(A(0))
endless:rule("A(n)", function(this, n) return A(n + 1) end)
endless:interpret("A(n)", function(this, n) end)
endless:derive(1e8)
"""
