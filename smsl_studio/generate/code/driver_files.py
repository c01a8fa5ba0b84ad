"""A driver for the protocol of worlds elsewhere (``docs/remote.md``): its files as texts."""

from __future__ import annotations

from collections.abc import Mapping

from smsl_studio.generate.code.templates import BY, rendered

_WORDS = {
    "python": {
        "file": "driver.py",
        "needs": "Python 3.10 or later",
        "build": "",
        "start": "python driver.py",
        "operation": "a generator. Each `yield` waits a tick; `return False` says that it failed.",
        "serves": "in its list which operations",
        "tick": "TICK",
        "hardware": "HARDWARE",
    },
    "cpp": {
        "file": "driver.cpp",
        "needs": "a compiler of C++17 and POSIX",
        "build": "g++ -std=c++17 -O2 -Wall driver.cpp -o driver\n",
        "start": "./driver",
        "operation": "a function that is called at each tick, until it says `returned` or "
        "`failed`.",
        "serves": "which operation",
        "tick": "kTick",
        "hardware": "kHardware",
    },
}
LANGUAGES = tuple(_WORDS)
_COMMENTS = {"python": "#", "cpp": "//"}


def driver_files(target: str) -> Mapping[str, str]:
    """Return the files of a driver in a language, python or cpp, by their names."""
    words = _WORDS[target]
    name = words["file"]
    return {
        name: f"{_COMMENTS[target]} {BY}.\n{rendered('driver', name)}",
        "lamp.json": rendered("driver", "lamp.json"),
        "README.md": rendered("driver", "README.md", by=BY, **words),
    }
