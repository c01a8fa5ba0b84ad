"""A process that runs generated code is shut in: the kernel refuses it files, connections, and
processes, and what a library loads late still comes."""

from __future__ import annotations

import json
import subprocess
import sys
from pathlib import Path

CODE = """
import json, os, socket, subprocess, sys, threading
from smsl_studio.host.confinement import landlock_version
from smsl_studio.host.shut_in import shut_in

bait, ctypes = sys.argv[1], __import__("ctypes")
files = landlock_version(ctypes.CDLL(None)) >= 3
done = [shut_in(), shut_in()]
heard = []
tries = {
    "read": lambda: open(bait).read(),
    "write": lambda: open(bait + ".new", "w"),
    "empty": lambda: os.truncate(bait, 0),
    "unlink": lambda: os.unlink(bait),
    "rename": lambda: os.rename(bait, bait + ".old"),
    "link": lambda: os.symlink("/etc", bait + ".link"),
    "list": lambda: os.listdir(os.path.dirname(bait)),
    "socket": lambda: socket.socket(),
    "pair": lambda: socket.socketpair(),
    "process": lambda: subprocess.Popen(["true"]),
    "fork": lambda: os.fork(),
    "exec": lambda: os.execv("/bin/true", ["true"]),
    "thread": lambda: threading.Thread(target=heard.append, args=(1,)).start(),
    "late": lambda: __import__("colorsys"),
}
told = {}
for name, what in tries.items():
    try:
        what()
        told[name] = "done"
    except OSError as error:
        told[name] = type(error).__name__
print(json.dumps([done, files, told]))
"""


def test_a_process_is_shut_in(tmp_path: Path) -> None:
    bait = tmp_path / "bait"
    bait.write_text("kept")
    words = [sys.executable, "-c", CODE, str(bait)]
    ran = subprocess.run(words, capture_output=True, timeout=60, check=True)
    done, files, told = json.loads(ran.stdout)
    assert done == [True, True]
    assert (told.pop("thread"), told.pop("late")) == ("done", "done")
    of_files = {name: told.pop(name) for name in ("read", "write", "list")}
    assert set(told.values()) == {"PermissionError"}, told
    assert not files or set(of_files.values()) == {"PermissionError"}
    assert bait.read_text() == "kept"
