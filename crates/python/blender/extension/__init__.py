"""Burgeon in Blender: a panel with a script and its parameters, whose model follows every change.

``properties`` declares what a collection stores, ``values`` the parameters of a script, ``work`` runs scripts beside the
user interface, ``scene`` turns a model into objects, and ``panel`` shows everything.
"""

import warnings

import burgeon

from . import panel, properties, values, work

MODULES = (properties, panel, values, work)


def register() -> None:
    # The panel shows the warnings of models.
    warnings.simplefilter("ignore", burgeon.BurgeonWarning)
    for module in MODULES:
        module.register()


def unregister() -> None:
    for module in reversed(MODULES):
        module.unregister()
