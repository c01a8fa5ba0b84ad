"""What a model or a person is asked, stage by stage. A prompt is made of the matter alone, so the
same matter gives the same bytes."""

from __future__ import annotations

import json
from collections.abc import Iterable, Mapping, Sequence
from typing import Any

from smsl_studio.generate.text import stage_words as said
from smsl_studio.generate.text.equipment import NeededEquipment, PluginOffer
from smsl_studio.generate.text.expert_text import ExpertText, SourceLine
from smsl_studio.generate.text.functions import NeededFunction, function_name
from smsl_studio.generate.text.provider import Matter
from smsl_studio.generate.text.steps import TextProcedure

Json = Any
PM, HIM, PSM, RMM = STAGES = ("pm", "him", "psm", "rmm")
FILES = {PM: "pm.md", HIM: "him.toml", PSM: "psm.json", RMM: "rmm"}
"""What each stage writes. The last one is a folder."""
MOST_OFFERED = 100
"""At most so many operations of a plugin stand in a question."""
LONGEST_MATTER = 200_000
"""At most so many characters of the texts stand in a prompt."""
LONGEST_PASSAGES = 40_000
"""At most so many characters of passages of other texts stand in a prompt."""


def pm_prompt(matter: Matter, by_file: bool) -> str:
    """Return the question for the steps. ``by_file`` says that the answer is a file."""
    how = said.PM_FILE if by_file else _schema(TextProcedure.model_json_schema())
    return _joined(said.PM, said.CITE, how, said.DATA, *_sources(matter))


def him_prompt(matter: Matter, by_file: bool) -> str:
    """Return the question for the hardware."""
    how = said.HIM_FILE if by_file else _schema(NeededEquipment.model_json_schema())
    offered = [
        f"{one.plugin}: {', '.join(one.operations) or 'no operations'}" for one in matter.offers
    ] or ["none"]
    return _joined(
        said.HIM, said.CITE, how, said.DATA, _matter("hardware list", matter.hardware),
        "Installed plugins and their operations:\n" + "\n".join(offered),
        *_sources(matter),
    )  # fmt: skip


def psm_prompt(matter: Matter, steps: str, equipment: str, by_file: bool) -> str:
    """Return the question for the blueprint, with the pages of the stages before."""
    by_hand = "Write it to psm.json in the folder of this file."
    how = by_hand if by_file else "Answer with the JSON object alone."
    rules = f"{said.PSM}{said.PSM_EXAMPLE}{said.PSM_RULES}"
    return _joined(
        rules, said.CITE, how, said.DATA, _marked("pm.md", steps), _marked("him.toml", equipment),
        *_sources(matter),
    )  # fmt: skip


def rmm_prompt(
    needed: Mapping[str, NeededFunction],
    names: Mapping[str, str],
    offers: Iterable[PluginOffer],
    by_file: bool,
) -> str:
    """Return the question for functions. ``needed`` and ``names`` have, by operation, what is
    needed and the name of its file. ``offers`` are the plugins whose operations may be used."""
    listed = []
    for operation, one in needed.items():
        named = f"function {function_name(operation)}, file {names[operation]}"
        listed += [f"{operation}: {one.title or operation}; {named}", *map(_indented, one.ways)]
    known = [
        f"world {', '.join(one.worlds)}: {', '.join(one.operations[:MOST_OFFERED])}"
        for one in offers
    ]
    how = (
        said.RMM_FILE
        if by_file
        else 'Answer with {"functions": [{"operation": "SB/Operation", "code": "def ..."}]}.'
    )
    return _joined(
        said.RMM, how, said.DATA, _marked("operations", "\n".join(listed)),
        _marked("operations that worlds have", "\n".join(known) or "(none)"),
    )  # fmt: skip


def _indented(line: str) -> str:
    return f"    {line}"


def repair_prompt(prompt: str, answer: str, faults: Sequence[str]) -> str:
    """Return the question again, with what is wrong with the answer."""
    listed = "\n".join(f"- {fault[:500]}" for fault in faults)
    return _joined(
        prompt, _marked("your answer", answer[:20_000]),
        f"This is wrong with it:\n{listed}\nAnswer again, completely.",
    )  # fmt: skip


def _schema(schema: dict[str, Json]) -> str:
    return "Answer with one JSON object of this schema:\n" + json.dumps(schema, sort_keys=True)


def _sources(matter: Matter) -> list[str]:
    """Return the texts of a procedure, and the passages of others that fit it best."""
    found = [_matter("expert text", matter.texts)]
    if matter.passages:
        best = sorted(matter.passages, key=lambda one: (one.text.file, one.lines[0].page,
                                                        one.lines[0].number))  # fmt: skip
        lines = {(one.file, one.page, one.number): one for part in best for one in part.lines}
        found.append(_marked("passages of other texts", _listed(lines.values(), LONGEST_PASSAGES)))
    return found


def _matter(title: str, texts: Sequence[ExpertText]) -> str:
    lines = (line for text in texts for line in text.lines)
    return _marked(title, _listed(lines, LONGEST_MATTER) or "(nothing)")


def _listed(lines: Iterable[SourceLine], longest: int) -> str:
    """Return lines with their places, as many whole ones as there is room for."""
    told, size = [], 0
    for line in lines:
        page = f" page {line.page}" if line.page else ""
        text = f"{line.file}{page} {line.number}: {line.text}"
        size += len(text) + 1
        if size > longest:
            told.append("(there is more, which does not stand here)")
            break
        told.append(text)
    return "\n".join(told)


def _marked(title: str, text: str) -> str:
    return f"----- {title} -----\n{text.rstrip()}\n----- end of {title} -----"


def _joined(*parts: str) -> str:
    return "\n\n".join(parts) + "\n"
