"""Runs the checks of ``verify.py``, the program that every bundle of evidence has.

The program is in ``resources``. A bundle gets a copy of its bytes, and Studio runs the same file.
So Studio and plain Python agree about the story of a log. Studio reads the log with its own reader
before, which also refuses members that no event has.
"""

from __future__ import annotations

from functools import cache
from importlib.util import module_from_spec, spec_from_file_location
from pathlib import Path
from typing import Any

from smsl_studio.blueprint.digests import content_of
from smsl_studio.blueprint.model import Blueprint
from smsl_studio.blueprint.procedures import procedures_of
from smsl_studio.seal.canonical import canonical
from smsl_studio.seal.digest import sha256_hex
from smsl_studio.shipped import resources_dir

Texts = dict[str, bytes]


def verifier_file() -> Path:
    """Return the path of ``verify.py``."""
    return resources_dir() / "verify.py"


def content_texts(blueprint: Blueprint) -> Texts:
    """Return the canonical texts from which the digests of a blueprint's file are computed.

    ``behaviour`` has its SBs, ``brought`` those of its imports, and ``meaning`` its annotations.
    ``closure`` has the digests of these three, and the annotations of the imports. The three
    digests of the file are the SHA-256 of ``behaviour``, ``meaning`` and ``closure``.
    """
    content = content_of(blueprint)
    brought, *said = content["imported"]
    texts = {
        "behaviour": canonical(content["behaviour"]),
        "brought": canonical(brought),
        "meaning": canonical(content["meaning"]),
    }
    closure = {
        "behaviour": sha256_hex(texts["behaviour"]),
        "imported": [sha256_hex(texts["brought"]), *said],
        "meaning": sha256_hex(texts["meaning"]),
        "missing": content["missing"],
    }
    return {**texts, "closure": canonical(closure)}


def told_again(raw: bytes, blueprint: Blueprint) -> str:
    """Compute the run of a log again from a blueprint, and compare.

    Return why the log is wrong, or the empty text. ``raw`` has the bytes of the log.
    """
    checks = _checks()
    every = [blueprint, *procedures_of(blueprint).parts]
    try:
        texts = map(content_texts, every)
        read = [checks.content([one[part] for part in checks.PARTS]) for one in texts]
        checks.tell({one["hexes"][3]: one for one in read}, raw)
    except checks.Wrong as error:
        return str(error)
    except (KeyError, TypeError, ValueError, AttributeError, IndexError, RecursionError) as error:
        return f"it is not as a run writes it ({type(error).__name__})"
    return ""


@cache
def _checks() -> Any:
    """Load ``verify.py`` as a module. It only defines functions."""
    spec = spec_from_file_location("smsl_studio_verify", verifier_file())
    assert spec is not None
    assert spec.loader is not None
    module = module_from_spec(spec)
    spec.loader.exec_module(module)
    return module
