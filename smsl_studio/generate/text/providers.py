"""Finds the provider that a command names."""

from __future__ import annotations

from pathlib import Path

from smsl_studio.errors import UsageError, did_you_mean
from smsl_studio.generate.text.by_hand_provider import AnswerFolder
from smsl_studio.generate.text.kept_answers import read_kept
from smsl_studio.generate.text.provider import StageProvider
from smsl_studio.generate.text.reader_provider import TextReader
from smsl_studio.generate.text.server_provider import AnswerServer

READER, BY_HAND, REPLAY = "reader", "by-hand", "replay:"
CHOICE = f"Choose {READER}, {BY_HAND}, {REPLAY}FILE, or the base URL of a server."


def provider_named(name: str | None, by_hand: Path | None = None) -> StageProvider:
    """Return the provider of a name. Without a name it is the reader, or a person if there is a
    folder of answers.

    UsageError for another name, or if a folder is missing or useless. ReadError for kept answers
    that cannot be read.
    """
    if by_hand is not None:
        return AnswerFolder(by_hand)
    if name is None or name == READER:
        return TextReader()
    if name == BY_HAND:
        raise UsageError(
            "by hand needs a folder with the answers",
            advice="Write --by-hand DIR: prompts are written there.",
        )
    if name.startswith(REPLAY):
        return read_kept(name.removeprefix(REPLAY))
    if "://" in name:
        return AnswerServer(name)
    raise UsageError(
        f"{name!r} is no provider", advice=did_you_mean(name, (READER, BY_HAND)) or CHOICE
    )
