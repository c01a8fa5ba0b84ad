"""Writes bundles of evidence. A bundle can be checked without this program."""

from __future__ import annotations

import io
import os
import unicodedata
from collections.abc import Iterable, Iterator, Mapping, Sequence
from pathlib import PurePath
from zipfile import ZIP_STORED, ZipFile, ZipInfo

from smsl_studio.blueprint.model import Blueprint
from smsl_studio.blueprint.procedures import procedures_of
from smsl_studio.blueprint.reading import read_blueprint
from smsl_studio.blueprint.stored import stored_place
from smsl_studio.errors import UsageError
from smsl_studio.front.bundled_report import REPORT, bundled_report
from smsl_studio.front.signed_files import UNSIGNED, SignedPaths, bytes_of, signed_files
from smsl_studio.front.verifier import content_texts, verifier_file
from smsl_studio.seal.digest import sha256_hex
from smsl_studio.smsl.document import Document
from smsl_studio.smsl.files import save_document

Name = str | os.PathLike[str]
_DAY = (1980, 1, 1, 0, 0, 0)
"""Every file in a bundle has this time, so that equal input gives equal bytes."""
_ODD = {"Cc", "Cf", "Cs", "Zl", "Zp"}
"""Kinds of characters that stand in no name: those for control, halves of characters, ends of
lines. The kinds are those of Unicode."""
_README = """\
This is evidence about runs of a blueprint. It can be checked without the program that wrote it:

    python verify.py

Call it in this folder. It needs Python 3.11, and the package `cryptography` where something is
signed. Exit status 0: the evidence is consistent. 1: it is not, and each line says why.

blueprint/    the files of the blueprint, as they are. The log names the SHA-256 of each.
content/      what their digests are made of, as canonical JSON: a folder for each file. The SHA-256
              of behaviour.json, meaning.json and closure.json are the three digests.
              brought.json has the State Branches of imported files.
logs/         the logs of runs, byte for byte
records/      what people have signed about the blueprint, if anybody has, and about the files on
              which they rely and the blueprints that operations run. Each has the name of its file
policy.toml   whose signatures are needed, with register.json, the register of persons that it names
keys.json     the public halves of keys that have signed records, or the head of a log. They count
              where no register says whose they are
report.html   the blueprint in sentences, for people. It loads nothing. Its day is that of the last
              log, or else of the newest signature. Its SHA-256 is
              {page}
              verify.py checks that the page has not changed since. It does not write it anew, so
              believe the files, not the page.
verify.py     the checks. It is short, and a list in it says what it does not check.

How to read verify.py aloud, from its top to its end. Its short names:

s    the story so far               e    the event that is told
sb   a State Branch                 b    the name of a State Branch
n    the number of a fact in it     key  a fact: b and n
op   an operation that has begun    at   the state in which each State Branch is
a    the address of an operation    no   refuses the evidence if what follows is so, and says why

A Map is a table: m.key is its value, or an empty Map if it has none. e.a is the address of an
event, h the header of a log, p the policy. What the story notes of a step: acts (a function is at
work), bad (a check or an operation has failed), op.code (its function), op.how (its outcome), op.to
(where it leads), op.new (where it leaves every State Branch), moved (the State Branches that have
moved in this step), veto (what somebody does not want just now), bar (what a guard closes), hand
(somebody goes step by step), end (when it is over, because somebody has said so), made (the edges
that a person has let count in this run, with where each leads and its function).

sha, once, read, plain, text, parts, fact and facts read and write texts; text writes an address,
which has one spelling, and raw_of reads base64, which has one too. fits asks whether a value has
the type that TYPES names: else a plural is a list, and all others are texts. content reads the
blueprint from the texts of its digests, branch one State Branch. lines checks the chain and the
head of a log.

How things stand: here says where everything is, with what has been done and is not committed
yet. holds says whether a fact has a value, terms asks all facts of a state: this is a state check.
For one event at most 99,999 sub-SBs are asked, so that no blueprint makes it endless.
lit says whether a fact of a base is on, broken names the sub-SBs that disagree with a base, placed
says where a sub-SB stands at a start. level says who acts. edge is an operation of the blueprint
and what it changes: facts go along with it, and it crosses sub-SBs. due names the
operations whose function has not ended; while there are any, way names the facts that the step is
changing just now. hazards names those that are met, safe refuses one that nobody has told. ops
names the operations of an address that have begun.

The story: tell tells a log again, story is one that has not begun. What a blueprint does that an
operation runs, one level down, is a story of its own, told in the same way. take asks what each
event needs: time goes on only where something takes time, and an effect has its command, at the
same time and of the same person. An event that holds, stops or locates the run ends its step.
WORDS has all commands, each with the event that it owes before anything else: a line if it owes
none, and a question mark if that event may also come without it. The last six have a value. Then
on_EVENT asks what this event needs, and notes what it changes. arrived: nothing goes on, and the
goals that were told still hold. same writes the name of a person in one way, without what nobody
sees. each asks whether every seat has a person of its own who may take it: it has if, of any kinds
k of seats, there are no more than people for them (the theorem of Hall). It refuses more than 16
kinds.

The records: when reads a time. trusted reads the policy, whose numbers must be possible, and whose
keys count, ring names keys by their sums, opened checks a signature. void: a key or a record is
revoked, or not valid at that time. recorder says who has signed the head of a log. judge counts
the last word of each person, in the order of signing, and asks who has met each condition: a run
can only have asked those about its world, a sensor, a supervisor or a day. The others are signed.

The folder: files and load find what is a file and no link, main checks everything. A file that is
absent, or a link, counts as empty. What is checked stands in content/. The files in blueprint/ are
those that the header of a log names by their sums; nothing compares them with content/.
"""


def bundle(
    blueprint: Blueprint,
    output: Name,
    logs: Iterable[Name] = (),
    record: Name | None = None,
    policy: Name | None = None,
) -> None:
    """Write a bundle of evidence: a ``.zip`` that can be checked without this program.

    It has the blueprint, its report, logs of its runs, its record, its policy, and the program
    ``verify.py`` that checks them. If no ``record`` is given, the record beside the blueprint's
    file is used, if there is one. Equal input gives equal bytes. UsageError if ``output`` does not
    end in ``.zip``. ReadError if a log, the record or the policy cannot be read. SaveError if the
    bundle cannot be written.

    >>> bundle(read("hfsm.json"), "evidence.zip", logs=["run.jsonl"])
    """
    paths = [os.fspath(log) for log in logs]
    signed = SignedPaths(*(one if one is None else os.fspath(one) for one in (record, policy)))
    raw = bundled(blueprint, output, paths, signed)
    inputs = [*(one.file for one in blueprint.documents), *paths, *signed.given]
    save_document(raw, output, made_of=inputs)


def bundled(
    blueprint: Blueprint, output: Name, logs: Sequence[str] = (), signed: SignedPaths = UNSIGNED
) -> bytes:
    """Return the bytes that ``bundle`` writes. It raises the same errors, except SaveError."""
    if PurePath(output).suffix.lower() != ".zip":
        raise UsageError(
            f"{os.fspath(output)!r} is no name of a bundle", advice="Let it end in .zip."
        )
    names = _names(blueprint)
    files = dict(_blueprint_files(blueprint, names))
    told = dict(_log_files(logs))
    files.update(told)
    called = {document.file: name for document, name in names.items()}
    files.update(signed_files(blueprint, signed, called, tuple(told.values())))
    records = [raw for name, raw in files.items() if name.startswith("records/")]
    files[REPORT] = bundled_report(blueprint, tuple(told.values()), records)
    files["verify.py"] = verifier_file().read_bytes()
    files["README.txt"] = _README.format(page=sha256_hex(files[REPORT])).encode("ascii")
    return _zipped(files)


def _names(blueprint: Blueprint) -> dict[Document, str]:
    """Return the name in the bundle of each file of a blueprint and of what its operations run.

    The names keep the folders, relative to the common folder of all files.
    """
    procedures = procedures_of(blueprint).parts
    also = [document for part in procedures for document in part.documents]
    listed = dict.fromkeys((*blueprint.documents, *also))
    named = [(_path(document), document) for document in listed]
    paths = [path for path, _ in named if stored_place(path) is None] or [named[0][0]]
    folder = os.path.commonpath([os.path.dirname(path) for path in paths])  # noqa: PTH120
    names: dict[Document, str] = {}
    taken: set[str] = set()
    for path, document in named:
        place = None if path in paths else stored_place(path)
        way = os.path.relpath(path, folder) if place is None else f"store/{place.name[6:]}"
        names[document] = _free(_plain(PurePath(way).as_posix()), taken)
    return names


def _blueprint_files(
    blueprint: Blueprint, names: Mapping[Document, str]
) -> Iterator[tuple[str, bytes]]:
    """Yield the name in the bundle and the content of each file of a blueprint."""
    for document, name in names.items():
        yield f"blueprint/{name}", document.encoded()
        own = document is blueprint.document
        one = blueprint if own else read_blueprint(document, opened=names)
        for part, text in content_texts(one).items():
            yield f"content/{name}/{part}.json", text


def _path(document: Document) -> str:
    """Return the real path of a document. A blueprint from standard input gets a made-up name."""
    is_file = os.path.lexists(document.file)
    return os.path.realpath(document.file if is_file else f"blueprint.{document.form}")


def _plain(name: str) -> str:
    """Return a name that means the same file wherever a zip is unpacked.

    A backslash would be a folder on some systems. Like control characters and what UTF-8 cannot
    write, it becomes a number: ``%5c``.
    """
    return "".join(f"%{ord(char):02x}" if _is_odd(char) else char for char in name)


def _is_odd(char: str) -> bool:
    return char == "\\" or unicodedata.category(char) in _ODD


def _free(name: str, taken: set[str]) -> str:
    """Return a name that no file before has. Two names may become plain in the same way."""
    while name in taken:
        name = f"{name}%"
    taken.add(name)
    return name


def _log_files(logs: Sequence[str]) -> Iterator[tuple[str, bytes]]:
    """Yield each log with a name that no other log has."""
    taken: set[str] = set()
    for log in logs:
        stem, number = _plain(PurePath(log).stem) or "log", 1
        name = f"{stem}.jsonl"
        while name.casefold() in taken:
            number += 1
            name = f"{stem}-{number}.jsonl"
        taken.add(name.casefold())
        yield f"logs/{name}", bytes_of(log, "run log")


def _zipped(files: Mapping[str, bytes]) -> bytes:
    """Return a zip of files. They are not compressed, because compressed bytes differ between
    versions of the library that makes them."""
    whole = io.BytesIO()
    with ZipFile(whole, "w", ZIP_STORED) as archive:
        for name in sorted(files):
            entry = ZipInfo(name, _DAY)
            entry.create_system, entry.external_attr = 3, 0o100644 << 16
            archive.writestr(entry, files[name])
    return whole.getvalue()
