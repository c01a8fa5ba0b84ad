"""The reader in the place of the PM: the steps of a structured text, without a model.

It knows headings, numbered lists with lists below them, tables, "if ... then ...", "wait until
...", and who acts, in English and German. The same text always gives the same steps.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from types import MappingProxyType
from typing import Any, Literal

from smsl_studio.errors import Place, ReadError
from smsl_studio.generate.text import language_words as words
from smsl_studio.generate.text import sentences
from smsl_studio.generate.text.expert_text import Citation, ExpertText
from smsl_studio.generate.text.outline import (
    BULLET,
    HEADING,
    ITEMS,
    NUMBERED,
    PARAGRAPH,
    ROW,
    TextPart,
    outline_of,
)
from smsl_studio.generate.text.step_keys import KEYED, keyed_step, source_of
from smsl_studio.generate.text.steps import (
    Caution,
    Remedy,
    Source,
    TextProcedure,
    TextStep,
    mark_of,
    risk_of,
)
from smsl_studio.generate.text.table_rows import row_step

NOTHING: Mapping[str, Any] = MappingProxyType({})
_TOO_LITTLE = "Give it numbered steps: 1. Fix the leg. 2. Wait until the tracker sees the markers."


@dataclass
class _FoundSteps:
    """The steps of one list. A condition belongs to the step before it."""

    steps: list[TextStep] = field(default_factory=list)
    early: list[Remedy] = field(default_factory=list)
    """Conditions that stand before the first step."""

    def add(self, step: TextStep) -> None:
        if self.early:
            step = _with(step, self.early)
            self.early = []
        self.steps.append(step)

    def remedy(self, one: Remedy) -> None:
        if not self.steps:
            self.early.append(one)
        else:
            self.steps[-1] = _with(self.steps[-1], [one])

    def rest(self) -> None:
        """Make steps of conditions to which no step belongs."""
        for one in self.early:
            self.steps.append(TextStep(do=_cut(f"{one.do} ({one.when})"), sources=one.sources))
        self.early = []


def read_steps(texts: Sequence[ExpertText], named: str = "") -> TextProcedure:
    """Return the steps of some texts, in their order. ReadError if there are none.

    ``named`` is the title of several texts together.
    """
    reader = _StepReader()
    parts = [(text, reader.of(text)) for text in texts]
    useful = [(text, title, steps) for text, (title, steps) in parts if steps]
    if not useful:
        raise ReadError(
            "no steps were found: the reader knows headings, numbered lists and tables",
            Place(texts[0].file, 1, 1),
            _TOO_LITTLE,
        )
    language: Literal["en", "de"] = "de" if reader.wording is words.GERMAN else "en"
    if len(useful) == 1:
        ((_, title, steps),) = useful
    else:
        title = named or useful[0][1]
        steps = [
            TextStep(do=_cut(own), steps=tuple(inner), sources=inner[0].sources[:1])
            for _, own, inner in useful
        ]
    return TextProcedure(
        title=_cut(title), language=language, steps=tuple(steps), cautions=reader.cautions[:200]
    )


class _StepReader:
    def __init__(self) -> None:
        self._cautions: list[Caution] = []
        self.wording = words.ENGLISH

    @property
    def cautions(self) -> tuple[Caution, ...]:
        return tuple(self._cautions)

    def of(self, text: ExpertText) -> tuple[str, list[TextStep]]:
        """Return the title of a text and its steps."""
        root = outline_of(text)
        self.wording, _ = words.wording_of(" ".join(line.text for line in text.lines))
        title = text.file.rpartition(".")[0] or text.file
        tops = [part for part in root.below if part.kind == HEADING]
        if (
            tops
            and root.below[0] is tops[0]
            and sum(one.depth == tops[0].depth for one in tops) == 1
        ):
            title = tops[0].text
            # What stands below the title is the procedure.
            root.below = [*tops[0].below, *(one for one in root.below if one is not tops[0])]
        steps = self._section(root)
        while len(steps) == 1 and steps[0].steps and not steps[0].remedies:
            steps = list(steps[0].steps)
        return title, steps

    def _section(self, part: TextPart) -> list[TextStep]:
        """Return the steps of a part: those of its lists, and each heading that has steps."""
        found = _FoundSteps()
        kinds = {one.kind for one in part.below}
        numbered = NUMBERED in kinds or ROW in kinds
        headed = any(one.kind == HEADING and not _is_aside(one) for one in part.below)
        for one in part.below:
            if one.kind == HEADING:
                self._headed(one, found)
            elif one.kind == BULLET and numbered:
                self._conditions(one, found)
            elif one.kind in ITEMS:
                self._item(one, found)
            elif numbered or headed or one.kind != PARAGRAPH:
                self._conditions(one, found)
            else:
                self._prose(one, found)
        found.rest()
        return found.steps

    def _headed(self, part: TextPart, found: _FoundSteps) -> None:
        if _is_aside(part):
            self._cautions.extend(_cautions(part))
            return
        inner = self._section(part)
        if len(inner) == 1 and not inner[0].steps:
            found.add(inner[0])
        elif inner:
            found.add(
                TextStep(
                    do=_cut(_title(part.text)), sources=_sources(part.cite()), steps=tuple(inner)
                )
            )

    def _item(self, part: TextPart, found: _FoundSteps) -> None:
        if part.kind == ROW:
            for told in row_step(part):
                if isinstance(told, TextStep):
                    found.add(told)
                else:
                    found.remedy(told)
            return
        before = len(found.steps)
        head = sentences.open_condition(part.text)
        if head and part.below:
            self._branch(part, head, found)
            return
        for sentence in sentences.sentences_of(part.text):
            cite = part.cite(sentence.start, sentence.end)
            self._sentence(sentence.text, cite, found, part.mark, later=len(found.steps) > before)
        lists = [one for one in part.below if one.kind in ITEMS]
        keyed = [one for one in lists if one.kind == BULLET and KEYED.match(one.text)]
        plain = [one for one in lists if one not in keyed]
        inner = _FoundSteps()
        for one in plain:
            if found.steps and _is_condition(one) and not inner.steps:
                self._item(one, found)
            else:
                self._item(one, inner)
        inner.rest()
        if len(found.steps) == before and inner.steps:
            text = _cut(part.text.rstrip(":. ")) or "Steps"
            found.add(TextStep(do=text, mark=mark_of(part.mark), sources=_sources(part.cite())))
        if inner.steps and found.steps:
            last = found.steps[-1]
            found.steps[-1] = last.model_copy(update={"steps": (*last.steps, *inner.steps)})
        if keyed and len(found.steps) > before:
            found.steps[-1] = keyed_step(found.steps[-1], [one.text for one in keyed])

    def _branch(self, part: TextPart, when: str, found: _FoundSteps) -> None:
        """Take ``If nobody breathes:`` with a list of what is done then."""
        acts = [one.text.rstrip(". ") for one in part.below if one.kind in ITEMS]
        act = "; ".join(act for act in acts if any(map(str.isalnum, act))) or when
        found.remedy(_remedy(sentences.TextCondition(when, act), part.cite()))

    def _sentence(
        self, text: str, cite: Citation, found: _FoundSteps, mark: str, later: bool = False
    ) -> None:
        """Take one sentence. ``later`` says that the item has a step already."""
        text = text.strip().rstrip(".;!:").strip()
        if not any(char.isalnum() for char in text):
            return
        if words.CAUTION.match(text):
            self._cautions.append(Caution(words=_cut(text), sources=_sources(cite)))
            return
        roles = sentences.confirmers(text)
        condition = None if roles else sentences.condition_of(text)
        if condition is not None:
            found.remedy(_remedy(condition, cite))
            return
        if other := sentences.otherwise(text):
            found.add(_step(other, cite, ""))
            return
        if what := sentences.awaited(text):
            done = f"{self.wording.waiting}{what}"
            found.add(_step(done, cite, mark, {"until": _cut(what), "wait": True}))
            if act := sentences.after_waiting(text):
                found.add(_step(act, cite, ""))
            return
        if sentences.is_pause(text):
            found.add(_step(text, cite, mark, {"takes": sentences.seconds(text), "wait": True}))
            return
        if later and not _begins_step(text):
            return  # A further sentence explains the step.
        found.add(_step(text, cite, mark if not later else "", {"confirm": roles}))

    def _conditions(self, part: TextPart, found: _FoundSteps) -> None:
        """Take the conditions and cautions of a text that stands beside the steps."""
        for sentence in sentences.sentences_of(part.text):
            text = sentence.text.strip().rstrip(".;!")
            cite = part.cite(sentence.start, sentence.end)
            if words.CAUTION.match(text):
                self._cautions.append(Caution(words=_cut(text), sources=_sources(cite)))
                continue
            condition = sentences.condition_of(text)
            if condition is not None and words.IF_FIRST.match(text) and found.steps:
                found.remedy(_remedy(condition, cite))

    def _prose(self, part: TextPart, found: _FoundSteps) -> None:
        """Take a paragraph where no list stands: each sentence that begins as a step is one."""
        for sentence in sentences.sentences_of(part.text):
            text = sentence.text.strip()
            cite = part.cite(sentence.start, sentence.end)
            asks = _begins_step(text) or sentences.awaited(text) or sentences.condition_of(text)
            if asks:
                self._sentence(text, cite, found, "")


def _step(text: str, cite: Citation, mark: str, said: Mapping[str, Any] = NOTHING) -> TextStep:
    """Return the step of a sentence. ``said`` has what is known of it already."""
    danger, text = sentences.risk(text)
    who, act = sentences.who_and_what(text)
    until = ""
    if "until" not in said:
        act, until = sentences.until(act)
        act = f"{act} ({until})" if until and len(act) < 3 else act
    step = TextStep(
        do=_cut(sentences.capital(act)),
        mark=mark_of(mark),
        who=_cut(who),
        until=_cut(until),
        within=sentences.within(text),
        risk=risk_of(danger),
        sources=_sources(cite),
    )
    return step.model_copy(update=dict(said))


def _remedy(condition: sentences.TextCondition, cite: Citation) -> Remedy:
    act = condition.act
    who, what = sentences.who_and_what(act)
    # Nobody says that the step is done then, so it is done and checked again.
    back = "again"
    if found := words.BACK_TO.search(act):
        back = found["step"]
    elif words.FROM_START.search(act):
        back = "start"
    elif words.GO_ON.search(act) and not words.AGAIN.search(act):
        back = "on"
    return Remedy(
        when=_cut(sentences.capital(condition.when)),
        do=_cut(sentences.capital(what)),
        back=back,
        who=_cut(who),
        sources=_sources(cite),
    )


def _with(step: TextStep, remedies: Sequence[Remedy]) -> TextStep:
    """Return a step with more remedies: of one with parts, its last part gets them."""
    if step.steps:
        *others, last = step.steps
        return step.model_copy(update={"steps": (*others, _with(last, remedies))})
    kept = (*step.remedies, *remedies)[:12]
    return step.model_copy(update={"remedies": kept})


def _begins_step(text: str) -> bool:
    """Return whether a further sentence asks for something more: ``Then ...``, or a role acts."""
    who, _ = sentences.who_and_what(text)
    lead = text.partition(" ")[0].rstrip(",").lower()
    return bool(who) or lead in _THEN


_THEN = frozenset(("then", "next", "first", "finally", "after", "now", "second", "third", "dann",
                   "danach", "zuerst", "zunächst", "anschließend", "schließlich", "nun",
                   "zweitens", "drittens"))  # fmt: skip


def _is_condition(part: TextPart) -> bool:
    return words.IF_FIRST.match(part.text) is not None and not part.below


def _is_aside(part: TextPart) -> bool:
    return bool(words.ASIDE.search(part.text) or words.EQUIPMENT.search(part.text))


def _cautions(part: TextPart) -> Iterator[Caution]:
    for one in part.below:
        for sentence in sentences.sentences_of(one.text):
            if words.CAUTION.match(sentence.text):
                cite = one.cite(sentence.start, sentence.end)
                found = [source_of(below.text.partition(":")[2]) for below in one.below]
                given = tuple(source for source in found if source is not None)
                yield Caution(words=_cut(sentence.text), sources=given or _sources(cite))
        yield from _cautions(one)


def _title(text: str) -> str:
    """Return the words of a heading, without a number such as "2.1" before them."""
    lead, _, rest = text.partition(" ")
    return rest.strip() if rest and lead.strip(".):").replace(".", "").isdigit() else text


def _sources(*citations: Citation) -> tuple[Source, ...]:
    return tuple(map(Source.of, citations))


def _cut(text: str) -> str:
    text = " ".join(text.replace("**", "").split())
    return text if len(text) <= 200 else f"{text[:197].rstrip()}..."
