"""Makes the Blueprint of a Document.

A ReadError (exit 2) comes only if something cannot be a blueprint: an SB, HEADER, state or target
of the wrong kind. Everything else opens, and inspection reports it.
"""

from __future__ import annotations

from collections.abc import Collection, Iterable, Iterator, Mapping, Sequence
from dataclasses import replace
from functools import partial
from itertools import chain, compress
from operator import is_not
from typing import TYPE_CHECKING, Any, cast

from smsl_studio.blueprint.elements import EMPTY, Header
from smsl_studio.blueprint.model import Blueprint, StateBranch
from smsl_studio.smsl.document import Document, Path
from smsl_studio.smsl.document.limits import MAX_BRANCHES, MAX_NAME

if TYPE_CHECKING:
    from smsl_studio.blueprint.imported_files import Imports

Json = Any
HEADER = "HEADER"
Wrong = tuple[Path, str, Json]
"""A path, the kind that should stand there, and the value that does."""


def read_blueprint(
    document: Document, former: Blueprint | None = None, opened: Iterable[Document] = ()
) -> Blueprint:
    """Return the blueprint of a document. ReadError has the place of everything that cannot be in
    one.

    If the values of an SB are the same objects as in ``former``, its SB is used again with
    everything that was computed for it. So an edit takes time only for its changes. Imports are
    found relative to the document's file. Those that ``former`` imports, and the ``opened``
    documents, are used as they are in memory. See ``imports``.
    """
    own = partial(branches_of, former=former)
    fields = document.fields
    if "_imports" not in fields:
        return Blueprint(own(document), document, fields)
    from smsl_studio.blueprint.imports import follow, gather
    from smsl_studio.blueprint.project import real_path

    imports = former.imports if former else None
    if imports and former and former.fields.get("_imports") is fields["_imports"]:
        return gather(document, imports, own)
    known = imports.known if imports else {}
    known.update((real_path(one.file), one) for one in opened)
    return gather(document, _as_named(follow(document, known)), own)


def _as_named(imports: Imports) -> Imports:
    """Return the imports without those of the store whose content is not what their digest says."""
    if not any(item.stored for item in imports.files):
        return imports
    from smsl_studio.blueprint.digests import digests
    from smsl_studio.blueprint.imported_files import ImportFailure

    everything = [item.document for item in imports.files]
    good, failures = [], list(imports.failures)
    for item in imports.files:
        if item.stored:
            part = read_blueprint(item.document, opened=everything)
            if digests(part).closure != item.stored:
                words = "the store holds something else under this digest"
                at = (item.chain[-2], item.path, item.chain)
                failures.append(ImportFailure(words, *at, "Add the file to the store again."))
                continue
        good.append(item)
    return replace(imports, files=tuple(good), failures=tuple(failures))


def read_gathered(documents: Sequence[Document]) -> Blueprint:
    """Return the blueprint of documents that were gathered before, the importing one first.

    They are ``Blueprint.documents``. No name in them is followed and no file is read. So another
    process that gets them has the same blueprint as the sender.
    """
    from smsl_studio.blueprint.imported_files import KEY, Import, Imports
    from smsl_studio.blueprint.imports import gather

    root, *others = documents
    files = tuple(Import(one, (root.file, one.file), (KEY,)) for one in others)
    return gather(root, Imports(root.file, files), branches_of)


def salvage(document: Document) -> Blueprint:
    """Return what can be read of a document. Everything of a wrong kind is left out."""
    from smsl_studio.blueprint.imports import follow, gather

    def own(one: Document) -> dict[str, StateBranch]:
        """Return the SBs that can be read from one document."""
        return _read(one, None)[0]

    fields = document.fields
    if "_imports" not in fields:
        return Blueprint(own(document), document, fields)
    return gather(document, follow(document, {}), own)


def branches_of(document: Document, former: Blueprint | None = None) -> dict[str, StateBranch]:
    """Return the SBs of a document (see ``read_blueprint``)."""
    branches, wrong = _read(document, former)
    if wrong:
        from smsl_studio.blueprint.wrong_kinds import refused

        raise refused(document, wrong)
    return branches


def _read(
    document: Document, former: Blueprint | None
) -> tuple[dict[str, StateBranch], list[Wrong]]:
    """Return the SBs of a document, and everything in it that cannot be part of one."""
    branches: dict[str, StateBranch] = {}
    wrong: list[Wrong] = []
    for name, value in document.values.items():
        if name.startswith("_"):
            continue
        if len(branches) == MAX_BRANCHES:
            wrong.append(((name,), "one of fewer State Branches", value))
            break
        before = former.branches.get(name) if former else None
        if before and former and former.home(name).values.get(name) is value:
            branches[name] = before
        elif not _is_name(name):
            wrong.append(((name,), "a name", value))
        elif type(value) is dict:
            branches[name] = _branch(name, value, wrong, before.table if before else EMPTY)
            if before:
                from smsl_studio.blueprint.handed_on import hand_on

                hand_on(before, branches[name])
        else:
            wrong.append(((name,), "a State Branch", value))
    return branches, wrong


def _branch(
    name: str, value: dict[str, Json], wrong: list[Wrong], known: Mapping[str, Json]
) -> StateBranch:
    """Return the SB in a value. ``known`` has the states that were read before; states with the
    same objects need no check.
    """
    table: dict[str, Mapping[str, str]] = dict(value)
    fields = {key: table.pop(key) for key in value if key[:1] == "_"}
    written = table.pop(HEADER, None)
    header = Header(present=False)
    if type(written) is dict:
        header = _header(written)
    elif HEADER in value:
        wrong.append(((name, HEADER), "a HEADER", written))
    others: Mapping[str, Json] = table
    if known:
        new = map(is_not, table.values(), map(known.get, table))
        others = dict(compress(table.items(), new))
    if _is_plain(others):
        return StateBranch(name, table, header, fields)
    state_fields: dict[str, dict[str, Json]] = {}
    states = {}
    for state, operations in table.items():
        if not _is_name(state):
            wrong.append(((name, state), "a name", operations))
        elif type(operations) is dict:
            states[state] = _operations((name, state), operations, state_fields, wrong)
        else:
            wrong.append(((name, state), "a state", operations))
    return StateBranch(name, states, header, fields, state_fields)


def _is_name(key: str) -> bool:
    return 0 < len(key) <= MAX_NAME


def _are_names(lengths: Collection[int]) -> bool:
    return not lengths or (min(lengths) > 0 and max(lengths) <= MAX_NAME)


def _is_plain(table: Mapping[str, Json]) -> bool:
    """Return whether a table has nothing but states whose operations lead to names.

    It checks whole tables with built-in functions, because nearly all tables are plain.
    """
    lengths = set(map(len, table))
    if not set(map(type, table.values())) <= {dict} or not _are_names(lengths):
        return False
    states = cast("list[dict[str, Json]]", list(table.values()))
    names = set(chain.from_iterable(states))
    if any(name[:1] == "_" for name in names) or not _are_names(set(map(len, names))):
        return False
    targets = chain.from_iterable(map(dict.values, states))
    return set(map(type, targets)) <= {str}


def _operations(
    path: Path,
    value: Mapping[str, Json],
    state_fields: dict[str, dict[str, Json]],
    wrong: list[Wrong],
) -> Mapping[str, str]:
    """Return the operations of one state. ``_`` fields go to ``state_fields``, faults to
    ``wrong``.
    """
    found: dict[str, str] = {}
    for key, target in value.items():
        if key[:1] == "_":
            state_fields.setdefault(path[-1], {})[key] = target
        elif not _is_name(key):
            wrong.append(((*path, key), "a name", target))
        elif type(target) is str:
            found[key] = target
        else:
            wrong.append(((*path, key), "a target", target))
    return value if len(found) == len(value) else found


def _header(value: Mapping[str, Json]) -> Header:
    fields = {k: v for k, v in value.items() if k.startswith("_")}
    unknown = {k: v for k, v in value.items() if k not in KNOWN and not k.startswith("_")}

    odd: dict[str, Json] = {}

    def get(key: str, kind: type) -> Any:
        """Return the value of a header key. A value of the wrong kind goes to ``odd`` and counts as
        None.
        """
        found = value.get(key)
        if type(found) is kind and found != "":
            return found
        if found is not None:
            odd[key] = found
        return None

    written = value.get("SUB_SBS")
    if written is not None and not isinstance(written, dict | list):
        odd["SUB_SBS"] = written
    pairs = ((sub, digit) for _, sub, digit in sub_entries(written))
    return Header(
        initial=get("INITIAL", str),
        activating=get("ACTIVATING", str),
        num_facts=get("NUM_FACTS", int),
        sub_sbs=tuple((sub, digit) for sub, digit in pairs if sub and type(digit) is int),
        num_states=get("NUM_STATES", int),
        unknown=unknown or EMPTY,
        fields=fields or EMPTY,
        subs_as_written=written,
        odd=odd or EMPTY,
    )


KNOWN = ("INITIAL", "ACTIVATING", "NUM_FACTS", "SUB_SBS", "NUM_STATES")


def sub_entries(written: Json) -> Iterator[tuple[Path, str, Json]]:
    """Yield the entries of SUB_SBS (a map, or a list of maps): the path, the sub-SB and its digit.

    A list element that is no map has an empty name. Names that begin with ``_`` are left out.
    """
    if isinstance(written, list):
        for index, item in enumerate(written):
            if not isinstance(item, dict):
                yield (str(index),), "", item
                continue
            for path, sub, digit in sub_entries(item):
                yield (str(index), *path), sub, digit
    elif isinstance(written, dict):
        for sub, digit in written.items():
            if sub[:1] != "_":
                yield (sub,), sub, digit
