"""A SHA-256 for each rule. It changes if code changes on which the findings of the rule depend.

A rule depends on the reading of the text, the model, the graph and the prover. So its digest is
over its number and all source files of these packages.
"""

from __future__ import annotations

import hashlib
from collections.abc import Iterator, Mapping
from pathlib import Path

from smsl_studio.inspection.inspect import RULES
from smsl_studio.seal.digest import sha256_hex

PACKAGE = Path(__file__).parents[2]
ROOMS = ("smsl", "seal", "blueprint", "graph", "library", "inspection", "dispatch/route")
FRONT = ("equipment", "inputs", "proof", "recovery", "check_findings")
"""The files of ``front`` that run the whole check."""


def rule_codes() -> Mapping[str, str]:
    """Return the SHA-256 for the code of each rule, by the number of the rule."""
    common = common_code()
    return {rule: sha256_hex(f"{rule} {common}".encode()) for rule in RULES}


def common_code() -> str:
    """Return the SHA-256 of all source files on which rules depend.

    The code of a rule is the SHA-256 of its number, a space, and this.
    """
    whole = hashlib.sha256()
    for path in _files():
        raw = path.read_bytes()
        name = path.relative_to(PACKAGE).as_posix().encode()
        whole.update(b"%d %b %d " % (len(name), name, len(raw)))
        whole.update(raw)
    return whole.hexdigest()


def _files() -> Iterator[Path]:
    yield from sorted(PACKAGE.glob("*.py"))
    for room in ROOMS:
        yield from sorted((PACKAGE / room).rglob("*.py"))
    yield from (path for name in FRONT if (path := PACKAGE / "front" / f"{name}.py").exists())
