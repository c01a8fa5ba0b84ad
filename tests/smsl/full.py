"""Saves files on a disk without room: ``python -m tests.smsl.full FOLDER LIMIT COUNT``.

LIMIT is the longest file (bytes) that may be written, 0 for none; COUNT is the number of files.
What the person is told is printed as one line of JSON.
"""

from __future__ import annotations

import json
import resource
import sys
from pathlib import Path

from smsl_studio.errors import SaveError
from tests.smsl.killed import save, targets

if __name__ == "__main__":
    folder, limit, count = Path(sys.argv[1]), int(sys.argv[2]), int(sys.argv[3])
    if limit:
        resource.setrlimit(resource.RLIMIT_FSIZE, (limit, limit))
    try:
        save(targets(folder, count), "b")
    except SaveError as error:
        print(json.dumps({"sentence": error.sentence, "advice": error.advice}))
