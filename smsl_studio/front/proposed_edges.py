"""Who proposes edges in a run, and the answers that it got. The parts are loaded if a run asks."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING

from smsl_studio.errors import RunRefused
from smsl_studio.front.request import RunRequest
from smsl_studio.library.loaded import Loaded
from smsl_studio.smsl.files import save_document

if TYPE_CHECKING:
    from smsl_studio.dispatch.dispatcher import Dispatcher
    from smsl_studio.dispatch.drive.generation import EdgeProposer

ANSWERS = ".answers.json"
"""The file of answers of a run has the name of its log, with this behind it."""


def proposer_of(request: RunRequest, loaded: Loaded | None) -> EdgeProposer | None:
    """Return who proposes edges in a run, None for nobody. UsageError for an unknown provider.
    RunRefused in a world that is hardware, if no policy allows it."""
    if not request.generate:
        return None
    from smsl_studio.front.edge_proposer import RunProposer

    found, trust = RunProposer(request, loaded), request.trust
    if trust is not None and trust.hardware and not found.in_hardware:
        words = f"{request.world} is hardware, and edges are generated in a run of it"
        advice = 'Leave --generate out, or let the policy say generated_edges = "confirmed".'
        raise RunRefused(words, advice=advice, refusals=[("policy_unmet", words)])
    return found


def keep_answers(log: Path | None, dispatcher: Dispatcher) -> None:
    """Write the answers of who proposed edges beside the log, so that the run can be repeated."""
    if log is None or dispatcher.proposer is None:
        return
    from smsl_studio.front.edge_proposer import kept_answers

    text = kept_answers(dispatcher.proposer)
    if text:
        save_document(text, log.with_name(f"{log.name}{ANSWERS}"))
