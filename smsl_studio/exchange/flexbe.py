"""Reads a behavior of FlexBE from its Python file. The file is parsed and never run.

What the editor of FlexBE writes is understood: containers, the states that are added to them,
their transitions. Everything else in the file is left out.
"""

from __future__ import annotations

import ast
import warnings
from collections.abc import Iterator
from typing import Any

from smsl_studio.errors import Place, ReadError
from smsl_studio.exchange.findings import ExchangeFindings
from smsl_studio.exchange.outcomes import MOST_STATES, OutcomeNode, values_of_machine
from smsl_studio.smsl.document.limits import MAX_DEPTH
from smsl_studio.stop import heed

Json = Any
LONGEST = 1_000_000
"""The largest number of characters: parsing takes a hundred times the memory."""

CONTAINERS = ("OperatableStateMachine", "ConcurrencyContainer", "PriorityContainer")
_LEFT_OUT = ("remapping", "autonomy")


def flexbe_values(text: str, file: str, findings: ExchangeFindings) -> dict[str, Json]:
    """Return the plain values of the blueprint that a behavior shows. ReadError if it is none."""
    reader = _FlexbeReader(file, findings)
    root = reader.machine(_parsed(text, file))
    return values_of_machine(root, file, findings)


def _parsed(text: str, file: str) -> ast.Module:
    if len(text) > LONGEST:
        words = f"a behavior is not longer than {LONGEST:,} characters"
        raise ReadError(words, Place(file, 1, 1), "Split the behavior.")
    try:
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")
            return ast.parse(text)
    except SyntaxError as error:
        place = Place(file, error.lineno or 1, max(error.offset or 1, 1))
        advice = "Save it with FlexBE again."
        raise ReadError(f"no valid Python: {error.msg}", place, advice) from None
    except (ValueError, RecursionError, MemoryError):
        words = "no Python that can be parsed: it is nested too deep, or holds a null character"
        raise ReadError(words, Place(file, 1, 1), "Save it with FlexBE again.") from None


class _FlexbeReader:
    def __init__(self, file: str, findings: ExchangeFindings) -> None:
        self._file, self._findings = file, findings
        self._containers: dict[str, ast.Call] = {}
        self._added: dict[str, list[ast.Call]] = {}
        self._lists: dict[str, list[str]] = {}
        self._using: set[str] = set()
        self._left = MOST_STATES
        self._counts: dict[str, int] = {}

    def machine(self, module: ast.Module) -> OutcomeNode:
        """Return the machine of the first class with a method ``create``."""
        for one in module.body:
            self._remember(one)
            if isinstance(one, ast.ClassDef):
                create = _method(one, "create")
                if create is not None:
                    return self._created(one, create)
        words = "it has no class with a method 'create', so it is no behavior of FlexBE"
        raise ReadError(words, Place(self._file, 1, 1), "Name a file that FlexBE wrote.")

    def _created(self, behavior: ast.ClassDef, create: ast.FunctionDef) -> OutcomeNode:
        returned = ""
        for one in _statements(create.body):
            heed()
            self._remember(one)
            if isinstance(one, ast.With):
                name = _plain_name(one.items[0].context_expr) if one.items else ""
                self._added.setdefault(name, []).extend(_additions(one.body))
            elif isinstance(one, ast.Return):
                returned = _plain_name(one.value)
        if returned not in self._containers:
            words = "'create' returns no container of FlexBE"
            raise ReadError(words, self._at(create), "Name a file that FlexBE wrote.")
        place = behavior.lineno, behavior.col_offset + 1
        name = _behavior_name(behavior) or behavior.name.removesuffix("SM") or behavior.name
        root = self._container(returned, name, None, place)
        for word, many in self._counts.items():
            self._findings.add(word, "", f"{word}: {many:,}, not carried over.")
        words = "Parameters of states, userdata and code by hand are neither run nor carried over."
        self._findings.add("code", root.name, words)
        return root

    def _remember(self, one: ast.stmt) -> None:
        if not isinstance(one, ast.Assign) or not isinstance(one.targets[0], ast.Name):
            return
        name = one.targets[0].id
        if isinstance(one.value, ast.Call) and _called(one.value) in CONTAINERS:
            self._containers[name] = one.value
        elif isinstance(one.value, ast.List | ast.Tuple):
            self._lists[name] = self._texts(one.value)

    def _container(
        self, variable: str, name: str, parent: OutcomeNode | None, place: tuple[int, int]
    ) -> OutcomeNode:
        call = self._containers[variable]
        node = OutcomeNode(name, name, place, machine=True, parent=parent)
        node.concurrent = _called(call) == "ConcurrencyContainer" and parent is not None
        if _called(call) != "OperatableStateMachine":
            words = f"It is a {_called(call)}; how its states run together is not carried over."
            self._findings.add("container", name, words, place)
        outcomes = self._texts(_keyword(call, "outcomes"))
        node.outcomes = {one: one for one in outcomes}
        self._using.add(variable)
        for addition in self._added.get(variable, []):
            self._child(node, addition)
        self._using.discard(variable)
        return node

    def _child(self, node: OutcomeNode, addition: ast.Call) -> None:
        place = addition.lineno, addition.col_offset + 1
        arguments = addition.args
        label = _text(arguments[0]) if arguments else ""
        self._left -= 1
        if self._left < 0:
            words = f"it has more than {MOST_STATES:,} states"
            raise ReadError(words, self._at(addition), "Split the behavior.")
        if not label or label in node.children:
            words = "A state without a name of its own is left out."
            self._findings.add("state", node.name, words, place)
            return
        state = arguments[1] if len(arguments) > 1 else None
        variable = _plain_name(state)
        inner = variable in self._containers and variable not in self._using
        if inner and len(self._using) < MAX_DEPTH:
            child = self._container(variable, label, node, place)
        else:
            if inner:
                words = f"Containers stand deeper than {MAX_DEPTH} levels: this one is one state."
                self._findings.add("depth", label, words, place)
            child = OutcomeNode(label, label, place, parent=node)
            if isinstance(state, ast.Call) and _called(state) == "use_behavior":
                used = _plain_name(state.args[0]) if state.args else ""
                words = f"The behavior {used[:200]!r} is not opened: it becomes one state."
                self._findings.add("behavior", label, words, place)
        node.start = node.start or label
        node.children[label] = child
        self._transitions(node, child, addition)

    def _transitions(self, node: OutcomeNode, child: OutcomeNode, addition: ast.Call) -> None:
        transitions = _keyword(addition, "transitions")
        for word in _LEFT_OUT:
            if _keyword(addition, word) is not None:
                self._counts[word] = self._counts.get(word, 0) + 1
        pairs = (
            zip(transitions.keys, transitions.values, strict=True)
            if isinstance(transitions, ast.Dict)
            else ()
        )
        for key, value in pairs:
            outcome, target = _text(key), _text(value)
            if not outcome or not target:
                words = "A transition that is computed is left out."
                place = addition.lineno, addition.col_offset + 1
                self._findings.add("transition", child.name, words, place)
                continue
            child.outcomes.setdefault(outcome, outcome)
            is_end = target in node.outcomes
            node.ways[child.id, outcome] = ("", target) if is_end else (target, "")

    def _texts(self, value: ast.expr | None) -> list[str]:
        if isinstance(value, ast.Name):
            return self._lists.get(value.id, [])
        if isinstance(value, ast.List | ast.Tuple):
            return [text for one in value.elts if (text := _text(one))]
        return []

    def _at(self, node: ast.stmt | ast.expr) -> Place:
        return Place(self._file, node.lineno, node.col_offset + 1)


def _method(behavior: ast.ClassDef, name: str) -> ast.FunctionDef | None:
    for one in behavior.body:
        if isinstance(one, ast.FunctionDef) and one.name == name:
            return one
    return None


def _statements(body: list[ast.stmt]) -> Iterator[ast.stmt]:
    """Yield the statements of a method, also those in ``if`` and ``try``, but not in ``with``."""
    waiting = list(reversed(body))
    while waiting:
        one = waiting.pop()
        yield one
        if isinstance(one, ast.If | ast.Try):
            waiting.extend(reversed(one.body))


def _additions(body: list[ast.stmt]) -> Iterator[ast.Call]:
    """Yield the calls ``CONTAINER.add(...)`` in a block."""
    for one in body:
        call = one.value if isinstance(one, ast.Expr) else None
        if isinstance(call, ast.Call) and _called(call) == "add":
            yield call


def _called(call: ast.Call) -> str:
    """Return the last part of the name of what is called."""
    made = call.func
    return made.attr if isinstance(made, ast.Attribute) else _plain_name(made)


def _plain_name(node: ast.expr | None) -> str:
    return node.id if isinstance(node, ast.Name) else ""


def _keyword(call: ast.Call, name: str) -> ast.expr | None:
    return next((one.value for one in call.keywords if one.arg == name), None)


def _text(node: ast.expr | None) -> str:
    found = node.value if isinstance(node, ast.Constant) else None
    return found if isinstance(found, str) else ""


def _behavior_name(behavior: ast.ClassDef) -> str:
    """Return the text of ``self.name = '...'`` in the class."""
    for method in behavior.body:
        for one in method.body if isinstance(method, ast.FunctionDef) else ():
            target = one.targets[0] if isinstance(one, ast.Assign) else None
            if isinstance(target, ast.Attribute) and target.attr == "name":
                return _text(one.value) if isinstance(one, ast.Assign) else ""
    return ""
