"""Examples: the page of the book, the notebooks, and docstrings."""

import json
import re
import subprocess
import sys
import warnings

import pytest

import burgeon


def run_blocks(blocks, folder, monkeypatch):
    subprocess.run([sys.executable, "-m", "burgeon", "new", "tree"], cwd=folder, check=True, capture_output=True)
    monkeypatch.chdir(folder)
    names = {}
    for block in blocks:
        exec(compile(block, "block", "exec"), names)
    return names


def test_every_block_of_the_page_runs(root, tmp_path, monkeypatch):
    page = (root / "docs/book/src/python.md").read_text()
    blocks = re.findall(r"```python\n(.*?)```", page, re.DOTALL)
    assert len(blocks) > 6
    names = run_blocks(blocks, tmp_path, monkeypatch)
    assert (tmp_path / "tree.png").stat().st_size > 1000 and len(names["forest"]) == 8


@pytest.mark.parametrize("name", ["forest", "town"])
def test_a_notebook_runs_from_the_first_cell_to_the_last(name, root, tmp_path, monkeypatch):
    path = root / "examples" / "notebooks" / f"{name}.ipynb"
    assert path.stat().st_size < 100_000
    notebook = json.loads(path.read_text())
    cells = ["".join(cell["source"]) for cell in notebook["cells"] if cell["cell_type"] == "code"]
    assert len(cells) > 3 and all(not cell.get("outputs") for cell in notebook["cells"])
    with warnings.catch_warnings():
        warnings.filterwarnings("error", category=burgeon.BurgeonWarning)
        run_blocks(cells, tmp_path, monkeypatch)


def test_public_names_have_docstrings():
    public = [getattr(burgeon, name) for name in burgeon.__all__ if not name.startswith("_")]
    missing = [it for it in public if not it.__doc__]
    for owner in (burgeon.Model, burgeon.Part, burgeon.Table):
        members = [it for name, it in vars(owner).items() if not name.startswith("_")]
        missing += [it for it in members if not getattr(it, "__doc__", None)]
    assert missing == []
