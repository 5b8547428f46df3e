"""Differences of two models."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, Generic, TypeVar

if TYPE_CHECKING:
    from ._model import Material

T = TypeVar("T")


@dataclass(frozen=True)
class Feature:
    """A feature that a model shows."""

    #: Index of its system in the script, from 0, if known.
    system: int | None
    #: Id, unique within the system.
    id: str


@dataclass(frozen=True)
class Counts:
    """Numbers of a model."""

    #: Triangles of all instances.
    triangles: int
    instances: int
    meshes: int
    materials: int


@dataclass(frozen=True)
class Change(Generic[T]):
    """A value of the earlier and of the later model."""

    before: T
    after: T


@dataclass(frozen=True)
class ModelDifference:
    """What changes from a model to a later one. It is false if both show the same."""

    #: Features that only the later model shows.
    added: list[Feature]
    #: Features that only the earlier model shows.
    removed: list[Feature]
    #: Features that both models show with different shapes, positions or materials.
    changed: list[Feature]
    #: Number of features that both models show alike.
    unchanged: int
    #: Set if what belongs to no feature differs.
    others_changed: bool
    materials_added: list[Material]
    materials_removed: list[Material]
    #: Materials of the same name with different properties.
    materials_changed: list[Change[Material]]
    counts: Change[Counts]
    #: Minimum and maximum corners (m) of the bounding boxes; ``None`` for an empty model.
    bounds: Change[list[list[float]] | None]
    is_empty: bool

    def __bool__(self) -> bool:
        return not self.is_empty


def difference_of(facts: dict[str, Any], material: Callable[[dict[str, Any]], Material]) -> ModelDifference:
    """Returns the difference that ``facts`` describe; ``material`` makes a material of its fields."""
    for name in ("added", "removed", "changed"):
        facts[name] = [Feature(system, id) for system, id in facts[name]]
    for name in ("materials_added", "materials_removed"):
        facts[name] = [material(fields) for fields in facts[name]]
    pairs = facts["materials_changed"]
    facts["materials_changed"] = [Change(material(before), material(after)) for before, after in pairs]
    facts["counts"] = Change(*(Counts(**counts) for counts in facts["counts"]))
    facts["bounds"] = Change(*facts["bounds"])
    return ModelDifference(**facts)
