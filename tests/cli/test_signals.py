"""A signal that comes while a library written in C is being loaded."""

from __future__ import annotations

import subprocess
import sys

PROGRAM = """
import os, signal, sys
from smsl_studio.cli.signals import heard
from smsl_studio.stop import Stopped


class Sender:
    # Whatever the library imports while it is loaded, is told here; it cannot stand an exception.
    loads = sent = False

    def find_spec(self, name, path=None, target=None):
        if self.loads and not self.sent:
            self.sent = True
            os.kill(os.getpid(), signal.SIGINT)
            sum(range(1000))
        self.loads = self.loads or name == "orjson.orjson"


sender = Sender()
for name in ("uuid", "zoneinfo", "dataclasses", "enum", "datetime", "json"):
    sys.modules.pop(name, None)
sys.meta_path.insert(0, sender)
with heard():
    try:
        import orjson
        while True:
            sum(range(1000))
    except Stopped:
        print("stopped", sender.sent, hasattr(sys.modules.get("orjson"), "dumps"))
"""


def test_a_stop_waits_until_a_library_is_loaded() -> None:
    done = subprocess.run(
        [sys.executable, "-c", PROGRAM], capture_output=True, text=True, timeout=60, check=False
    )
    assert (done.returncode, done.stdout) == (0, "stopped True True\n"), done.stderr
