"""A hook that is called before a function of the program, for every caller."""

from __future__ import annotations

from collections.abc import Callable
from importlib import import_module
from typing import Any


def always(*_: Any, **__: Any) -> bool:
    """Every call is meant."""
    return True


def call_before(name: str, call: Callable[[], object], fits: Callable[..., bool] = always) -> None:
    """Have ``call`` called before each call of ``name`` (module:function) that ``fits``."""
    module, _, path = name.partition(":")
    owner: Any = import_module(module)
    *outer, last = path.split(".")
    for part in outer:
        owner = getattr(owner, part)
    function = getattr(owner, last)

    def called(*said: Any, **named: Any) -> Any:
        if fits(*said, **named):
            call()
        return function(*said, **named)

    setattr(owner, last, called)
