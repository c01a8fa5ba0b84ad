"""The chain PM, HIM, PSM, RMM: asks for each stage, checks the answer, and asks again with what was
wrong. Nothing of an answer is run, imported, opened or fetched."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field, replace
from typing import Any, TypeVar

from smsl_studio.blueprint.model import Blueprint
from smsl_studio.generate.text import equipment as equipments
from smsl_studio.generate.text import functions as codes
from smsl_studio.generate.text import prompts
from smsl_studio.generate.text import steps as procedures
from smsl_studio.generate.text.agreement import disagreements
from smsl_studio.generate.text.answers import AnswerFault, fitted, json_of
from smsl_studio.generate.text.blueprint_answer import (
    blueprint_of_answer,
    read_values,
    uncited_faults,
)
from smsl_studio.generate.text.equipment import NeededEquipment, PluginOffer, equipment_page
from smsl_studio.generate.text.expert_text import ExpertText, digest_of_texts
from smsl_studio.generate.text.functions import Functions, function_files, needed_functions
from smsl_studio.generate.text.kept_answers import AnsweredQuestion, kept_page
from smsl_studio.generate.text.passages import Passage
from smsl_studio.generate.text.prompts import FILES, HIM, PM, PSM, RMM
from smsl_studio.generate.text.provider import (
    Matter,
    StageProvider,
    StageQuestion,
    Unanswered,
)
from smsl_studio.generate.text.step_numbers import numbered, unknown_numbers
from smsl_studio.generate.text.step_page import step_page
from smsl_studio.library.loaded import Loaded, Plugin
from smsl_studio.smsl.json_form import write_json
from smsl_studio.stop import heed

Json = Any
Result = TypeVar("Result")
KEPT = "answers.json"


@dataclass
class TextChain:
    """What the chain has reached: a text for each file that it writes, by its name.

    ``lacking`` says, where it did not come to its end, which stage has no answer, or why its
    answers were given up.
    """

    files: dict[str, str] = field(default_factory=dict)
    blueprint: Blueprint | None = None
    equipment: NeededEquipment | None = None
    procedure: procedures.TextProcedure | None = None
    functions: Mapping[str, str] = field(default_factory=dict)
    """The files of the operations without a function, by operation."""
    doubts: tuple[str, ...] = ()
    """Sentences about what the blueprint says otherwise than the stages before."""
    lacking: list[tuple[str, str]] = field(default_factory=list)
    """Sentences, each with its advice."""


class GivenUp(Exception):  # noqa: N818
    """The answers of a stage did not fit, also after repairs."""

    def __init__(self, stage: str, faults: Sequence[str], attempts: int) -> None:
        many = f" after {attempts} answers" if attempts > 1 else ""
        super().__init__(f"stage {stage} was given up{many}: {'; '.join(faults[:3])}")
        self.stage, self.faults = stage, tuple(faults)


def run_chain(
    texts: Sequence[ExpertText],
    hardware: Sequence[ExpertText],
    provider: StageProvider,
    loaded: Loaded,
    passages: Sequence[Passage] = (),
) -> TextChain:
    """Ask for all stages. What was reached is returned, also if a stage has no answer. ``passages``
    are what other texts say about the procedure; they may be cited, too."""
    matter = Matter(texts, hardware, passages, _offers(loaded))
    return _Chain(matter, provider, loaded).run()


def run_functions(blueprint: Blueprint, provider: StageProvider, loaded: Loaded) -> TextChain:
    """Ask for the functions of a blueprint that is there already (stage RMM alone)."""
    matter = Matter((), offers=_offers(loaded))
    return _Chain(matter, provider, loaded).run_functions(blueprint)


def _offers(loaded: Loaded) -> tuple[PluginOffer, ...]:
    """Return what plugins offer whose code people have written."""
    return tuple(
        _offer(plugin)
        for plugin in loaded.plugins
        if not any(entry.code for entry in plugin.library.operations)
    )


def _offer(plugin: Plugin) -> PluginOffer:
    return PluginOffer(
        plugin=plugin.name,
        worlds=tuple(plugin.library.worlds),
        operations=tuple(
            entry.pattern.text if entry.pattern else entry.name
            for entry in plugin.library.operations
        ),
        sensors=tuple(entry.pattern.text for entry in plugin.library.sensors),
    )


def _useful(
    blueprint: Blueprint, offers: Sequence[PluginOffer], loaded: Loaded
) -> list[PluginOffer]:
    """Return the plugins that do something of a blueprint. All of them if there is none."""
    names = {(branch.name, edge.name) for branch in blueprint for edge in branch.edges()}
    serving = {
        plugin.name
        for plugin in loaded.plugins
        for entry in plugin.library.operations
        if not entry.code and any(entry.texts(*name) is not None for name in names)
    }
    with_world = [one for one in offers if one.worlds]
    return [one for one in with_world if one.plugin in serving] or with_world


class _Chain:
    def __init__(self, matter: Matter, provider: StageProvider, loaded: Loaded) -> None:
        self._matter, self._provider, self._loaded = matter, provider, loaded
        self._reached = TextChain()
        self._answered: list[AnsweredQuestion] = []

    def run(self) -> TextChain:
        reached = self._reached
        by_file = self._provider.by_file
        try:
            self._steps(by_file)
        except (Unanswered, GivenUp) as error:
            self._lack(error)
            if isinstance(error, GivenUp) or not by_file:
                return self._kept()
        try:
            self._equipment(by_file)
            if reached.procedure is not None:
                self._blueprint(by_file)
                self._functions(by_file)
        except (Unanswered, GivenUp) as error:
            self._lack(error)
        return self._kept()

    def run_functions(self, blueprint: Blueprint) -> TextChain:
        self._reached.blueprint = blueprint
        try:
            self._functions(self._provider.by_file)
        except (Unanswered, GivenUp) as error:
            self._lack(error)
        return self._kept()

    def _lack(self, error: Unanswered | GivenUp) -> None:
        if isinstance(error, Unanswered):
            self._reached.lacking.append((error.sentence, error.advice))
        elif self._provider.by_file:
            advice = f"Mend {FILES[error.stage]} in your folder, and call this again."
            words = f"stage {error.stage} does not fit yet: {'; '.join(error.faults[:3])}"
            *others, last = words, *error.faults[3:]
            self._reached.lacking += [*((one, "") for one in others), (last, advice)]
        else:
            advice = "The prompts and the answers lie in answers.json. Write this stage by hand."
            self._reached.lacking.append((str(error), advice))

    def _kept(self) -> TextChain:
        matter = self._matter
        self._reached.files[KEPT] = kept_page(self._answered, matter.sources, matter.hardware)
        return self._reached

    def _steps(self, by_file: bool) -> None:
        matter = self._matter

        def check(text: str) -> procedures.TextProcedure:
            told = fitted(procedures.TextProcedure, json_of(text))
            found = numbered(told)
            faults = [*procedures.faults_of(found), *unknown_numbers(told)]
            for step in procedures.every_step(found.steps):
                cited = [*step.sources, *(one for r in step.remedies for one in r.sources)]
                wrong = uncited_faults(cited, matter.sources)
                faults += [f"step {step.mark}: {words}" for words in wrong]
            return _sound(found, faults)

        found = self._asked(PM, prompts.pm_prompt(matter, by_file), check)
        matter.procedure = self._reached.procedure = found
        self._reached.files[FILES[PM]] = step_page(found, self._origin())

    def _equipment(self, by_file: bool) -> None:
        matter = self._matter

        def check(text: str) -> NeededEquipment:
            found = fitted(NeededEquipment, json_of(text))
            faults = equipments.faults_of(found)
            cited = [source for one in found.devices for source in one.sources]
            cited += [source for one in found.needs for source in one.sources]
            faults += uncited_faults(cited, (*matter.sources, *matter.hardware))
            return _sound(found, faults)

        prompt = prompts.him_prompt(matter, by_file)
        found = self._asked(HIM, prompt, check)
        matter.equipment = self._reached.equipment = found
        self._reached.files[FILES[HIM]] = equipment_page(found, matter.offers, self._origin())

    def _blueprint(self, by_file: bool) -> None:
        matter, files = self._matter, self._reached.files
        texts = (*matter.sources, *matter.hardware)
        prompt = prompts.psm_prompt(matter, files[FILES[PM]], files[FILES[HIM]], by_file)
        values = self._asked(PSM, prompt, lambda text: blueprint_of_answer(json_of(text), texts)[1])
        names = ", ".join(one.file for one in matter.texts)
        origin = {
            "how": "text", **self._origin(), "from": names,
            "digest": digest_of_texts(matter.texts),
        }  # fmt: skip
        written = {**values, "_origin": origin}
        self._reached.blueprint = made = read_values(written)
        if matter.procedure is not None and matter.equipment is not None:
            self._reached.doubts = disagreements(matter.procedure, matter.equipment, made)
        files[FILES[PSM]] = write_json(written)

    def _functions(self, by_file: bool) -> None:
        blueprint = self._reached.blueprint
        if blueprint is None:
            return
        needed = needed_functions(blueprint, self._loaded)
        if not needed:
            return
        names = codes.file_names(needed)
        self._matter.needed, self._matter.names = needed, names

        def check(text: str) -> Functions:
            found = fitted(Functions, json_of(text))
            return _sound(found, codes.faults_of(found, needed))

        offers = _useful(blueprint, self._matter.offers, self._loaded)
        found = self._asked(RMM, prompts.rmm_prompt(needed, names, offers, by_file), check)
        self._reached.functions = names
        for name, text in function_files(found, needed, names, self._origin()):
            self._reached.files[f"{FILES[RMM]}/{name}"] = text

    def _origin(self) -> dict[str, Json]:
        return self._answered[-1].origin

    def _asked(self, stage: str, prompt: str, check: Callable[[str], Result]) -> Result:
        """Return the checked answer of a stage. GivenUp if no answer fits."""
        asked = prompt
        faults: tuple[str, ...] = ()
        for attempt in range(1, self._provider.attempts + 1):
            heed()
            question = StageQuestion(stage, asked, attempt, self._matter)
            answer = self._provider.answer(question)
            done = AnsweredQuestion(question, answer)
            try:
                found = check(answer.text)
            except AnswerFault as error:
                faults = error.faults
                self._answered.append(replace(done, faults=faults))
                asked = prompts.repair_prompt(prompt, answer.text, faults)
                continue
            self._answered.append(done)
            return found
        raise GivenUp(stage, faults, self._provider.attempts)


Sound = TypeVar("Sound")


def _sound(found: Sound, faults: Sequence[str]) -> Sound:
    if faults:
        raise AnswerFault(list(faults))
    return found
