"""Generate again: the chain from the text runs into a folder of its own, and the blueprint stays as
it is until somebody takes what came."""

from __future__ import annotations

import os
import shutil
import threading
from collections.abc import Iterator
from dataclasses import dataclass, replace
from pathlib import Path

from smsl_studio.blueprint.comparison.compare import compare
from smsl_studio.blueprint.comparison.difference import Change
from smsl_studio.blueprint.model import Blueprint
from smsl_studio.errors import SaveError, StudioError, UsageError
from smsl_studio.front.chain_files import PEOPLE, REQUIREMENTS, base_name
from smsl_studio.front.design.base import generation_of
from smsl_studio.front.design.notes import NO_NOTES, DesignNotes, read_notes, write_notes
from smsl_studio.front.former_files import is_same, is_there, lay_aside
from smsl_studio.front.generated_text import GeneratedText, generate_text
from smsl_studio.generate.text.chain import KEPT
from smsl_studio.generate.text.prompts import FILES, PSM
from smsl_studio.generate.text.providers import BY_HAND, READER, REPLAY
from smsl_studio.smsl.files import read_content, save_document
from smsl_studio.stop import Stopped, heed, heeding

LOOK = 0.05
"""The time (s) between two looks whether the chain has ended or is called off."""
CHAIN = (*FILES.values(), KEPT, PEOPLE, REQUIREMENTS, base_name(FILES[PSM]))
"""What the chain writes beside the blueprint. The functions are a folder."""
NOTHING, BLUEPRINT, OTHER = "nothing", "a blueprint", "another file"
"""What is in the place of a new blueprint."""
__all__ = ["BY_HAND", "READER", "REPLAY", "GenerationRequest", "NewGeneration", "generate_anew"]


@dataclass(frozen=True)
class GenerationRequest:
    """What is generated of which files, and who answers.

    ``provider`` is ``reader``, ``by-hand``, ``replay:FILE`` or a base URL. ``by_hand`` is the
    folder of answers, ``target`` the file of the blueprint.
    """

    texts: tuple[Path, ...]
    target: Path
    hardware: Path | None = None
    require: Path | None = None
    provider: str = READER
    by_hand: Path | None = None

    def checked(self) -> GenerationRequest:
        """Return the request. UsageError for one that lacks something."""
        if not self.texts:
            raise UsageError("no text is chosen", advice="Choose a text of somebody who knows it.")
        if self.provider == BY_HAND and self.by_hand is None:
            raise UsageError("by hand needs a folder", advice="Choose one for the answers.")
        if not self.provider:
            raise UsageError("nobody is asked", advice="Choose the reader, or write a base URL.")
        if self.target.suffix.lower() not in (".json", ".yaml", ".yml", ".smsl"):
            raise UsageError(
                f"{self.target.name} is no name of a blueprint", advice="Let it end with .json."
            )
        read = [one.resolve() for one in (*self.texts, self.hardware, self.require) if one]
        if self.target.resolve() in read:
            raise UsageError(
                f"{self.target.name} is a text that is read", advice="Choose another file."
            )
        beside = {(self.target.parent / name).resolve() for name in CHAIN}
        taken_name = next((one for one in read if one in beside), None)
        if taken_name is not None:
            raise UsageError(
                f"{taken_name.name} is a text that is read, and a file of this name is written",
                advice="Choose another folder for the blueprint.",
            )
        if self.target.name in (KEPT, REQUIREMENTS, base_name(FILES[PSM])):
            raise UsageError(
                f"{self.target.name} is written beside the blueprint",
                advice="Give it another name.",
            )
        return self


@dataclass(frozen=True)
class NewGeneration:
    """What came, and where its files wait. ``made.blueprint`` is None if the chain did not come so
    far; ``made.lacking`` says why. ``changes`` are those from the present blueprint to it.
    ``place`` says what is in the place of its file, and ``has_base`` whether it is known how that
    was generated, so that changes by hand stay."""

    request: GenerationRequest
    folder: Path
    made: GeneratedText
    changes: tuple[Change, ...] = ()
    place: str = NOTHING
    has_base: bool = False

    @property
    def is_whole(self) -> bool:
        """Whether there is a blueprint to take."""
        return self.made.blueprint is not None


def generate_anew(
    request: GenerationRequest, folder: Path, before: Blueprint | None = None
) -> NewGeneration:
    """Run the chain of a request into ``folder``, which is emptied first, and compare what came
    with ``before``, or else with the blueprint in the file of the request. Nothing else is written.

    It takes as long as who answers takes, and heeds a stop at once: nobody is asked any more then,
    and an answer that is on its way is dropped. StudioError as ``generate_text``.
    """
    asked = request.checked()
    shutil.rmtree(folder, ignore_errors=True)
    folder.mkdir(parents=True, exist_ok=True)
    place, present = BLUEPRINT, before
    if before is None:
        place, present = what_is_at(asked.target)
    made = _TextThread(asked, folder / f"{asked.target.stem}.json").wait()
    if made.blueprint is None or present is None:
        return NewGeneration(asked, folder, made, (), place)
    changes = compare(present, made.blueprint).changes
    has_base = generation_of(present, asked.target) is not None
    return NewGeneration(asked, folder, made, changes, place, has_base)


def what_is_at(target: Path) -> tuple[str, Blueprint | None]:
    """Return what is in the place of a blueprint, and the blueprint if it is one."""
    from smsl_studio.front.inputs import read

    if not os.path.lexists(target):
        return NOTHING, None
    try:
        return BLUEPRINT, read(target)
    except StudioError:
        return OTHER, None


class _TextThread:
    """The chain in a thread of its own, because a server may be silent for minutes."""

    def __init__(self, request: GenerationRequest, output: Path) -> None:
        self._request, self._output = request, output
        self._made: GeneratedText | BaseException | None = None
        self._off = False

    def wait(self) -> GeneratedText:
        """Return what came. Stopped if the thread that waits is called off."""
        thread = threading.Thread(target=self._run, name="text chain", daemon=True)
        thread.start()
        try:
            while thread.is_alive():
                thread.join(LOOK)
                heed()
        except Stopped:
            self._off = True
            raise
        if isinstance(self._made, BaseException):
            raise self._made
        assert self._made is not None
        return self._made

    def _heed(self) -> None:
        if self._off:
            raise Stopped

    def _run(self) -> None:
        asked = self._request
        by_hand = asked.by_hand if asked.provider == BY_HAND else None
        try:
            with heeding(self._heed):
                self._made = generate_text(
                    asked.texts,
                    self._output,
                    provider=None if asked.provider == BY_HAND else asked.provider,
                    by_hand=by_hand,
                    hardware=asked.hardware,
                    require=asked.require,
                )
        except (Exception, Stopped) as error:
            self._made = error


def taken(before: Blueprint, base: Blueprint | None, new: Blueprint) -> Blueprint:
    """Return the blueprint after the new generation is taken, in the file of ``before``.

    What people have changed since the last generation ``base`` stays, merged by meaning; where both
    changed the same, the conflict stands in it. Without a base the new one replaces the old one.
    ConvertError if the written form of the file cannot express it.
    """
    from smsl_studio.blueprint.reading import read_blueprint
    from smsl_studio.front.outputs import converted, merge

    if base is not None:
        return merge(base, before, new).blueprint
    return read_blueprint(converted(new, before.file).document)


def keep_generation(new: NewGeneration, own: bool = False) -> None:
    """Put the files of a taken generation beside the blueprint, and remember its texts.

    Files of the chain that lie there go to the folder ``former-1`` (or the next number) first, so
    that nothing is lost. With ``own`` the blueprint itself is written, too, and a file that was in
    its place goes there as well. SaveError if something cannot be written.
    """
    asked, target = new.request, new.request.target.absolute()
    target.parent.mkdir(parents=True, exist_ok=True)
    inputs = [os.fspath(one) for one in (*asked.texts, asked.hardware, asked.require) if one]
    try:
        lay_aside(list(_replaced(target, new.folder, own)), target.parent)
        for path in _files(new.folder):
            place, raw = target.parent / path.relative_to(new.folder), read_content(path).raw
            if place == target or is_same(place, raw):
                continue
            place.parent.mkdir(exist_ok=True)
            save_document(raw, place, made_of=inputs)
    except OSError as error:
        raise SaveError(
            f"{target.parent} cannot be written: {error.strerror or error}",
            advice="Free some room, or choose another folder.",
        ) from None
    if own and new.made.blueprint is not None:
        from smsl_studio.front.outputs import converted

        save_document(converted(new.made.blueprint, target).document, target, made_of=inputs)
    remember(str(target), new)


def remember(file: str, new: NewGeneration) -> None:
    """Write into the notes of a blueprint of which texts it was made, and what is in doubt."""
    asked = new.request
    write_notes(replace(
        notes_or_none(file), texts=tuple(one.absolute() for one in asked.texts),
        hardware=(asked.hardware.absolute(),) if asked.hardware else (),
        require=asked.require.absolute() if asked.require else None,
        doubts=new.made.doubts,
    ), file)  # fmt: skip


def notes_or_none(file: str) -> DesignNotes:
    """Return the notes of a blueprint's file, empty ones if they cannot be read."""
    try:
        return read_notes(file)
    except StudioError:
        return NO_NOTES


def _files(folder: Path) -> Iterator[Path]:
    """Yield what the chain has written into a folder, without the blueprint itself. A link is
    yielded, and not followed."""
    for name in CHAIN:
        path = folder / name
        if path.is_dir() and not path.is_symlink():
            yield from sorted(one for one in path.iterdir() if is_there(one))
        elif is_there(path):
            yield path


def _replaced(target: Path, new: Path, own: bool) -> Iterator[Path]:
    """Yield the files of the former generation that differ from the new ones. With ``own`` the file
    of the blueprint itself is one of them."""
    folder = target.parent
    for path in _files(folder):
        other = new / path.relative_to(folder)
        if path != target and not (other.is_file() and is_same(path, other.read_bytes())):
            yield path
    if own and is_there(target):
        yield target
