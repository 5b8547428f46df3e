"""Exceptions and warnings, with the file, the line and the remedy."""

from __future__ import annotations

import json
import warnings
from dataclasses import dataclass
from typing import Any


@dataclass(frozen=True)
class Problem:
    """A problem in a script, in its data or in the arguments of a call.

    ``code`` is stable across versions; ``burgeon api errors`` lists the codes.
    """

    #: Complete text, with place and remedy.
    text: str
    #: Machine-readable name of the kind.
    code: str
    #: Message without place and remedy.
    message: str
    #: File as the caller named it, if known.
    file: str | None = None
    #: Line, from 1, if known.
    line: int | None = None
    #: Suggested fix, if there is one.
    remedy: str | None = None
    #: Rule of the script, if one was running.
    rule: str | None = None
    #: Module with its parameters, if one was rewritten or interpreted.
    module: str | None = None
    #: Derivation step, if known.
    step: int | None = None

    @classmethod
    def _of(cls, fields: dict[str, Any]) -> Problem:
        return cls(
            text=fields["text"],
            code=fields["code"],
            message=fields["message"],
            file=fields.get("file"),
            line=fields.get("line"),
            remedy=fields.get("help"),
            rule=fields.get("rule"),
            module=fields.get("module"),
            step=fields.get("step"),
        )


class Error(Exception):
    """An error of a script, of its data or of an argument.

    The attributes ``code``, ``message``, ``file``, ``line``, ``remedy``, ``rule``, ``module`` and ``step`` describe the
    first problem, ``problems`` all that were found together.
    """

    #: All problems, at least one.
    problems: tuple[Problem, ...]

    def __init__(self, text: str, problems: tuple[Problem, ...] = ()) -> None:
        super().__init__(text)
        self.problems = problems or (Problem(text=text, code="other", message=text),)
        first = self.problems[0]
        self.code = first.code
        self.message = first.message
        self.file = first.file
        self.line = first.line
        self.remedy = first.remedy
        self.rule = first.rule
        self.module = first.module
        self.step = first.step

    def __reduce__(self) -> tuple[Any, ...]:
        return (type(self), (str(self), self.problems))

    @classmethod
    def _from_json(cls, content: str) -> Error:
        fields = json.loads(content)
        return cls(fields["text"], tuple(Problem._of(problem) for problem in fields["problems"]))


class BurgeonWarning(UserWarning):
    """A warning of a successful run; ``problem`` describes it, and ``count`` tells how often it occurred."""

    def __init__(self, text: str, problem: Problem | None = None, kind: str = "", count: int = 1) -> None:
        super().__init__(text)
        self.problem = problem or Problem(text=text, code=kind, message=text)
        self.kind = kind
        self.count = count
        self.file = self.problem.file
        self.line = self.problem.line
        self.remedy = self.problem.remedy

    def __reduce__(self) -> tuple[Any, ...]:
        return (type(self), (str(self), self.problem, self.kind, self.count))

    @classmethod
    def _of(cls, fields: dict[str, Any]) -> BurgeonWarning:
        return cls(fields["text"], Problem._of(fields), fields.get("kind", ""), fields.get("count", 1))


def show(found: list[BurgeonWarning], stacklevel: int) -> None:
    """Shows warnings in the usual way of Python, as of the caller's line."""
    for warning in found:
        warnings.warn(warning, stacklevel=stacklevel + 1)
