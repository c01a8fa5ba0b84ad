"""A PDDL domain: types, constants, predicates, costs and actions."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field

from smsl_studio.errors import ReadError, did_you_mean
from smsl_studio.generate.pddl.expressions import Expression
from smsl_studio.generate.pddl.types import TypedName, TypeTree, name_of, typed_names
from smsl_studio.stop import heed

KNOWN = frozenset(
    f":{name}"
    for name in (
        "strips", "typing", "negative-preconditions", "equality", "disjunctive-preconditions",
        "existential-preconditions", "universal-preconditions", "quantified-preconditions",
        "conditional-effects", "adl", "action-costs",
    )
)  # fmt: skip
"""The requirements that are supported."""
TOTAL = "total-cost"
_MOST_PARAMETERS = 30
_SECTIONS = (":requirements", ":types", ":constants", ":predicates", ":functions", ":action")


@dataclass(frozen=True)
class ActionSchema:
    """An action before its parameters have values."""

    name: str
    parameters: tuple[TypedName, ...]
    precondition: Expression | None
    effect: Expression | None
    at: Expression


@dataclass
class Domain:
    """What a domain says. Predicates and functions have the types of their arguments."""

    name: str = ""
    types: TypeTree = field(default_factory=lambda: TypeTree(()))
    constants: dict[str, tuple[str, ...]] = field(default_factory=dict)
    predicates: dict[str, tuple[TypedName, ...]] = field(default_factory=dict)
    functions: dict[str, tuple[TypedName, ...]] = field(default_factory=dict)
    actions: list[ActionSchema] = field(default_factory=list)


def read_domain(tree: Expression) -> Domain:
    """Return a domain. ReadError, with its place, for what is wrong or not supported."""
    sections = sections_of(tree, "domain", _SECTIONS)
    domain = Domain(name_of(_only(tree.parts[1])))
    for one in sections[":requirements"]:
        check_requirements(one)
    told = [name for one in sections[":types"] for name in typed_names(one.rest, variables=False)]
    domain.types = TypeTree(told)
    domain.constants = declared(sections[":constants"], domain, {})
    for one in sections[":predicates"]:
        for each in one.rest:
            _declare(domain.predicates, each, domain.types, "predicate")
    for one in sections[":functions"]:
        _functions(domain, one)
    for one in sections[":action"]:
        heed()
        _action(domain, one)
    return domain


def sections_of(
    tree: Expression, kind: str, known: Sequence[str]
) -> Mapping[str, list[Expression]]:
    """Return the sections of ``(define (kind NAME) ...)`` by their first words."""
    if tree.head != "define" or len(tree.parts) < 2 or tree.parts[1].head != kind:
        raise tree.fault(f"(define ({kind} NAME) ...) is expected")
    found: dict[str, list[Expression]] = {name: [] for name in known}
    for one in tree.parts[2:]:
        heed()
        if one.head not in found:
            if not one.head.startswith(":"):
                raise one.fault(f"a section is expected, but {one.shown} stands there")
            raise unsupported(one, one.head, did_you_mean(one.head, list(known)))
        if one.head != ":action" and found[one.head]:
            raise one.fault(f"the section {one.head} stands twice")
        found[one.head].append(one)
    return found


def unsupported(at: Expression, what: str, near: str = "") -> ReadError:
    """Return the error for a part of PDDL that is not supported."""
    return at.fault(f"{what} is not supported", near or "docs/pddl.md lists what is.")


def check_requirements(section: Expression) -> None:
    """Raise ReadError for a requirement that is not supported."""
    for one in section.rest:
        if one.word not in KNOWN:
            raise unsupported(one, f"the requirement {one.shown}")


def declared(
    sections: Sequence[Expression], domain: Domain, known: Mapping[str, tuple[str, ...]]
) -> dict[str, tuple[str, ...]]:
    """Return objects with their types, those that are known first."""
    found = dict(known)
    for section in sections:
        names = typed_names(section.rest, variables=False)
        domain.types.check(names)
        for one in names:
            if one.name in found:
                raise one.at.fault(f"the object {one.name!r} stands twice")
            found[one.name] = one.types
    return found


def _only(one: Expression) -> Expression:
    if len(one.parts) != 2:
        raise one.fault(f"one name is expected in {one.shown}")
    return one.parts[1]


def _declare(
    into: dict[str, tuple[TypedName, ...]], one: Expression, types: TypeTree, what: str
) -> None:
    if not one.parts:
        raise one.fault(f"a {what} stands in brackets: (name ?x)")
    name = name_of(one.parts[0])
    if name in into:
        raise one.fault(f"the {what} {name!r} stands twice")
    arguments = typed_names(one.rest, variables=True)
    types.check(arguments)
    into[name] = tuple(arguments)


def _functions(domain: Domain, section: Expression) -> None:
    rest = iter(section.rest)
    for one in rest:
        if one.word == "-":
            kind = next(rest, None)
            if kind is None or kind.word != "number":
                raise unsupported(kind or one, "a function that is no number")
        else:
            _declare(domain.functions, one, domain.types, "function")
    if domain.functions.get(TOTAL):
        raise section.fault(f"{TOTAL} has no arguments")


def _action(domain: Domain, section: Expression) -> None:
    if len(section.parts) < 2:
        raise section.fault("an action has a name")
    name = name_of(section.parts[1])
    if any(one.name == name for one in domain.actions):
        raise section.fault(f"the action {name!r} stands twice")
    keys: dict[str, Expression] = {}
    for at in range(2, len(section.parts), 2):
        key = section.parts[at]
        if key.word not in (":parameters", ":precondition", ":effect"):
            raise unsupported(key, f"{key.shown} in an action")
        if at + 1 >= len(section.parts):
            raise key.fault(f"nothing stands behind {key.word}")
        if key.word in keys:
            raise key.fault(f"{key.word} stands twice")
        keys[key.word] = section.parts[at + 1]
    told = keys.get(":parameters")
    if told is not None and told.word:
        raise told.fault("parameters stand in brackets: (?x ?y)")
    parameters = typed_names(told.parts if told else [], variables=True)
    domain.types.check(parameters)
    if len(parameters) > _MOST_PARAMETERS:
        raise section.fault(f"{name} has more than {_MOST_PARAMETERS} parameters")
    if len({one.name for one in parameters}) < len(parameters):
        raise section.fault(f"a parameter of {name} stands twice")
    domain.actions.append(
        ActionSchema(
            name, tuple(parameters), keys.get(":precondition"), keys.get(":effect"), section
        )
    )
