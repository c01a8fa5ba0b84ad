"""The codecs of values that occur in several messages: names, sentences, times, places."""

from __future__ import annotations

import math

from smsl_studio.errors import Place
from smsl_studio.host.brief import brief
from smsl_studio.host.codec import Codec, Unfit, number, text, whole
from smsl_studio.host.compound import mapped, record
from smsl_studio.library.terms import unfit_name


def name(most: int, empty: bool = False) -> Codec[str]:
    """The codec of a text of one line that can be shown to people (see ``unfit_name``)."""

    def check(value: str) -> str:
        """Return the name unchanged. Unfit if it cannot be shown on one line."""
        wrong = "" if empty and not value else unfit_name(value, most)
        if wrong:
            raise Unfit(wrong)
        return value

    return mapped(text(most), check, check)


def sentence(most: int = 2000) -> Codec[str]:
    """The codec of words for people. The sender cuts longer texts."""
    return mapped(text(most + 40), lambda said: brief(str(said), most), lambda told: told)


NAME = name(1000)
SECONDS = number(0.0, 1e12)
PATIENCE = number(0.0, math.inf)
"""A time in seconds, which may be infinite."""
COUNT = whole(0, 2**53)
PLACE = record(Place, file=sentence(5000), line=COUNT, column=COUNT)
