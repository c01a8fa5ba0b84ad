"""A table of a hundred hostile plugins as small source texts.

Each entry tells when the plugin does its harm, and the words by which its one error is known. Each
plugin leaves a mark wherever its code runs: the number of the process.
"""

from __future__ import annotations

from pathlib import Path
from textwrap import indent

from tests.plugin_folder import write_plugin

MARKING = '''
import os
def mark(*_, **__):
    with open({marks!r}, "a") as file:
        file.write(f"{{os.getpid()}}\\n")
mark()

class Evil:
    """A value that does something whatever is done with it."""
    def __reduce_ex__(self, protocol): mark(); return (os.system, ("echo $PPID >> {marks}",))
    def __eq__(self, other): mark(); return True
    def __lt__(self, other): mark(); return False
    __gt__ = __ge__ = __le__ = __contains__ = __eq__
    def __hash__(self): mark(); return 1
    def __float__(self): mark(); return 1.0
    def __index__(self): mark(); return 1
    def __str__(self): mark(); return "evil"
    __repr__ = __format__ = __fspath__ = __str__
    def __bool__(self): mark(); return True
    def __len__(self): mark(); return 1
    def __iter__(self): mark(); return iter(("a",))
    def __getitem__(self, key): mark(); return "a"
    def __del__(self): mark()
class EvilText(str):
    def __reduce_ex__(self, protocol): mark(); return (os.system, ("echo $PPID >> {marks}",))
class EvilNumber(float):
    def __reduce_ex__(self, protocol): mark(); return (os.system, ("echo $PPID >> {marks}",))
def pipes():
    import stat
    for file in range(3, 99):
        try:
            mode = os.fstat(file).st_mode
        except OSError:
            continue
        if stat.S_ISFIFO(mode) or stat.S_ISSOCK(mode):
            yield file
def sockets():
    import stat
    return [file for file in pipes() if stat.S_ISSOCK(os.fstat(file).st_mode)]
def tell(data):
    for file in pipes():
        try:
            os.write(file, data)
        except OSError:
            pass
parent = os.getppid()
'''

WORLD = """
{top}
def register(library):
    mark()
    @library.world({world!r}, engine="table", settle=0.1)
    def build(world, blueprint, seed):
{build}
    @library.arrange({world!r})
    def arrange(world, facts):
{arrange}
        world.set_facts(facts)
    @library.sensor("bulb_{{n}}", fact="{{n}}", period=0.05)
    def bulb(world, n: int):
{sense}
        return world.fact("LAMP", n - 1)
    @library.operation("Op_{{to}}", timeout=1.0)
    def switch(world, to: str):
        yield
{act}
        yield
        world.set_facts({{("LAMP", 0): "1"}})
    @library.cost("Op_{{to}}")
    def price(state, scene, history, to: str):
{price}
        return 1.0
    @library.fault({world!r}, "dark")
    def dark(world):
{fault}
        yield
"""

FORGED = "import struct; tell(struct.pack('!I', {size}) + {data}); import time; time.sleep(60)"
OFFER = "def register(library):\n    mark()\n    {}\n"
OPERATION = OFFER.format("@library.operation({})\n    def go(world):\n        yield")
SENSOR = OFFER.format("@library.sensor({})\n    def see(world):\n        return '1'")
BUILD = OFFER.format("@library.world({})\n    def build(world, blueprint, seed):\n        mark()")

IMPORTED: dict[str, tuple[str, str]] = {
    # It ends its process.
    "exits": ("os._exit(3)", "ended by itself with exit status 3"),
    "says_exit": ("raise SystemExit(2)", "SystemExit: 2"),
    "aborts": ("os.abort()", "SIGABRT"),
    "faults": ("import ctypes; ctypes.string_at(0)", "SIGSEGV"),
    "kills_itself": ("os.kill(os.getpid(), 9)", "SIGKILL"),
    "alarms": ("import signal, time; signal.alarm(1); time.sleep(60)", "SIGALRM"),
    "stops_itself": ("os.kill(os.getpid(), 19)", "did not load within"),
    "becomes_another": ("os.execv('/bin/true', ['true'])", "ended by itself with exit status 0"),
    "becomes_a_sleeper": ("os.execv('/bin/sleep', ['sleep', '60'])", "closed the pipe"),
    "interrupts": ("raise KeyboardInterrupt", "KeyboardInterrupt"),
    "exits_at_exit": (
        "import atexit; atexit.register(os._exit, 9); raise OSError('no')",
        "OSError: no",
    ),
    # It goes on for ever.
    "spins": ("while True: pass", "did not load within"),
    "sleeps": ("import time; time.sleep(60)", "did not load within"),
    "holds_the_interpreter": (
        "import re; re.match('(a+)+$', 'a' * 60 + 'b')",
        "did not load within",
    ),
    "recurses": ("def down(): down()\ndown()", "RecursionError"),
    "recurses_deeper": (
        "import sys; sys.setrecursionlimit(10**9)\nclass A:\n"
        "    def __repr__(self): return repr(self)\nrepr(A())",
        "SIGSEGV|MemoryError",
    ),
    "joins_its_threads": (
        "import threading, time\nfor _ in range(20):\n"
        "    last = threading.Thread(target=time.sleep, args=(600,)); last.start()\nlast.join()",
        "did not load within",
    ),
    # Threads and processes.
    "exits_in_a_thread": (
        "import threading, time; threading.Timer(0.1, os._exit, (7,)).start(); time.sleep(60)",
        "exit status 7",
    ),
    "leaves_a_copy": (
        "import time\nif os.fork() == 0:\n    mark(); time.sleep(600)\nos._exit(4)",
        "exit status 4",
    ),
    "forks_and_forks": (
        "import time\nfor _ in range(5):\n    os.fork()\nmark()\ntime.sleep(60)",
        "did not load within",
    ),
    "starts_a_shell": (
        "import subprocess; subprocess.run(['sh', '-c', 'sleep 600 & exit 5'], check=True)",
        "exit status 5",
    ),
    # Memory, files, output.
    "takes_all_memory": ("bytearray(2**46)", "MemoryError"),
    "takes_memory_piece_by_piece": (
        "import mmap; held = [mmap.mmap(-1, 2**30) for _ in range(10**4)]",
        "Cannot allocate memory",
    ),
    "opens_every_file": ("held = [open('/dev/null') for _ in range(10**5)]", "Too many open files"),
    "prints_for_ever": ("while True: print('flood ' * 1000)", "did not load within"),
    "writes_for_ever": ("while True: os.write(2, b'flood ' * 10000)", "did not load within"),
    "steers_the_terminal": (
        "os.write(1, b'\\x1b[2J\\x1b]0;x\\x07\\xc2\\x9b'); raise OSError('steers')",
        "steers",
    ),
    "closes_every_file": ("os.closerange(0, 300)", "exit status 0|closed the pipe"),
    "reads_the_keyboard": ("input()", "EOFError"),
    # Signals, and what else reaches another process.
    "ends_its_parent": ("os.kill(parent, 15)", "Operation not permitted"),
    "kills_its_parent": ("os.kill(parent, 9)", "Operation not permitted"),
    "stops_its_parent": ("os.kill(parent, 19)", "Operation not permitted"),
    "kills_the_program": ("os.kill({program}, 9)", "Operation not permitted"),
    "kills_its_group": ("os.killpg(os.getpgid({program}), 15)", "Operation not permitted"),
    "kills_everybody": ("os.kill(-1, 15)", "Operation not permitted"),
    "kills_by_shell": (
        "import subprocess; subprocess.run(['sh', '-c', 'kill -9 {program}'], check=True)",
        "exit status",
    ),
    "kills_by_handle": ("os.pidfd_open({program})", "Operation not permitted"),
    "kills_by_owner": (
        "import fcntl; fcntl.fcntl(next(pipes()), fcntl.F_SETOWN, {program})",
        "Operation not permitted",
    ),
    "limits_the_program": (
        "import resource; resource.prlimit({program}, resource.RLIMIT_CPU, (1, 1))",
        "Operation not permitted",
    ),
    "writes_our_output": ("open('/proc/{program}/fd/2', 'w').write('pwned')", "Permission denied"),
    "writes_its_parents_output": (
        "open(f'/proc/{parent}/fd/2', 'w').write('pwned')",
        "Permission denied",
    ),
    "opens_our_memory": ("open('/proc/{program}/mem', 'r+b')", "Permission denied"),
    "leaves_its_session": ("os.setsid()", "Operation not permitted"),
    "leaves_its_group": ("os.setpgid(0, os.getpgid(parent))", "Operation not permitted"),
    "leaves_a_daemon": (
        "import subprocess; subprocess.Popen(['sleep', '600'], start_new_session=True)",
        "Operation not permitted",
    ),
    # Answers that it forges.
    "tells_a_pickle": (
        FORGED.format(size=31, data=r"b'cos\nsystem\n(Vecho pwned\ntR.    '"),
        "its description is not valid",
    ),
    "tells_garbage": (FORGED.format(size=64, data="b'\\1' * 64"), "description is not valid"),
    "tells_nothing": (FORGED.format(size=0, data="b''"), "description is not valid"),
    "tells_neither": (FORGED.format(size=2, data="b'\\0\\0'"), "neither what it is nor"),
    "tells_too_much": (FORGED.format(size=2**31, data="b''"), "2147483648 bytes, more than"),
    "tells_without_end": (
        "import time\nfor _ in range(9**9):\n    tell(b'\\0'); time.sleep(0.01)",
        "did not load within|description is not valid",
    ),
    "stops_in_the_middle": ("tell(b'\\0\\0'); import time; time.sleep(60)", "did not load within"),
    # It changes the program's own code, in its own process.
    "changes_the_codec": (
        "from smsl_studio.host import description\n"
        "class Codec:\n    def encode(self, said): mark(); return b'cos\\nsystem\\n(Vecho\\ntR.'\n"
        "description.DESCRIPTION = Codec()",
        "description is not valid",
    ),
    "changes_the_builtins": (
        "import builtins; builtins.isinstance = None",
        "cannot be described|exit status",
    ),
    "traces": ("import sys; sys.settrace(lambda *_: os._exit(6))\n(lambda: 0)()", "exit status 6"),
    "profiles": ("import sys; sys.setprofile(lambda *_: os._exit(8))", "exit status 8"),
    "has_attributes_that_exit": (
        "def __getattr__(name):\n    raise SystemExit(name)",
        "SystemExit: register",
    ),
    # Errors that cannot be told.
    "says_nothing": (
        "class Mute(Exception):\n    def __str__(self): raise OSError\nraise Mute",
        "Mute: it cannot say what",
    ),
    "says_too_much": ("raise ValueError('x' * 10**7)", r"x \.\.\. \(10000012 characters\)"),
    "says_surrogates": ("raise ValueError('\\ud800')", r"ValueError: \?"),
    # It is no plugin.
    "registers_a_number": ("register = 5", "it has no function register"),
    "is_deeper_than_python": ("x = " + "(" * 300 + ")" * 300, "too many nested parentheses"),
    "has_a_hole": ("x = '\\\0'", "null bytes"),
}
"""What happens when it is loaded: its code, and its one error."""

REGISTERED: dict[str, tuple[str, str]] = {
    "timeout_runs": (OPERATION.format("'Go', timeout=Evil()"), "timeout is of type 'Evil'"),
    "timeout_calls_a_shell": (
        "import types, smsl_studio.host.wire as wire\n"
        "class Call:\n    __name__ = 'os.system'\n    def __call__(self, *_): pass\n"
        "    def __reduce_ex__(self, protocol): return 'os.system'\n"
        "call = Call(); call.__qualname__ = 'os.system'; call.__module__ = wire.__name__\n"
        "wire.os = types.SimpleNamespace(system=call)\n"
        "class Sly(Evil):\n"
        "    def __reduce_ex__(self, protocol): return (call, ('echo $PPID >> {marks}',))\n"
        + OPERATION.format("'Go', timeout=Sly()"),
        "timeout is of type 'Sly'",
    ),
    "timeout_is_nan": (OPERATION.format("'Go', timeout=float('nan')"), "timeout is nan"),
    "timeout_is_before": (OPERATION.format("'Go', timeout=-1"), "timeout is -1.0"),
    "resumes_runs": (OPERATION.format("'Go', resumes=Evil()"), "resumes is of type 'Evil'"),
    "stop_runs": (OPERATION.format("'Go', stop=Evil()"), "stop is evil"),
    "touches_runs": (OPERATION.format("'Go', touches=[EvilText('1')]"), "type 'EvilText'"),
    "period_runs": (SENSOR.format("'see', period=Evil()"), "period is of type 'Evil'"),
    "words_run": (SENSOR.format("'see', words={'1': Evil()}"), "words does not map texts"),
    "settle_runs": (BUILD.format("'w', 'table', False, Evil()"), "settle is of type 'Evil'"),
    "hardware_runs": (BUILD.format("'w', 'table', Evil()"), "hardware is of type 'Evil'"),
    "name_runs": (BUILD.format("EvilText('w')"), "type 'EvilText'"),
    "name_steers": (BUILD.format("'w\\x1b[2J'"), r"the character U\+001B"),
    "name_turns_round": (BUILD.format("'w\\u202egnp.exe'"), r"the character U\+202E"),
    "name_has_lines": (SENSOR.format("'a\\nb'"), r"the character U\+000A"),
    "name_is_no_text": (SENSOR.format("'\\ud800'"), r"the character U\+D800"),
    "name_is_huge": (OPERATION.format("'x' * 10**7"), "has 10000000 characters"),
    "name_is_taken": (BUILD.format("'table'"), "it is taken"),
    "pattern_explodes": (
        OPERATION.format("''.join('{a%d}' % n for n in range(60)) + '!'"),
        "more than 16 parameters",
    ),
    "function_has_no_name": (
        "def go(world):\n    yield\ngo.__name__ = 'x\\x1b'\n"
        + OFFER.format("library.operation('Go')(go)"),
        r"the character U\+001B",
    ),
    "annotation_exits": (
        OFFER.format(
            "@library.operation('Go')\n    def go(world, n: 'os._exit(5)' = 1):\n        yield"
        ),
        "exit status 5",
    ),
    "signature_exits": (
        "class Go:\n    __name__ = 'go'\n    @property\n    def __signature__(self): os._exit(6)\n"
        "    def __call__(self, world): return '1'\n" + OFFER.format("library.sensor('s')(Go())"),
        "exit status 6",
    ),
    "library_is_broken": (OFFER.format("library.worlds = 5"), "cannot be described"),
    "library_is_endless": (
        "import itertools\nclass Many(dict):\n    def values(self): return itertools.count()\n"
        + OFFER.format("library.worlds = Many()"),
        "did not load within|cannot be described",
    ),
    "library_is_evil": (OFFER.format("library.operations.append(Evil())"), "cannot be described"),
    "library_is_too_much": (
        "def go(world):\n    yield\n"
        + OFFER.format("for n in range(1001): library.operation(f'Go{n}')(go)"),
        "has 1001 entries, more than 1000",
    ),
    "describes_in_a_thread": (
        "import threading, time\n"
        + OFFER.format("threading.Thread(target=os._exit, args=(9,)).start(); time.sleep(60)"),
        "exit status 9",
    ),
}
"""What happens when it registers."""

RUNNING: dict[str, tuple[str, str, str]] = {
    "built_exit": ("build", "os._exit(3)", "exit status 3"),
    "built_hang": ("build", "while True: pass", "did not answer for"),
    "arranged_badly": ("arrange", "raise SystemExit(4)", "SystemExit: 4"),
    "killed": ("act", "os.kill(os.getpid(), 9)", r"killed by signal 9 \(SIGKILL\)"),
    "kills_parent": ("act", "os.kill(parent, 9)", "Operation not permitted"),
    "kills_group": ("act", "os.killpg(os.getpgid(parent), 9)", "Operation not permitted"),
    "writes_output": ("act", "open(f'/proc/{parent}/fd/2', 'w')", "Permission denied"),
    "opens_memory": ("act", "open(f'/proc/{parent}/mem', 'r+b')", "Permission denied"),
    "thread_exits": (
        "act",
        "import threading, time; threading.Timer(0, os._exit, (5,)).start(); time.sleep(60)",
        "exit status 5",
    ),
    "traced": (
        "act",
        "import sys; sys.settrace(lambda *_: os._exit(6)); (lambda: 0)()",
        "status 6",
    ),
    "memory": ("act", "held = bytearray(2**46)", "MemoryError"),
    "output": ("act", "while True: os.write(1, b'flood ' * 10**5)", "did not answer for"),
    "files": (
        "act",
        "import resource as r; most = r.getrlimit(r.RLIMIT_NOFILE)[1]\n"
        "r.setrlimit(r.RLIMIT_NOFILE, (most, most)); [os.dup(1) for _ in range(2000)]",
        "Too many open files",
    ),
    "closed": (
        "act",
        "os.closerange(0, 300); import time; time.sleep(60)",
        "was killed by signal 9",
    ),
    "garbage": ("act", "tell(b'garbage ' * 9)", "said what is no answer"),
    "huge": ("act", "tell(b'\\x7f' * 4)", "said what is no answer"),
    "forged_number": ("act", "import struct; tell(struct.pack('!IIB', 0, 99, 0))", "no answer"),
    "forged_kind": ("act", "import struct; tell(struct.pack('!IIB', 0, 5, 9))", "of kind 9"),
    "forged_empty": (
        "act",
        "import struct; [tell(struct.pack('!IIB', 0, n, 0)) for n in range(9)]",
        "said what is no answer",
    ),
    "forged_pickle": (
        "act",
        "import struct, pickle; data = pickle.dumps(('ok', 5));"
        " [tell(struct.pack('!IIB', len(data), n, 0) + data) for n in range(9)]",
        "said what is no answer",
    ),
    "trickles": (
        "act",
        "import struct, time; tell(struct.pack('!II', 100, 5) + b'\\0')\n"
        "for _ in range(9**9): tell(b'\\0'); time.sleep(0.01)",
        "said what is no answer|did not answer for",
    ),
    "turns_back": (
        "build",
        "from smsl_studio.host.local import LocalHost as Host; tick = Host.tick\n"
        "Host.tick = lambda host: tick(host)._replace(time=0.0)",
        "told a wrong time",
    ),
    "is_another_world": (
        "build",
        "from dataclasses import replace\nfrom smsl_studio.host.local import LocalHost as Host\n"
        "opened = Host.open\n"
        "Host.open = lambda host, start: replace(opened(host, start), world='x')",
        "opened the world 'x'",
    ),
    "draws_nothing": (
        "build",
        "from smsl_studio.world.protocol import Shape\n"
        "from smsl_studio.host.local import LocalHost as Host\n"
        "world.shapes = lambda: (Shape('s', (0.0,) * 9, (1.0, 1.0, 1.0)),)\n"
        "Host.poses = lambda host: (float('nan'),) * 7",
        r"cannot be passed on \(open\).* not a number from",
    ),
    "draws_too_little": (
        "build",
        "from smsl_studio.world.protocol import Shape\n"
        "world.shapes = lambda: (Shape('s', (0.0,) * 9, (1.0, 1.0, 1.0)),)\n"
        "world.poses = lambda: ()",
        "draws 1 shapes with 0 numbers",
    ),
    "senses_too_much": (
        "top",
        "from smsl_studio.host.local import LocalHost as Host; sense = Host.sense\n"
        "Host.sense = lambda host: sense(host) * 20_000",
        "has 20000 entries, more than",
    ),
    "senses_strangers": (
        "top",
        "from smsl_studio.host.local import LocalHost as Host; sense = Host.sense\n"
        "Host.sense = lambda host: tuple(one._replace(branch='OTHER') for one in sense(host))",
        "which is none of 1",
    ),
    "breaks_the_pipe": (
        "act",
        "import socket; [socket.socket(fileno=os.dup(f)).shutdown(2) for f in sockets()]\n"
        "import time; time.sleep(60)",
        "killed by signal 9",
    ),
    "sense_runs": ("sense", "return Evil()", "which is no text"),
    "price_runs": ("price", "return Evil()", "is no number from 0 to 1e12"),
    "price_exits": ("price", "os._exit(7)", "exit status 7"),
    "closes_badly": ("act", "try:\n    yield\nfinally:\n    os._exit(8)", "exit status 8"),
}
"""What happens in a run: in which function, what it does there, and the words that the run says."""


def write_hostile(folder: Path, marks: Path, program: int) -> dict[str, str]:
    """Write every plugin that is hostile when it is looked at; the words each is known by."""
    head = MARKING.format(marks=str(marks))
    words = {}
    for name, (code, told) in {**IMPORTED, **REGISTERED}.items():
        there = code.replace("{program}", str(program)).replace("{marks}", str(marks))
        write_plugin(folder, name, head + there)
        words[name] = told
    return words


def write_running(folder: Path, marks: Path, name: str) -> None:
    """Write a plugin with the world ``name``, which is hostile in a run."""
    place, code, _ = RUNNING[name]
    head = MARKING.format(marks=str(marks))
    parts = dict.fromkeys(("build", "arrange", "sense", "act", "price", "fault"), "pass")
    body = {part: indent(text, 8 * " ") for part, text in {**parts, place: code}.items()}
    top = code if place == "top" else ""
    write_plugin(folder, name, head + WORLD.format(**{**body, "world": name, "top": top}))
