"""Everything from which the stages of a design cycle are told, read once, and its digests."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field, replace
from functools import cached_property
from pathlib import Path
from typing import Any

from smsl_studio.blueprint.digests import digests
from smsl_studio.blueprint.model import Blueprint
from smsl_studio.errors import PluginError, ReadError
from smsl_studio.front.approval_badge import ApprovalWords
from smsl_studio.front.approval_files import record_in
from smsl_studio.front.check_findings import CheckAnswer
from smsl_studio.front.design import found, stages
from smsl_studio.front.design.base import generation_of
from smsl_studio.front.design.functions import FunctionsBeside, functions_beside
from smsl_studio.front.design.notes import NO_NOTES, DesignNotes, StageNote, read_notes
from smsl_studio.generate.text.equipment import NeededEquipment
from smsl_studio.inspection.approval.record_file import SignedRecord, record_path
from smsl_studio.inspection.approval.refusal import Refusal
from smsl_studio.library.bindings_file import BindingsFile, bindings_beside
from smsl_studio.library.loaded import Loaded
from smsl_studio.seal.digest import digest_of, sha256_hex

Json = Any
TEXTS, LIST, STATES, SUBS, CLOSURE, DEVICES = (
    "texts", "hardware list", "states", "sub-SBs", "blueprint", "devices",
)  # fmt: skip
"""The names of the digests of which stages are made."""
STAGE_OF: Mapping[str, int] = {
    TEXTS: stages.TEXT, LIST: stages.TEXT, STATES: stages.FSM, SUBS: stages.BRANCHES,
    CLOSURE: stages.HFSM, DEVICES: stages.HARDWARE,
}  # fmt: skip

OF: Mapping[int, tuple[str, ...]] = {
    stages.FSM: (TEXTS,), stages.BRANCHES: (STATES,), stages.HARDWARE: (TEXTS, LIST),
    stages.TESTING: (CLOSURE, DEVICES),
}  # fmt: skip
"""The digests for which a note of a stage holds, the most important first."""


@dataclass
class DesignMatter:
    """A blueprint, what lies beside it, and what is known about it.

    ``loaded`` is what plugins offer, None if they were not asked. ``approval`` are the words of the
    badge, and ``check`` is the result of the whole check.
    """

    blueprint: Blueprint
    path: Path | None
    approval: ApprovalWords
    check: CheckAnswer
    loaded: Loaded | None = None
    fault: str = field(default="", init=False)
    """Why the notes could not be read."""

    @cached_property
    def notes(self) -> DesignNotes:
        """What the file of notes remembers."""
        if self.path is None:
            return NO_NOTES
        try:
            notes = read_notes(str(self.path))
        except ReadError as error:
            self.fault = error.sentence
            return NO_NOTES
        if notes.require is not None and not found.is_near(notes.require, self.folder):
            self.fault = found.too_far(notes.require.name)
            return replace(notes, require=None)
        return notes

    def note(self, stage: int) -> StageNote | None:
        """Return what was done for a stage. A note that names nothing of which the stage is made
        settles nothing, so it counts as none."""
        note = self.notes.done.get(stage)
        needed = next((name for name in OF.get(stage, ()) if name in self.digests), None)
        return note if note is not None and needed in note.of else None

    @property
    def folder(self) -> Path:
        """The folder of the blueprint; one that does not exist if it has no file."""
        return self.path.absolute().parent if self.path is not None else Path("/nonexistent")

    @cached_property
    def origin(self) -> Mapping[str, Json]:
        """How the blueprint was made; empty if it was drawn."""
        said = self.blueprint.fields.get("_origin")
        return said if isinstance(said, Mapping) else {}

    @property
    def is_generated(self) -> bool:
        """Whether it was computed, and no record covers it."""
        return bool(self.origin) and not self.approval.is_good

    @cached_property
    def head(self) -> found.KeptHead | None:
        """Who has answered for the stages of the text."""
        return found.kept_head(self.folder)

    @cached_property
    def texts(self) -> tuple[found.TextBeside, ...]:
        """The texts of which it was made, and those that the notes name."""
        names = self._named if self.origin.get("how") in ("text", "rules", "pddl") else ()
        return found.found_texts(names, self.notes.texts, self.folder)

    @cached_property
    def hardware_texts(self) -> tuple[found.TextBeside, ...]:
        """The lists of hardware."""
        names = [one.file for one in self.head.hardware] if self.head is not None else []
        return found.found_texts(names, self.notes.hardware, self.folder)

    @property
    def _named(self) -> tuple[str, ...]:
        said = self.origin.get("from")
        return tuple(said[:10_000].split(", ")) if isinstance(said, str) and said else ()

    @cached_property
    def equipment(self) -> NeededEquipment | None:
        """Which hardware is needed, and whether it is there."""
        return found.needed_equipment(self.folder)

    @cached_property
    def functions(self) -> FunctionsBeside:
        """The generated functions, which are not loaded from there."""
        return functions_beside(self.folder)

    @cached_property
    def generation(self) -> Blueprint | None:
        """The blueprint as it was generated last; None if there is none beside it."""
        return generation_of(self.blueprint, self.path) if self.path is not None else None

    @cached_property
    def bindings(self) -> BindingsFile | None:
        """The bindings; None if the file cannot be read."""
        if self.path is None:
            return BindingsFile()
        try:
            return bindings_beside(str(self.path))
        except PluginError:
            return None

    @cached_property
    def records(self) -> tuple[SignedRecord, ...]:
        """The records beside the blueprint, not verified."""
        if self.path is None:
            return ()
        read = record_in(record_path(str(self.path), None)).records
        return () if isinstance(read, Refusal) else read

    # Digests.

    @cached_property
    def digests(self) -> dict[str, str]:
        """The digests of what is there now, by their names. What is not there has none."""
        given = {
            TEXTS: self.texts_digest,
            LIST: _joined(self.hardware_texts),
            STATES: states_digest(self.blueprint),
            SUBS: digest_of({one.name: sorted(one.subs.items()) for one in self.blueprint}),
            CLOSURE: digests(self.blueprint).closure,
            DEVICES: self._devices_digest,
        }
        return {name: one for name, one in given.items() if one}

    @property
    def texts_digest(self) -> str:
        """The digest of the texts, as ``_origin`` names it. Rules are a text, too."""
        how, texts = self.origin.get("how"), self.texts
        if how == "rules" and len(texts) == 1:
            return texts[0].text.digest if texts[0].text is not None else ""
        return "" if how == "pddl" else _joined(texts)

    @property
    def _devices_digest(self) -> str:
        listed = self.equipment.model_dump(mode="json") if self.equipment is not None else None
        bound = "\n".join(self.bindings.text.lines) if self.bindings is not None else ""
        levels = dict(self.blueprint.levels)
        if listed is None and not bound and not levels:
            return ""
        return digest_of({"needed": listed, "bindings": sha256_hex(bound.encode()),
                          "levels": levels})  # fmt: skip

    def changed(self, of: Mapping[str, str]) -> tuple[int, ...]:
        """Return the stages that are not those any more of which something was made."""
        now = self.digests
        return tuple(sorted({STAGE_OF[name] for name, digest in of.items()
                             if name in STAGE_OF and now.get(name, digest) != digest}))  # fmt: skip


def states_digest(blueprint: Blueprint) -> str:
    """Return the digest of the states and operations alone, without what expands them."""
    return digest_of(
        {
            one.name: {
                "initial": one.initial, "activating": one.activating,
                "states": {state: dict(row) for state, row in one.table.items()},
            }
            for one in blueprint
        }
    )  # fmt: skip


def _joined(texts: tuple[found.TextBeside, ...]) -> str:
    """The digest of texts in their order; empty if one of them is not there."""
    from smsl_studio.generate.text.expert_text import digest_of_texts

    read = [one.text for one in texts]
    if not read or any(one is None for one in read):
        return ""
    return digest_of_texts([one for one in read if one is not None])
