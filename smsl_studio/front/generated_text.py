"""Blueprints made of expert text. They say how they were made, and each part cites its words."""

from __future__ import annotations

import json
import os
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace
from itertools import pairwise
from pathlib import Path
from typing import TYPE_CHECKING, Any

from smsl_studio.blueprint.model import Blueprint
from smsl_studio.errors import UsageError
from smsl_studio.front.chain_files import REQUIREMENTS, refuse_places, write_chain
from smsl_studio.front.inputs import read
from smsl_studio.generate.text.chain import KEPT, TextChain, run_chain, run_functions
from smsl_studio.generate.text.expert_text import ExpertText, text_at
from smsl_studio.generate.text.language_words import is_foreign
from smsl_studio.generate.text.people_script import people_script
from smsl_studio.generate.text.prompts import FILES, PSM
from smsl_studio.generate.text.providers import BY_HAND, READER, provider_named
from smsl_studio.generate.text.requirements import (
    HOLDS,
    RequirementVerdict,
    read_requirements,
    unanswered,
    verdicts_of,
)
from smsl_studio.generate.text.source_folder import ChosenSources, chosen_sources
from smsl_studio.generate.text.text_folder import read_folder
from smsl_studio.host.plugin_offers import describe
from smsl_studio.inspection.rules.sources import uncited
from smsl_studio.smsl.files import read_content
from smsl_studio.smsl.forms import SUFFIXES

if TYPE_CHECKING:
    from smsl_studio.generate.text.equipment import NeededEquipment

Json = Any
Name = str | os.PathLike[str]


@dataclass(frozen=True)
class GeneratedText:
    """What became of a text.

    ``blueprint`` is None if the chain did not come so far. ``lacking`` are sentences, each with an
    advice: a stage that nobody has answered, or that was given up. ``missing`` are the names of
    hardware that nothing meets. ``uncited`` are the addresses without a source. ``people`` is the
    number of operations on the way that people carry out or confirm.
    """

    blueprint: Blueprint | None
    goal_reached: bool
    lacking: tuple[tuple[str, str], ...] = ()
    missing: tuple[str, ...] = ()
    uncited: tuple[str, ...] = ()
    people: int = 0
    files: tuple[str, ...] = ()
    doubts: tuple[str, ...] = ()
    """What the blueprint says otherwise than the stages before it."""
    functions: tuple[str, ...] = ()
    """The operations that no library offers; their functions wait in ``rmm``."""
    requirements: tuple[RequirementVerdict, ...] = ()
    left_out: tuple[str, ...] = ()
    """Sentences about what of a folder of sources was left out."""
    former: str = ""
    """The folder with the files that stood there before and differ; empty if there are none."""

    @property
    def is_good(self) -> bool:
        """Whether the chain came to its end, the goal can be reached, and all is fulfilled."""
        met = all(one.verdict == HOLDS for one in self.requirements)
        return self.goal_reached and not self.lacking and met


def generate_text(
    files: Sequence[Name],
    output: Name,
    *,
    provider: str | None = None,
    by_hand: Name | None = None,
    hardware: Name | None = None,
    require: Name | None = None,
) -> GeneratedText:
    """Make a blueprint of expert texts, and write it to ``output`` with what each stage gave.

    A blueprint in the place of the texts goes to the last stage at once: its missing functions. A
    folder among ``files`` is searched for passages that fit; where nothing else is named, its best
    text with steps is the procedure.

    ``pm.md``, ``him.toml``, ``psm.json``, ``rmm/`` and ``answers.json`` stand in the folder of
    ``output``. A file that stands there and differs goes to the folder ``former-1`` first, or the
    next number. ReadError for a text that cannot be read or has no steps. UsageError for an unknown
    provider, or if ``rmm`` is a link.

    >>> _ = Path("lamp.md").write_text("1. Switch the lamp on. 2. Look at it.\\n3. Switch it off.")
    >>> made = generate_text(["lamp.md"], "lamp/lamp.json")
    >>> made.goal_reached, [branch.name for branch in made.blueprint]
    (True, ['LAMP'])
    """
    drawn = _drawn(files)
    target = _target(Path(output))
    refuse_places(target)
    sources = _sources(files, target) if drawn is None else None
    listed = _texts([hardware]) if hardware is not None else []
    folder = Path(by_hand) if by_hand is not None else None
    if folder is not None and provider not in (None, BY_HAND):
        raise UsageError(
            f"--by-hand takes all answers from a folder, and --provider {provider} none",
            advice="Leave one of them out.",
        )
    wanted = None
    if require is not None:
        wanted = read_requirements(read_content(require).raw, os.fspath(require))
    answers = provider_named(provider, folder)
    if sources is not None:
        chosen = sources.chosen
        reached = run_chain(chosen.procedure, listed, answers, describe(), chosen.passages)
    else:
        assert drawn is not None
        reached = run_functions(drawn, answers, describe())
    verdicts: tuple[RequirementVerdict, ...] = ()
    if wanted is not None and reached.blueprint is not None:
        texts_made = {name: text for name, text in reached.files.items() if name != KEPT}
        values = dict(reached.blueprint.document.values)
        verdicts = verdicts_of(wanted, values, texts_made, _proved)
    elif wanted is not None:
        verdicts = unanswered(wanted)
    if wanted is not None:
        told = [one.as_json() for one in verdicts]
        reached.files[REQUIREMENTS] = f"{json.dumps(told, ensure_ascii=False, indent=1)}\n"
    given = [one for one in (*files, hardware, require) if one is not None]
    inputs = [one for one in given if not Path(one).is_dir()]
    written, former = write_chain(reached, target, folder, inputs)
    told_all = _told(reached, written)
    made = replace(told_all, requirements=verdicts, former=str(former or ""))
    if sources is None:
        return made
    doubts = made.doubts
    if folder is None and (provider or READER) == READER:
        doubts = (*_foreign(sources.chosen.procedure), *doubts)
    return replace(made, doubts=doubts, left_out=tuple(sources.left_out))


def _foreign(texts: Sequence[ExpertText]) -> Iterator[str]:
    """Yield what the reader has not understood because of the language of a text."""
    for text in texts:
        if is_foreign(" ".join(line.text for line in text.lines)):
            yield (
                f"{text.file} is in no language that the reader knows (English and German): it "
                "found steps by their numbers, and not who does them, until when, and what may go "
                "wrong"
            )


def _proved(blueprint: Blueprint) -> dict[str, tuple[str, str]]:
    """Return, by the name of each property, its verdict and the reason."""
    from smsl_studio.front.proof import prove

    found = {}
    for one in prove(blueprint).verdicts:
        if str(one.address).startswith("_properties/"):
            path = one.counterexample.path if one.counterexample else ()
            way = " > ".join(map(str, path))
            found[one.name] = one.verdict, one.bound or way or "shown for the blueprint as written"
    return found


def _drawn(files: Sequence[Name]) -> Blueprint | None:
    """Return the blueprint that stands in the place of the texts, or None. UsageError if texts
    stand beside it."""
    named = [one for one in files if Path(one).suffix.lower() in SUFFIXES]
    if not named:
        return None
    if len(files) > 1:
        raise UsageError(
            f"{os.fspath(named[0])} is a blueprint, and something stands beside it",
            advice="Give texts, or one blueprint whose functions are missing.",
        )
    return read(named[0])


@dataclass(frozen=True)
class _Sources:
    """What a blueprint is made of, and sentences about what of a folder was left out."""

    chosen: ChosenSources
    left_out: Sequence[str] = ()


def _sources(files: Sequence[Name], target: Path) -> _Sources:
    """Read the texts, and search the folders among them. UsageError if what is made would lie in a
    folder that is searched."""
    folders = [Path(one) for one in files if Path(one).is_dir()]
    named = _texts([one for one in files if not Path(one).is_dir()])
    if not folders:
        return _Sources(ChosenSources(tuple(named), ()))
    found, left_out = [], []
    for folder in folders:
        if target.parent.resolve().is_relative_to(folder.resolve()):
            words = f"{target.parent} lies in {folder}, which is searched"
            raise UsageError(words, advice="Write to another folder with -o.")
        read_one = read_folder(folder)
        found += read_one.texts
        left_out += read_one.left_out
    _refuse_twice([*named, *found])
    wanted = [target.stem.replace("_", " "), *(folder.name for folder in folders)]
    return _Sources(chosen_sources(named, found, wanted), left_out)


def _texts(files: Sequence[Name]) -> list[ExpertText]:
    texts = [text_at(file) for file in files]
    _refuse_twice(texts)
    return texts


def _refuse_twice(texts: Sequence[ExpertText]) -> None:
    names = sorted(text.file for text in texts)
    twice = next((one for one, two in pairwise(names) if one == two), None)
    if twice is not None:
        raise UsageError(
            f"two texts are called {twice}, so a citation could not name one",
            advice="Give one of them another name.",
        )


def _target(output: Path) -> Path:
    """Return the file of the blueprint. A folder gets ``psm.json``."""
    return output / FILES[PSM] if output.is_dir() or not output.suffix else output


def _told(reached: TextChain, written: tuple[str, ...]) -> GeneratedText:
    blueprint, equipment = reached.blueprint, reached.equipment
    if blueprint is None:
        lacking = tuple(reached.lacking)
        return GeneratedText(None, False, lacking, _missing(equipment), files=written)
    script = people_script(blueprint)
    return GeneratedText(
        blueprint,
        _goal_reached(blueprint),
        tuple(reached.lacking),
        _missing(equipment),
        tuple(str(address) for address in uncited(blueprint)),
        script.count("\n"),
        written,
        functions=tuple(reached.functions),
        doubts=reached.doubts,
    )


def _missing(equipment: NeededEquipment | None) -> tuple[str, ...]:
    return equipment.missing if equipment is not None else ()


def _goal_reached(blueprint: Blueprint) -> bool:
    """Return whether a route leads to the goals: every root in ACTIVATING."""
    from smsl_studio.blueprint.address import Address
    from smsl_studio.blueprint.configuration import Hierarchy, start_configuration
    from smsl_studio.blueprint.terms import Terms
    from smsl_studio.dispatch.route.planner import Planner
    from smsl_studio.errors import PlanningError, RunRefused

    hierarchy = Hierarchy(blueprint)
    goals = [Address(name, blueprint[name].activating) for name in hierarchy.roots]
    try:
        start = start_configuration(hierarchy, {})
        return Planner(hierarchy, Terms()).legs(start, goals) is not None
    except (PlanningError, RunRefused):
        return False
