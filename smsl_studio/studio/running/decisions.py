"""Decisions: what a key or a button would do, as a sentence that a person confirms with Enter."""

from __future__ import annotations

from dataclasses import dataclass, replace

from smsl_studio.blueprint.address import Address
from smsl_studio.blueprint.model import Blueprint
from smsl_studio.dispatch.execution.status import DispatchStatus, Offer, Possible
from smsl_studio.dispatch.supervision.row import Command
from smsl_studio.dispatch.supervision.table import COMMANDS
from smsl_studio.front.views.partial import (
    PAUSED,
    PROPOSED,
    PRUNED,
    RISKY,
    RUNNING,
    VETOED,
    WAITS,
    OperationCard,
)
from smsl_studio.studio.base.words import capital, counted

MOVING = "It is stopped and held. "
ENDED = "It has ended, so nothing is stopped now. "


@dataclass(frozen=True)
class Decision:
    """One command that awaits a confirmation.

    ``verb`` is the label of the button that does it. It is empty if the command is not possible,
    and ``sentence`` then says why. ``reasoned`` asks for a reason.
    """

    command: str
    sentence: str
    verb: str
    address: Address | None = None
    detail: str = ""
    reasoned: bool = False

    def said(self, reason: str = "") -> Command:
        """The command to be sent."""
        about = {} if self.address is None else {"address": self.address}
        why = {"reason": reason} if self.reasoned else {}
        return COMMANDS[self.command].command(**about, **why)


def decision(word: str, address: Address | None = None, detail: str = "") -> Decision:
    """The decision about a command, with the words of its row in the table of commands."""
    row, name = COMMANDS[word], address.operation if address is not None else ""
    sentence, verb = row.asking(name), row.doing(name)
    return Decision(word, sentence, verb, address, detail or row.consequence, row.reasoned)


def choose(card: OperationCard) -> Decision:
    """The decision after a click on a card: carry the operation out, restore it, or why neither
    is possible."""
    name, target = card.name, card.target
    if card.standing in (PRUNED, RISKY):
        return _restore(card.address, card.reasons, card.standing)
    if card.standing in (WAITS, PROPOSED):
        return Decision("", f"{name} waits for an answer to its task.", "", card.address)
    if card.permitted or card.standing == VETOED:
        to = f"It stays in {target}." if card.stays else f"It leads to {target}."
        detail = f"{to} Cost {card.cost}." + (f" Risk {card.risk}." if card.risk else "")
        return decision("ask", card.address, detail)
    if card.standing in (RUNNING, PAUSED):
        return Decision("", f"{name} is being carried out.", "", card.address)
    why = " ".join(map(capital, card.reasons)) or "It may not be asked for now."
    return Decision("", f"{name} is not possible now.", "", card.address, why)


def possible(address: Address | None, status: DispatchStatus) -> Possible | None:
    """The entry of an operation among the possible ones; None if it leaves no active state."""
    return next((one for one in status.possible if one.address == address), None)


def _restore(address: Address, reasons: tuple[str, ...], standing: str) -> Decision:
    """The decision to let an operation be used again.

    ``standing`` is named if no reason is known.
    """
    return decision("restore", address, capital("; ".join(reasons) or f"It is {standing}"))


def veto(address: Address, status: DispatchStatus) -> Decision:
    """The decision to skip the next operation once."""
    name = address.operation
    if status.running == address:
        why = (
            "It already moves: a veto comes too late. Stop brakes it, Prune stops and excludes it."
        )
        return Decision("", f"{name} is being carried out.", "", address, why)
    item = possible(address, status)
    if item is not None and (item.pruned or item.vetoed):
        return _restore(address, item.reasons, PRUNED if item.pruned else "vetoed once")
    return decision("veto", address)


def prune(address: Address, status: DispatchStatus) -> Decision:
    """The decision to exclude an operation until somebody restores it."""
    item = possible(address, status)
    if item is not None and item.pruned:
        return _restore(address, item.reasons, PRUNED)
    moving = MOVING if status.running == address else ""
    return decision("prune", address, f"{moving}{COMMANDS['prune'].consequence}")


def followed(asked: Decision, status: DispatchStatus) -> Decision:
    """The same question with the words for a run that has gone on since it was asked.

    Only a veto and a prune have other words then.
    """
    address = asked.address
    if address is None or asked.command not in ("veto", "prune"):
        return asked
    now = {"veto": veto, "prune": prune}[asked.command](address, status)
    moved = asked.detail.startswith((MOVING, ENDED))
    if now.command == "prune" and moved and status.running != address:
        return replace(now, detail=f"{ENDED}{now.detail}")
    return now


def gone_words(asked: Decision) -> str:
    """The sentence that a question is gone because the run has ended."""
    question = f' "{asked.sentence}"' if asked.verb else ""
    return f"The run has ended, so the question{question} is gone. Nothing of it was recorded."


def accept(status: DispatchStatus) -> Decision:
    """The decision to let the automation continue from the located state."""
    located = ", ".join(f"{sb} in {state}" for sb, state in status.candidates[0].items())
    row = COMMANDS["accept"]
    return Decision("accept", f"Located: {located}.", row.verb, detail=row.consequence)


def offered(offer: Offer) -> Decision:
    """The decision about an offer of a run that holds."""
    address = Address(*Address.split(offer.address)) if offer.address else None
    row, name = COMMANDS[offer.command], address.operation if address is not None else ""
    verb, detail = row.doing(name), capital(offer.sentence)
    return Decision(offer.command, f"{verb}?", verb, address, detail)


ELSEWHERE = ("give_back", "accept", "stop")
"""Commands with a button of their own, which are left out of the offers."""


def offers(status: DispatchStatus) -> tuple[Offer, ...]:
    """The offers of a run that holds or is stopped. There is always one, at least to end it."""
    found = [offer for offer in status.offers if offer.command not in ELSEWHERE]
    known = {offer.command for offer in found}
    if status.phase == "stopped" and "reset" not in known:
        found.insert(0, _way_out("reset"))
    if status.phase in ("stopped", "fault_hold", "no_route") and "end" not in known:
        found.append(_way_out("end"))
    return tuple(found)


def _way_out(word: str) -> Offer:
    return Offer(word, "", COMMANDS[word].consequence)


def way_out(word: str) -> Decision:
    """The decision to reset a stopped run, or to end a run."""
    return offered(_way_out(word))


def end(held: bool) -> Decision:
    """The decision to end a run; one that is neither stopped nor ``held`` is stopped first."""
    asked = way_out("end")
    if held:
        return asked
    detail = f"What moves is stopped first, under control. {asked.detail}"
    return replace(asked, verb="Stop and end", detail=detail)


def detour_words(blueprint: Blueprint, status: DispatchStatus, subject: Address | None) -> str:
    """Which route would follow a veto of ``subject``, and how much longer and dearer it is.

    Empty if ``subject`` is not the next operation or is already carried out, because a veto would
    then change no route.
    """
    if not status.route or status.phase in ("done", "stopped", "taken_over"):
        return ""
    if status.carrying is not None or subject != status.route[0]:
        return ""
    if status.detour is None:
        return "If you veto, no other route leads to the goal: the run holds."
    if not status.detour:
        return ""
    first, *rest = status.detour
    said = f"If you veto, the next route is {first.operation}"
    if rest:
        said += f", then {rest[0].operation} from {rest[0].state}"
    left = len(rest) - 1
    if left > 0:
        said += f", and {left} more"
    longer = len(status.detour) - len(status.route)
    more = "longer" if longer > 0 else "shorter"
    length = f"{counted(abs(longer), 'operation')} {more}" if longer else "Same length"
    cost = sum(blueprint[one.branch].cost(one.state, one.operation) for one in status.detour)
    return f"{said}. {length}, cost {cost:.1f}."
