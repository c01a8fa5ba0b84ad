"""The parameters of a library function, and the check that arguments fit them."""

from __future__ import annotations

import inspect
import typing
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from typing import Any

from smsl_studio.errors import PluginError, did_you_mean

_WORDS = {int: "a whole number", float: "a number", str: "a text", bool: "true or false"}


@dataclass(frozen=True, slots=True)
class Signature:
    """The parameters of a function after the given ones, such as the world.

    ``types`` has the type of each parameter. ``required`` are the parameters without a default.
    ``any_name`` says that the function has ``**kwargs``.
    """

    types: Mapping[str, object]
    required: frozenset[str]
    any_name: bool

    def converted(self, texts: Mapping[str, str]) -> dict[str, Any]:
        """Convert texts from a name to the types of the parameters. PluginError if a number is too
        long."""
        return {name: self._from_text(name, text) for name, text in texts.items()}

    def checked(self, arguments: Mapping[str, Any]) -> dict[str, Any]:
        """Return the arguments with the types of the parameters. PluginError if one does not
        fit."""
        for name in arguments:
            if name not in self.types and not self.any_name:
                raise PluginError(
                    f"there is no parameter {name!r}", advice=did_you_mean(name, self.types)
                )
        missing = sorted(self.required - set(arguments))
        if missing:
            raise PluginError(f"the argument {', '.join(map(repr, missing))} is missing")
        return {name: self._checked(name, value) for name, value in arguments.items()}

    def _from_text(self, name: str, text: str) -> Any:
        kind = self.types.get(name, str)
        if kind is bool:
            return text == "true"
        try:
            return kind(text) if kind in (int, float) else text
        except ValueError:  # Python refuses to read a whole number of thousands of digits
            raise PluginError(f"{name} is too long a number") from None

    def _checked(self, name: str, value: Any) -> Any:
        kind = self.types.get(name)
        if kind is float and type(value) is int:
            return float(value)
        if kind in _WORDS and type(value) is not kind:
            raise PluginError(f"{name} is {value!r}, not {_WORDS[kind]}")
        return value


def signature_of(function: Callable[..., Any], given: Sequence[str] = ("world",)) -> Signature:
    """Return the signature of ``f(world, ...)``. ``given`` are the first parameters, which are
    passed by position. PluginError if the function does not take them."""
    parameters = list(inspect.signature(function).parameters.values())
    first = (inspect.Parameter.POSITIONAL_ONLY, inspect.Parameter.POSITIONAL_OR_KEYWORD)
    leading = [item.kind in first for item in parameters[: len(given)]]
    if len(leading) < len(given) or not all(leading):
        what = "parameter" if len(given) == 1 else "parameters"
        raise PluginError(
            f"{_name(function)} does not take the {', '.join(given)} as its first {what}",
            advice=f"Write def {_name(function)}({', '.join(given)}, ...).",
        )
    hints = _hints(function)
    types: dict[str, object] = {}
    required: set[str] = set()
    any_name = False
    for item in parameters[len(given) :]:
        if item.kind is inspect.Parameter.VAR_KEYWORD:
            any_name = True
        elif item.kind is inspect.Parameter.POSITIONAL_ONLY:
            raise PluginError(
                f"{_name(function)} takes {item.name!r} by position only",
                advice="Arguments are handed over by name.",
            )
        elif item.kind is not inspect.Parameter.VAR_POSITIONAL:
            types[item.name] = hints.get(item.name, str)
            if item.default is inspect.Parameter.empty:
                required.add(item.name)
    return Signature(types, frozenset(required), any_name)


def _hints(function: Callable[..., Any]) -> dict[str, object]:
    try:
        return dict(typing.get_type_hints(function))
    except Exception:  # a hint names something that does not exist: only the plain types are known
        plain = {kind.__name__: kind for kind in _WORDS}
        raw = getattr(function, "__annotations__", {})
        return {name: plain.get(hint, object) for name, hint in raw.items()}


def _name(function: Callable[..., Any]) -> str:
    return getattr(function, "__name__", "the function")
