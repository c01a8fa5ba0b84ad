"""The text of a PDF, page by page.

A PDF may be a bomb, so pypdf reads it in a child process with limits of memory and time.
"""

from __future__ import annotations

import json
import subprocess
import sys
from importlib.util import find_spec

from smsl_studio.errors import Place, ReadError, UsageError

LONGEST = 30.0
"""The wall time (s) that the child may take."""
_CHILD = "smsl_studio.generate.text.pdf_child"
_ADVICE = "Give the text of the procedure as .txt or .md."


def pages_of(raw: bytes, file: str) -> list[tuple[int, list[str]]]:
    """Return the number of each page from 1, and its lines. ReadError if the PDF cannot be read, or
    is larger inside than the limits allow. UsageError if pypdf is not installed."""
    if find_spec("pypdf") is None:
        raise UsageError(
            "a PDF is read by pypdf, which is not installed",
            advice="Install it with: pip install smsl-studio[text].",
        )
    try:
        done = subprocess.run(
            [sys.executable, "-m", _CHILD],
            input=raw,
            stdout=subprocess.PIPE,
            stderr=subprocess.DEVNULL,
            timeout=LONGEST,
            check=False,
        )
        told = json.loads(done.stdout)
    except subprocess.TimeoutExpired:
        told = {"fault": f"it takes longer than {LONGEST:g} s"}
    except ValueError:
        told = {"fault": "it needs more memory or time than a text does"}
    if "fault" in told:
        raise ReadError(f"the PDF cannot be read: {told['fault']}", Place(file, 1, 1), _ADVICE)
    return [(page, list(lines)) for page, lines in told["pages"]]
