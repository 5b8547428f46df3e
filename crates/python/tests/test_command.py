"""The command of the package."""

import json
import shutil
import subprocess
import sys
from importlib import metadata

import burgeon


def command(*arguments, **options):
    program = [sys.executable, "-m", "burgeon", *map(str, arguments)]
    return subprocess.run(program, capture_output=True, text=True, **options)


def test_the_command_writes_models_and_has_the_exit_status_of_the_program(tower, tmp_path):
    done = command("run", tower, "--set", "floors=2", "-o", tmp_path / "a.glb", "--json")
    assert done.returncode == 0 and json.loads(done.stdout)["ok"], done.stderr
    assert (tmp_path / "a.glb").read_bytes() == burgeon.run(tower, values={"floors": 2}).to_bytes("glb")
    assert command("run", tmp_path / "missing.lua").returncode == 1
    assert command("rnu").returncode == 2
    version = command("--version").stdout.split()
    assert version == ["burgeon", burgeon.__version__] and metadata.version("burgeon") == burgeon.__version__


def test_the_console_script_is_installed(tmp_path):
    program = shutil.which("burgeon", path=str(__import__("pathlib").Path(sys.executable).parent))
    assert program, "the environment has no command burgeon"
    done = subprocess.run([program, "new", "tree"], cwd=tmp_path, capture_output=True, text=True)
    assert done.returncode == 0 and (tmp_path / "tree.lua").is_file(), done.stderr
