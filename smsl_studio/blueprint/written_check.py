"""A state check in the notation of the paper, with the truth of every term.

    C_State110 := lambda s: [f1(s), f2(s), f3(s)]

f1 is the first fact. It is true if the scene has the value that the state needs. In the paper a
term is true or false; here it may also be unknown, with a reason.
"""

from __future__ import annotations

from dataclasses import dataclass

from smsl_studio.blueprint.check import CheckResult, Term
from smsl_studio.blueprint.model import Blueprint


@dataclass(frozen=True, slots=True)
class WrittenTerm:
    """One f_i(s): its text, its place in the whole text, its truth, and the reason in words."""

    text: str
    start: int
    term: Term
    why: str

    @property
    def truth(self) -> bool | None:
        """Whether the term is true, None if that is unknown."""
        return self.term.truth

    @property
    def end(self) -> int:
        """The offset after the term in the text of the whole check."""
        return self.start + len(self.text)


@dataclass(frozen=True, slots=True)
class WrittenCheck:
    """A state check in the notation of the paper. ``text`` has the terms at their places."""

    name: str
    text: str
    terms: tuple[WrittenTerm, ...]
    truth: bool | None


def written_check(blueprint: Blueprint, check: CheckResult) -> WrittenCheck:
    """Return ``lambda s: [f1(s), f2(s)]`` of a check. Terms that the check left out are missing."""
    text = "lambda s: ["
    terms = []
    for index, term in enumerate(check.terms):
        text += ", " if index else ""
        said = f"f{term.fact[1] + 1}(s)"
        terms.append(WrittenTerm(said, len(text), term, term_words(blueprint, term)))
        text += said
    return WrittenCheck(f"C_{check.state}", text + "]", tuple(terms), check.truth)


def term_words(blueprint: Blueprint, term: Term) -> str:
    """Return a term in words, such as ``Clamp fixed reads 0, not 1`` or ``... is unknown: no
    reading``.
    """
    branch, digit = term.fact
    name = blueprint[branch].fact_name(digit)
    if term.truth is None:
        return f"{name} is unknown: {term.reason}"
    wanted = "" if term.truth else f", not {term.wanted}"
    source = f" ({term.reason})" if term.reason else ""
    return f"{name} reads {term.reading}{wanted}{source}"
