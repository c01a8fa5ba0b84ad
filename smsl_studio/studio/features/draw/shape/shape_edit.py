"""ShapeEdit: a change of the shape with the same behaviour. It is computed here, but not made."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

from smsl_studio.blueprint.address import Address
from smsl_studio.blueprint.model import Blueprint
from smsl_studio.blueprint.names import fresh_branch_name
from smsl_studio.blueprint.reading import read_blueprint
from smsl_studio.errors import StudioError
from smsl_studio.front.shapes import extract, flatten, identify, inline
from smsl_studio.front.views.claim_run import RunStep
from smsl_studio.front.views.labelled_run import labelled_run
from smsl_studio.generate.shapes.chosen import CutRefused
from smsl_studio.generate.shapes.identify import FoundCut, Identification
from smsl_studio.generate.shapes.same_states import SameStates, merged
from smsl_studio.smsl.conversion import convert
from smsl_studio.studio.base.words import counted, series
from smsl_studio.studio.document.inspector import LIMIT

PROVED = "It behaves as before, for this blueprint as written."


@dataclass(frozen=True, eq=False)
class ShapeEdit:
    """A computed change of the shape.

    ``words`` is its name in the history. ``result`` is the title of the preview's right side.
    ``sentence`` says what the change does. ``marked`` says whether the preview marks single
    differences.
    """

    before: Blueprint
    after: Blueprint
    words: str
    result: str
    sentence: str
    marked: bool = False


def flat_edit(blueprint: Blueprint) -> ShapeEdit:
    """Compute the blueprint with all SBs as one. It is written in the form of the present file."""
    flat = flatten(blueprint, None, LIMIT)
    home = blueprint.document
    after = read_blueprint(convert(flat.document, home.form, home.file).document)
    (branch,) = after
    sentence = f"One State Branch, {branch.name}, with {counted(len(branch.table), 'state')}."
    return ShapeEdit(blueprint, after, "Flatten", "flat", f"{sentence} {PROVED}")


def extract_edit(blueprint: Blueprint, branch: str, states: tuple[str, ...]) -> ShapeEdit:
    """Compute the blueprint with some states of an SB as a new sub-SB."""
    name = fresh_branch_name(blueprint)
    after = extract(blueprint, branch, states, name, LIMIT)
    return _extracted(blueprint, after, branch, states, name)


def found_edit(blueprint: Blueprint, found: FoundCut) -> ShapeEdit:
    """Compute the blueprint with a found group of states as a new sub-SB."""
    states = found.cut.chosen.states
    return _extracted(blueprint, found.after, found.branch.name, states, found.name)


def inline_edit(blueprint: Blueprint, sub: str) -> ShapeEdit:
    """Compute the blueprint with a sub-SB put back into its base."""
    base = blueprint.bases[sub][0][0] if blueprint.bases.get(sub) else ""
    after = inline(blueprint, sub, LIMIT)
    sentence = f"{sub} and its base {base} are one State Branch. {PROVED}"
    return ShapeEdit(blueprint, after, f"Put {sub} back into {base}", "as one", sentence)


def merge_edit(blueprint: Blueprint, same: SameStates) -> ShapeEdit:
    """Compute the blueprint with states that behave alike merged into one."""
    after = merged(blueprint, same, LIMIT)
    kept = next(name for name in same.states if name in after[same.branch].table)
    names = series([name for name in same.states if name != kept])
    sentence = f"What leads to {names} leads to {kept}. {PROVED}"
    words = f"Merge {names} into {kept}"
    return ShapeEdit(blueprint, after, words, "merged", sentence, marked=True)


def _extracted(
    blueprint: Blueprint, after: Blueprint, branch: str, states: tuple[str, ...], name: str
) -> ShapeEdit:
    fewer = len(blueprint[branch].table) - len(after[branch].table)
    saved = f"{branch} has {counted(fewer, 'state')} less. " if fewer > 0 else ""
    become = "becomes" if len(states) == 1 else "become"
    sentence = f"{series(states)} {become} the sub-SB {name} of {branch}. {saved}{PROVED}"
    words = f"Extract {name} from {branch}"
    return ShapeEdit(blueprint, after, words, f"with {name}", sentence)


@dataclass(frozen=True, eq=False)
class ShapeRefusal:
    """Why a change of the shape is not possible.

    ``run`` has the names of the operations of a run that shows the reason. ``steps`` has the steps
    of this run, as far as the drawing permits them.
    """

    error: StudioError
    run: tuple[str, ...] = ()
    steps: tuple[RunStep, ...] = ()


def identified(blueprint: Blueprint) -> Identification:
    """Return the groups of states that could become a sub-SB."""
    return identify(blueprint, LIMIT)


def tried(work: Callable[[Blueprint], Any], blueprint: Blueprint) -> Any:
    """Return the result of ``work``. If it raises a StudioError, return a ShapeRefusal."""
    try:
        return work(blueprint)
    except CutRefused as error:
        return ShapeRefusal(error, error.run, _walked(blueprint, error.run))
    except StudioError as error:
        return ShapeRefusal(error)


def _walked(blueprint: Blueprint, run: tuple[str, ...]) -> tuple[RunStep, ...]:
    """Return the steps of a run from the names of its operations, which may include SBs."""

    def short(address: Address) -> str:
        """Return the name of an operation without its SB."""
        return address.operation

    if not run:
        return ()
    return max(labelled_run(blueprint, run, short), labelled_run(blueprint, run), key=len)
