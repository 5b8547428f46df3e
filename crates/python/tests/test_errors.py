"""Errors and warnings: place, remedy, and arguments that are refused."""

import pickle
import warnings

import pytest

import burgeon
from conftest import FENCE


#: A script whose model is empty, which is worth a warning.
EMPTY = """
local A = module("A")
local empty = lsystem({ object = turtle() })
empty:axiom(A())
empty:derive(1)
"""


def run(script, **options):
    return burgeon.run("s.lua", loader={"s.lua": script}, **options)


def test_an_error_has_the_file_the_line_and_the_remedy(tmp_path):
    path = tmp_path / "it's \"a\" 🌳.lua"
    path.write_text("\n\nlocal tree = lsystem({ object = turtel({}) })")
    with pytest.raises(burgeon.Error) as caught:
        burgeon.run(path)
    error = caught.value
    assert (error.file, error.line) == (str(path), 3)
    assert error.remedy == "did you mean turtle?" and "turtel" in error.message and str(path) in str(error)


def test_all_problems_of_a_script_come_together():
    with pytest.raises(burgeon.Error) as caught:
        run("local a = lsystem({ object = turtel({}) })\nlocal b = lsystem({ object = extrudr({}) })")
    assert [problem.line for problem in caught.value.problems] == [1, 2]


def test_errors_and_warnings_can_be_pickled():
    with pytest.raises(burgeon.Error) as caught:
        run("local x =")
    copy = pickle.loads(pickle.dumps(caught.value))
    assert (str(copy), copy.line, copy.problems) == (str(caught.value), 1, caught.value.problems)
    with pytest.warns(burgeon.BurgeonWarning) as shown:
        run(EMPTY)
    copy = pickle.loads(pickle.dumps(shown[0].message))
    assert (str(copy), copy.kind, copy.line) == (str(shown[0].message), shown[0].message.kind, shown[0].message.line)


def test_warnings_belong_to_the_line_that_called_run():
    with pytest.warns(burgeon.BurgeonWarning) as shown:
        run(EMPTY)
    assert shown[0].filename == __file__ and shown[0].message.kind
    with warnings.catch_warnings():
        warnings.filterwarnings("error", category=burgeon.BurgeonWarning)
        with pytest.raises(burgeon.BurgeonWarning):
            run(EMPTY)


def test_a_strict_run_raises_the_first_warning():
    with pytest.raises(burgeon.Error):
        run(EMPTY, strict=True)


@pytest.mark.parametrize(
    ("options", "kind"),
    [
        ({"seed": -1}, ValueError),
        ({"seed": 2**64}, ValueError),
        ({"seed": "3"}, TypeError),
        ({"values": {3: 4}}, TypeError),
        ({"values": {"count": object()}}, TypeError),
        ({"values": {"count": float("nan")}}, burgeon.Error),
        ({"values": {"count": 0}}, burgeon.Error),
        ({"values": {"cuont": 3}}, burgeon.Error),
        ({"lod": 4}, ValueError),
        ({"time_limit": 0}, ValueError),
        ({"time_limit": float("inf")}, ValueError),
        ({"threads": -2}, ValueError),
        ({"data": "no such folder"}, burgeon.Error),
        ({"module_limit": 2, "values": {"count": 50}}, burgeon.Error),
        ({"sources": {"a/b": []}}, ValueError),
        ({"preset": "small"}, burgeon.Error),
    ],
)
def test_wrong_arguments_are_refused(options, kind):
    with pytest.raises(kind):
        run(FENCE, **options)


def test_values_of_numpy_and_names_with_quotes_and_emoji_are_accepted():
    import numpy

    script = FENCE.replace('"count"', '"it\'s 🌳"', 1)
    model = run(script, values={"it's 🌳": numpy.int64(4)}, seed=numpy.uint8(3))
    assert model.values == {"it's 🌳": 4} and model.seed == 3


def test_parameters_have_bounds_choices_and_units(tower):
    floors = burgeon.parameters(tower)["floors"]
    assert (floors.kind, floors.default, floors.min, floors.max, floors.step) == ("number", 24, 1, 120, 1)
    assert floors.doc == "Storeys of the tower" and burgeon.parameters(tower)["stone"].kind == "color"
    script = 'local kind = param("kind", { default = "hip", choices = { "hip", "flat" }, unit = "roof" })'
    kind = burgeon.parameters("s.lua", loader={"s.lua": script}, values={"kind": "flat"})["kind"]
    assert (kind.choices, kind.value, kind.default, kind.unit) == (("hip", "flat"), "flat", "hip", "roof")
