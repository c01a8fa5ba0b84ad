"""The reader in the place of the HIM: a hardware list, and what the steps of a text name."""

from __future__ import annotations

import re
from collections.abc import Iterator, Sequence

from smsl_studio.generate.text import language_words as words
from smsl_studio.generate.text.equipment import Device, Need, NeededEquipment
from smsl_studio.generate.text.expert_text import ExpertText
from smsl_studio.generate.text.outline import HEADING, ITEMS, ROW, TextPart, outline_of
from smsl_studio.generate.text.steps import Source, TextProcedure, TextStep, every_step

_SENSOR = re.compile(
    r"\b(sensors?|tracker|camera|switch|meter|gauge|monitor|encoder|detector|thermometer|clock"
    r"|\w*sensor(en)?|kamera|\w*schalter|\w*messer|\w*messgerät|monitor|uhr|\w*thermometer)\b",
    re.IGNORECASE,
)
_NAME_END = re.compile(r"\s*(?:[:(,;]|\s[-–]\s).*$")
_ARTICLE = re.compile(r"^(?:an?|the|one|two|\d+\s*x?|der|die|das|ein|eine|einen|zwei)\s+", re.I)
_WORD = re.compile(r"[^\W\d_]{3,}")


def read_equipment(
    procedure: TextProcedure, texts: Sequence[ExpertText], hardware: Sequence[ExpertText]
) -> NeededEquipment:
    """Return the devices of the hardware lists, and what the procedure needs."""
    devices = {device.name.casefold(): device for device in _devices(hardware)}
    needs: dict[str, Need] = {}
    for need in (*_listed(texts), *_named(procedure, tuple(devices.values()))):
        key = need.name.casefold()
        before = needs.get(key)
        steps = (*(before.steps if before else ()), *need.steps)
        kept = before or need
        needs[key] = kept.model_copy(update={"steps": tuple(dict.fromkeys(steps))})
    known = tuple(devices.values())[:400]
    met = [_met(need, known) for need in needs.values()]
    return NeededEquipment(devices=known, needs=tuple(met[:400]))


def _devices(hardware: Sequence[ExpertText]) -> Iterator[Device]:
    for text in hardware:
        for part in _items(outline_of(text)):
            words_of = next(iter(part.cells.values()), "") if part.kind == ROW else part.text
            name = _name(words_of)
            if name:
                sources = (Source.of(part.cite()),)
                if _SENSOR.search(part.text):
                    yield Device(name=name, kind="sensor", sources=sources)
                else:
                    yield Device(name=name, sources=sources)


def _items(part: TextPart) -> Iterator[TextPart]:
    for one in part.below:
        if one.kind in ITEMS:
            yield one
        elif one.kind != HEADING or not words.ASIDE.search(one.text):
            yield from _items(one)


def _listed(texts: Sequence[ExpertText]) -> Iterator[Need]:
    """Yield what stands in the lists of equipment of a text."""
    for text in texts:
        for part in _equipment_parts(outline_of(text)):
            for one in _items(part):
                name = _name(one.text)
                if name:
                    yield Need(name=name, sources=(Source.of(one.cite()),))


def _equipment_parts(part: TextPart) -> Iterator[TextPart]:
    for one in part.below:
        if one.kind == HEADING:
            if words.EQUIPMENT.search(one.text):
                yield one
            else:
                yield from _equipment_parts(one)


def _named(procedure: TextProcedure, devices: Sequence[Device]) -> Iterator[Need]:
    """Yield what the steps name: a device of the list, a thing they are done with, the robot."""
    for step in every_step(procedure.steps):
        text = f"{step.do} {step.until}"
        present = frozenset(_stems(text))
        for device in devices:
            stems = _stems(device.name)
            if stems and present.issuperset(stems):
                yield _need(step, device.name, device.kind)
        for found in words.WITH.finditer(text):
            name = _name(words.PHRASE_END.sub("", found["what"]))
            if name and not any(_fits(name, device.name) for device in devices):
                yield _need(step, name)
        if step.who == "robot" and not any("robot" in one.name.lower() for one in devices):
            yield _need(step, "robot")


def _need(step: TextStep, name: str, kind: str = "device") -> Need:
    sources = [source.model_dump() for source in step.sources[:1]]
    return Need.model_validate(
        {"name": name, "kind": kind, "steps": [step.mark] if step.mark else [], "sources": sources}
    )


def _met(need: Need, devices: Sequence[Device]) -> Need:
    for device in devices:
        if _fits(need.name, device.name):
            return need.model_copy(update={"met_by": device.name, "kind": device.kind})
    return need


def _fits(need: str, device: str) -> bool:
    """Return whether a device is what is needed: all words of one stand in the other."""
    wanted, there = set(_stems(need)), set(_stems(device))
    return bool(wanted and there) and (wanted <= there or there <= wanted)


def _stems(text: str) -> list[str]:
    """Return the words of a text without the ending of a plural."""
    found = (word.lower() for word in _WORD.findall(text))
    return [re.sub(r"(en|s|n|e)$", "", word) or word for word in found if word not in _PLAIN]


_PLAIN = frozenset(("the", "and", "for", "with", "der", "die", "das", "und", "mit", "für"))


def _name(text: str) -> str:
    name = _ARTICLE.sub("", _NAME_END.sub("", text.strip(" .")))
    return " ".join(name.split())[:120] if any(char.isalpha() for char in name) else ""
