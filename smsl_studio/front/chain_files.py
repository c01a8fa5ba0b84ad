"""Writes what the chain from a text leaves beside a blueprint. Nothing that stood there is lost."""

from __future__ import annotations

import json
import os
from collections.abc import Sequence
from pathlib import Path

from smsl_studio.errors import SaveError, UsageError
from smsl_studio.front.former_files import is_same, is_there, lay_aside
from smsl_studio.generate.text.chain import KEPT, TextChain
from smsl_studio.generate.text.functions import functions_manifest
from smsl_studio.generate.text.people_script import people_script
from smsl_studio.generate.text.prompts import FILES, RMM
from smsl_studio.library.manifest import MANIFEST
from smsl_studio.smsl.document import Document
from smsl_studio.smsl.files import bytes_to_save, save_document
from smsl_studio.smsl.outputs import refuse_inputs

Name = str | os.PathLike[str]
PEOPLE, REQUIREMENTS = "people.jsonl", "requirements.json"
MADE_AGAIN = ("reader", "by hand")
"""Those whose answers come again from the texts, or lie in a folder of their own."""


def base_name(name: str) -> str:
    """Return the name of the file that keeps a blueprint as it was generated, where the blueprint
    itself has the name ``psm.json``."""
    return f"{name}.base.json"


def refuse_places(target: Path) -> None:
    """UsageError if what is made cannot be put beside ``target``."""
    if target.name in (KEPT, REQUIREMENTS):
        raise UsageError(
            f"{target.name} is written beside the blueprint", advice="Give it another name."
        )
    functions = target.parent / FILES[RMM]
    if functions.is_symlink():
        raise UsageError(
            f"{functions} is a link, and functions would be written into another folder",
            advice="Move the link away, or write elsewhere with -o.",
        )


def write_chain(
    reached: TextChain, target: Path, by_hand: Path | None, inputs: Sequence[Name]
) -> tuple[tuple[str, ...], Path | None]:
    """Write all files, and return their names and the folder of those that stood there before and
    differ. What a person has put into the folder of ``target`` as an answer stays as it is."""
    folder = target.parent
    folder.mkdir(parents=True, exist_ok=True)
    own = by_hand is not None and by_hand.resolve() == folder.resolve()
    files: dict[str, Document | str] = dict(reached.files)
    if reached.functions:
        manifest = functions_manifest(reached.functions, target.stem)
        files[f"{FILES[RMM]}/{MANIFEST}"] = manifest
    if reached.blueprint is not None:
        script = people_script(reached.blueprint)
        if script:
            files[PEOPLE] = script
    if target.name in files and not own:
        files[base_name(target.name)] = files[target.name]
    made_of = [os.fspath(one) for one in inputs]
    saved = {}
    for name, text in files.items():
        path = folder / name
        given = name.partition("/")[0] in FILES.values() and path.name != MANIFEST
        if not (own and path.exists() and given):
            saved[name] = text
    if reached.blueprint is not None and target.name not in saved:
        from smsl_studio.front.outputs import converted

        saved = {target.name: converted(reached.blueprint, target).document, **saved}
    for name in saved:
        refuse_inputs(Path(os.path.realpath(folder / name)), str(folder / name), made_of)
    different = {name: text for name, text in saved.items() if not _is_written(folder / name, text)}
    lost = [name for name, text in different.items() if not _is_made_again(folder / name, text)]
    try:
        former = lay_aside([folder / name for name in lost if is_there(folder / name)], folder)
    except OSError as error:
        raise SaveError(
            f"{folder} cannot be written: {error.strerror or error}",
            advice="Choose another folder with -o.",
        ) from None
    for name, text in different.items():
        (folder / name).parent.mkdir(exist_ok=True)
        save_document(text, folder / name, made_of=made_of)
    return tuple(saved), former


def _is_written(path: Path, text: Document | str) -> bool:
    try:
        return is_same(path, bytes_to_save(text))
    except (OSError, ValueError):
        return False


def _is_made_again(path: Path, text: Document | str) -> bool:
    """Return whether nothing is lost with a file of answers: each answer comes again, or stands in
    the new file, too."""
    if path.name != KEPT or path.is_symlink() or not path.is_file():
        return False
    try:
        before, now = json.loads(path.read_bytes()), json.loads(str(text))
        return all(one["model"] in MADE_AGAIN or one in now["answers"] for one in before["answers"])
    except (OSError, ValueError, KeyError, TypeError, RecursionError):
        return False
