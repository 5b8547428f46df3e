"""Burgeon: procedural modelling by rewriting, with scripts in Lua.

``run`` runs a script and returns a ``Model``. Its arrays are NumPy arrays in the memory of the model, if NumPy is
installed. ``parameters`` lists what a script lets users change.
"""

from ._burgeon import VERSION as __version__
from ._difference import Change, Counts, Feature, ModelDifference
from ._errors import BurgeonWarning, Error, Problem
from ._model import Format, Instance, Layer, Material, Mesh, Model, Part, formats
from ._parameters import Parameter, parameters
from ._run import Progress, run
from ._tables import Table

__all__ = [
    "BurgeonWarning",
    "Change",
    "Counts",
    "Error",
    "Feature",
    "Format",
    "Instance",
    "Layer",
    "Material",
    "Mesh",
    "Model",
    "ModelDifference",
    "Parameter",
    "Part",
    "Problem",
    "Progress",
    "Table",
    "__version__",
    "formats",
    "parameters",
    "run",
]
