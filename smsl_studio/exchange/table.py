"""The forms of other programs: which suffix is written and read by what."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from importlib import import_module
from pathlib import PurePath
from typing import Any, NamedTuple, cast

from smsl_studio.blueprint.model import Blueprint
from smsl_studio.exchange.findings import ExchangeFindings

Json = Any
Writer = Callable[[Blueprint, ExchangeFindings], str]
Reader = Callable[[str, str, ExchangeFindings], Mapping[str, Json]]
"""From a text and the name of its file to the plain values of a blueprint."""


class ExchangeForm(NamedTuple):
    """One form: its suffix, what it is called, and whether it is written and read."""

    suffix: str
    words: str
    written: bool
    read: bool


FORMS = (
    ExchangeForm(".scxml", "SCXML 1.0 of the W3C", True, True),
    ExchangeForm(".graphml", "GraphML, for networkx, Gephi, yEd and Cytoscape", True, True),
    ExchangeForm(".xstate.json", "a machine of XState 5", True, True),
    ExchangeForm("a folder", "a state machine of RAFCON", False, True),
    ExchangeForm(".py", "a behavior of FlexBE", False, True),
    ExchangeForm(".xml", "the manifest of a behavior of FlexBE", False, True),
    ExchangeForm(".dot", "DOT, for Graphviz", True, False),
    ExchangeForm(".mmd", "a state diagram of Mermaid", True, False),
    ExchangeForm(".puml", "a state diagram of PlantUML", True, False),
    ExchangeForm(".csv", "a table of operations", True, False),
    ExchangeForm(".btcpp.xml", "trees of BehaviorTree.CPP 4", True, False),
    ExchangeForm(".pml", "Promela, for spin", True, False),
    ExchangeForm(".prism", "an MDP of PRISM", True, False),
)

WRITTEN = tuple(one.suffix for one in FORMS if one.written)
READ = tuple(one.suffix for one in FORMS if one.read and one.suffix.startswith("."))


def suffix_of(file: str, suffixes: tuple[str, ...]) -> str:
    """Return the suffix of a file among some, empty if it has none of them. The longest counts."""
    name = PurePath(file).name.lower()
    fitting = [one for one in suffixes if name.endswith(one) and name != one]
    return max(fitting, key=len, default="")


_WRITERS = {
    ".scxml": ("scxml_text", "as_scxml"),
    ".graphml": ("graphml_text", "as_graphml"),
    ".xstate.json": ("xstate_text", "as_xstate"),
    ".dot": ("diagrams", "as_dot_text"),
    ".mmd": ("diagrams", "as_mermaid_text"),
    ".puml": ("plantuml", "as_plantuml"),
    ".csv": ("spreadsheet", "as_csv"),
    ".btcpp.xml": ("behaviortree", "as_behaviortree"),
    ".pml": ("promela", "as_promela"),
    ".prism": ("prism", "as_prism"),
}
_READERS = {
    ".scxml": ("scxml_chart", "scxml_values"),
    ".graphml": ("graphml_graph", "graphml_values"),
    ".xstate.json": ("xstate_chart", "xstate_values"),
    ".py": ("flexbe", "flexbe_values"),
}


def writer_of(suffix: str) -> Writer:
    """Return what writes a form. It is loaded now. KeyError for an unknown suffix."""
    return cast("Writer", _loaded(*_WRITERS[suffix]))


def reader_of(suffix: str) -> Reader:
    """Return what reads a form. It is loaded now. KeyError for an unknown suffix."""
    return cast("Reader", _loaded(*_READERS[suffix]))


def _loaded(module: str, name: str) -> object:
    return getattr(import_module(f"smsl_studio.exchange.{module}"), name)
