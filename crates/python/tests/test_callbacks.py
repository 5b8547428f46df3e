"""Functions of Python that runs call, interrupts and threads."""

import os
import signal
import subprocess
import sys
import threading
import time
from concurrent.futures import ThreadPoolExecutor

import pytest

import burgeon
from conftest import ENDLESS, FENCE


def test_progress_has_numbers_and_its_exception_cancels_the_run():
    seen = []

    def progress(state):
        seen.append(state)
        if len(seen) == 3:
            raise KeyError("🌳")

    begin = time.monotonic()
    with pytest.raises(KeyError, match="🌳"):
        burgeon.run("s.lua", loader={"s.lua": ENDLESS}, progress=progress)
    assert time.monotonic() - begin < 20
    assert len(seen) == 3 and seen[2].step > seen[0].step and seen[2].modules > 0 and "step" in seen[2].text


def test_printed_texts_arrive_in_order_and_an_exception_cancels_the_run():
    texts = []
    script = 'for i = 1, 100 do print(i, "🌳") end\n' + FENCE
    burgeon.run("s.lua", loader={"s.lua": script}, print=texts.append)
    assert texts == [f"{number}\t🌳" for number in range(1, 101)]

    def refuse(text):
        raise OSError(text)

    with pytest.raises(OSError, match="1"):
        burgeon.run("s.lua", loader={"s.lua": script + ENDLESS}, print=refuse)


def test_an_exception_in_a_loader_is_raised_as_it_is():
    def load(name):
        raise PermissionError(name)

    texts = {"s.lua": "require('part')"}
    with pytest.raises(PermissionError, match="s.lua"):
        burgeon.run("s.lua", loader=load)
    with pytest.raises(PermissionError, match="part.lua"):
        burgeon.run("s.lua", loader=lambda name: load(name) if name == "part.lua" else texts.get(name))
    with pytest.raises(PermissionError, match="s.lua"):
        burgeon.parameters("s.lua", loader=load)


def test_an_interrupt_cancels_a_run():
    threading.Timer(0.5, os.kill, (os.getpid(), signal.SIGINT)).start()
    begin = time.monotonic()
    with pytest.raises(KeyboardInterrupt):
        burgeon.run("s.lua", loader={"s.lua": ENDLESS})
    assert 0.3 < time.monotonic() - begin < 20
    # The next cell works as before.
    assert burgeon.run("s.lua", loader={"s.lua": FENCE}).triangle_count > 0


def test_a_time_limit_ends_a_run():
    with pytest.raises(burgeon.Error) as caught:
        burgeon.run("s.lua", loader={"s.lua": ENDLESS}, time_limit=0.3)
    assert caught.value.code == "limit.time"


def test_a_memory_limit_ends_a_run():
    script = "local all = {} for i = 1, 1e8 do all[i] = { i, i } end"
    with pytest.raises(burgeon.Error) as caught:
        burgeon.run("s.lua", loader={"s.lua": script}, memory_limit=100)
    assert caught.value.code == "limit.memory"


def test_other_threads_work_during_a_run():
    count = 0
    stop = threading.Event()

    def work():
        nonlocal count
        while not stop.is_set():
            count += 1
            time.sleep(0.001)

    thread = threading.Thread(target=work)
    thread.start()
    with pytest.raises(burgeon.Error):
        burgeon.run("s.lua", loader={"s.lua": ENDLESS}, time_limit=0.5, threads=1)
    stop.set()
    thread.join()
    assert count > 20


def test_many_runs_at_once_give_the_models_of_single_runs(root):
    script = root / "scripts" / "bush.lua"
    with ThreadPoolExecutor(8) as pool:
        models = list(pool.map(lambda seed: burgeon.run(script, seed=seed, threads=1).to_bytes("glb"), range(16)))
    assert models[5] == burgeon.run(script, seed=5).to_bytes("glb") and len(set(models)) > 10


def test_malloc_of_the_process_is_not_replaced(tower):
    compiled = burgeon._burgeon.__file__
    symbols = subprocess.run(["nm", "-D", "--defined-only", compiled], capture_output=True, text=True)
    if symbols.returncode == 0:
        names = {line.split()[-1].split("@")[0] for line in symbols.stdout.splitlines()}
        assert "PyInit__burgeon" in names
        assert not names & {"malloc", "free", "calloc", "realloc", "_Znwm", "mi_malloc"}, names
    code = f"""
import ctypes, burgeon, numpy
address = lambda name: ctypes.cast(getattr(ctypes.CDLL(None), name), ctypes.c_void_p).value
libc = ctypes.CDLL("libc.so.6")
for name in ["malloc", "free", "realloc"]:
    assert address(name) == ctypes.cast(getattr(libc, name), ctypes.c_void_p).value, name
model = burgeon.run({str(tower)!r})
assert numpy.concatenate([part.positions for mesh in model.meshes for part in mesh.parts]).size > 100
assert b"mimalloc" not in open({compiled!r}, "rb").read()
"""
    if sys.platform == "linux":
        subprocess.run([sys.executable, "-c", code], check=True)
