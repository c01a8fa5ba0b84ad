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
from smsl_studio.front.design.notes import NO_NOTES, DesignNotes, read_notes, write_notes
from smsl_studio.front.generated_text import PEOPLE, REQUIREMENTS, GeneratedText, generate_text
from smsl_studio.generate.text.chain import KEPT
from smsl_studio.generate.text.prompts import FILES
from smsl_studio.generate.text.providers import BY_HAND, READER, REPLAY
from smsl_studio.smsl.files import read_content, save_document
from smsl_studio.stop import Stopped, heed, heeding

LOOK = 0.05
"""The time (s) between two looks whether the chain has ended or is called off."""
CHAIN = (*FILES.values(), KEPT, PEOPLE, REQUIREMENTS)
"""What the chain writes beside the blueprint. The functions are a folder."""
FORMER = "former"
MOST_FORMER = 1_000
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
        return self


@dataclass(frozen=True)
class NewGeneration:
    """What came, and where its files wait. ``made.blueprint`` is None if the chain did not come so
    far; ``made.lacking`` says why. ``changes`` are those from the present blueprint to it."""

    request: GenerationRequest
    folder: Path
    made: GeneratedText
    changes: tuple[Change, ...] = ()

    @property
    def is_whole(self) -> bool:
        """Whether there is a blueprint to take."""
        return self.made.blueprint is not None


def generate_anew(
    request: GenerationRequest, folder: Path, before: Blueprint | None = None
) -> NewGeneration:
    """Run the chain of a request into ``folder``, which is emptied first, and compare what came
    with ``before``. Nothing else is written.

    It takes as long as who answers takes, and heeds a stop at once: nobody is asked any more then,
    and an answer that is on its way is dropped. StudioError as ``generate_text``.
    """
    asked = request.checked()
    shutil.rmtree(folder, ignore_errors=True)
    folder.mkdir(parents=True, exist_ok=True)
    made = _TextThread(asked, folder / f"{asked.target.stem}.json").wait()
    changes: tuple[Change, ...] = ()
    if made.blueprint is not None and before is not None:
        changes = compare(before, made.blueprint).changes
    return NewGeneration(asked, folder, made, changes)


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
    that nothing is lost. With ``own`` the blueprint itself is written, too. SaveError if something
    cannot be written.
    """
    asked, target = new.request, new.request.target.absolute()
    target.parent.mkdir(parents=True, exist_ok=True)
    inputs = [os.fspath(one) for one in (*asked.texts, asked.hardware, asked.require) if one]
    try:
        _lay_aside(target.parent, new.folder)
        for path in _files(new.folder):
            place = target.parent / path.relative_to(new.folder)
            place.parent.mkdir(exist_ok=True)
            save_document(read_content(path).raw, place, made_of=inputs)
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
    """Yield what the chain has written into a folder, without the blueprint itself."""
    for name in CHAIN:
        path = folder / name
        if path.is_dir():
            yield from sorted(one for one in path.iterdir() if one.is_file())
        elif path.is_file():
            yield path


def _lay_aside(folder: Path, new: Path) -> None:
    """Move the files of the former generation into a folder, unless they are the same."""
    old = [path for path in _files(folder) if not _is_same(path, new / path.relative_to(folder))]
    if not old:
        return
    names = (folder / f"{FORMER}-{number}" for number in range(1, MOST_FORMER))
    aside = next((one for one in names if not one.exists()), folder / FORMER)
    for path in old:
        place = aside / path.relative_to(folder)
        place.parent.mkdir(parents=True, exist_ok=True)
        path.replace(place)


def _is_same(one: Path, other: Path) -> bool:
    return other.is_file() and one.read_bytes() == other.read_bytes()
