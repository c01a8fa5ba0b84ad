"""The child that reads a PDF from standard input and writes its lines as JSON.

It takes limits from the system first: whatever pypdf does with a hostile file, memory, time and
output are bounded. It opens no file and no connection.
"""

from __future__ import annotations

import io
import json
import logging
import resource
import sys

MEMORY = 1 << 30
"""The address space (bytes) that it may have."""
SECONDS = 20
MOST_PAGES = 2_000
MOST_CHARACTERS = 8_000_000


def main() -> None:
    """Read, and write ``{"pages": [[number, [line]]]}`` or ``{"fault": words}``."""
    resource.setrlimit(resource.RLIMIT_AS, (MEMORY, MEMORY))
    resource.setrlimit(resource.RLIMIT_CPU, (SECONDS, SECONDS))
    resource.setrlimit(resource.RLIMIT_FSIZE, (0, 0))
    logging.disable(logging.CRITICAL)
    sys.stdout.write(json.dumps(_told(sys.stdin.buffer.read())))


def _told(raw: bytes) -> dict[str, object]:
    # Any error of the library is an answer here: the parent tells it with the name of the file.
    try:
        from pypdf import PdfReader

        reader = PdfReader(io.BytesIO(raw))
        if reader.is_encrypted:
            return {"fault": "it is encrypted"}
        pages, characters = [], 0
        for number, page in enumerate(reader.pages, 1):
            text = page.extract_text()
            characters += len(text)
            if number > MOST_PAGES or characters > MOST_CHARACTERS:
                return {"fault": "it has more pages or more text than a procedure needs"}
            pages.append([number, text.splitlines()])
    except MemoryError:
        return {"fault": "it needs more memory than a text does"}
    except Exception as error:
        return {"fault": " ".join(str(error).split())[:200] or type(error).__name__}
    return {"pages": pages}


if __name__ == "__main__":
    main()
