"""Writes code that carries a blueprint out without Studio, and says whether it still agrees."""

from __future__ import annotations

import os
from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from pathlib import Path

from smsl_studio.blueprint.levels import Levels
from smsl_studio.blueprint.model import Blueprint
from smsl_studio.errors import Place, SaveError, UsageError
from smsl_studio.front.acceptance import CLEAN, left_out, to_accept
from smsl_studio.front.inputs import refuse_nonsense
from smsl_studio.front.version import version
from smsl_studio.generate.code.blueprint_parts import CodeRequest, refuse_what_is_not_generated
from smsl_studio.generate.code.cpp_package import CppPackage
from smsl_studio.generate.code.driver_files import LANGUAGES, driver_files
from smsl_studio.generate.code.identifiers import is_package_name, package_name
from smsl_studio.generate.code.kept_parts import parts_of, refuse_lost, with_parts
from smsl_studio.generate.code.python_package import PythonPackage
from smsl_studio.generate.code.ros2_package import Ros2Package
from smsl_studio.generate.code.templates import BY
from smsl_studio.library.bindings_file import read_bindings
from smsl_studio.smsl.inputs import read_ordinary
from smsl_studio.smsl.outputs import replace_file

Name = str | os.PathLike[str]
Package = CppPackage | PythonPackage
TARGETS: dict[str, type[Package]] = {
    "python": PythonPackage,
    "cpp": CppPackage,
    "ros2": Ros2Package,
}
LARGEST = 1 << 24
"""The largest size of a licence, a record, or a generated file that is read again, in bytes."""


@dataclass(frozen=True)
class GeneratedCode:
    """What was written, or what would be: the folder, and the files of each kind by their paths.

    ``kept`` are parts between marks that people have written.
    """

    folder: Path
    files: tuple[str, ...]
    changed: tuple[str, ...]
    gone: tuple[str, ...]
    kept: tuple[str, ...]

    @property
    def agrees(self) -> bool:
        """Whether code and blueprint agree: nothing has to be written."""
        return not (self.changed or self.gone)


def generate_code(
    blueprint: Blueprint,
    folder: Name,
    *,
    target: str = "python",
    name: str = "",
    bindings: Name | None = None,
    record: Name | None = None,
    licence: Name | None = None,
    check: bool = False,
) -> GeneratedCode:
    """Write the package of a blueprint into a folder. With ``check`` write nothing.

    ``target`` is the language, ``name`` the name of the package, by default that of the file.
    ``bindings`` is a bindings file, ``record`` an inspection record, ``licence`` a text for the top
    of every file. Parts between marks stay. RunRefused for what is not generated. UsageError, with
    file and line, for a part that has no place any more, and for a file that somebody else has
    written.

    >>> made = generate_code(read("hanoi-2.json"), "made")
    >>> generate_code(read("hanoi-2.json"), "made", check=True).agrees
    True
    """
    package = name or package_name(Path(blueprint.file).stem)
    if not is_package_name(package):
        raise UsageError(f"{package!r} is no name of a package", advice="Use letters, digits, _.")
    if target not in TARGETS:
        raise UsageError(
            f"there is no target {target!r}", advice=f"Choose one of {', '.join(TARGETS)}."
        )
    refuse_nonsense(blueprint, "Mend what this finding says, then generate it again.")
    refuse_what_is_not_generated(blueprint)
    found = to_accept(blueprint, Levels(blueprint, {"inspection": "human"}))
    request = CodeRequest(
        blueprint,
        package,
        version(),
        licence="" if licence is None else _text(licence),
        record=b"" if record is None else _raw(record),
        findings="" if found == CLEAN else f"Inspection found {len(found.splitlines())} findings.",
        left_out=left_out(blueprint),
    )
    file = None if bindings is None else read_bindings(Path(bindings))
    return _written(Path(folder), package, TARGETS[target](request, file), check)


def generate_driver(folder: Name, *, target: str = "python") -> GeneratedCode:
    """Write a driver for the world ``remote`` into a folder: a program of one file, with a README
    and a blueprint to try it.

    ``target`` is the language, python or cpp. UsageError for another one, and for a file there that
    somebody has written or changed.

    >>> generate_driver("made-driver").changed
    ('driver.py', 'lamp.json', 'README.md')
    """
    if target not in LANGUAGES:
        raise UsageError(
            f"no driver is written in {target!r}", advice=f"Choose one of {', '.join(LANGUAGES)}."
        )
    files, place = driver_files(target), Path(folder)
    changed = {}
    for name, text in files.items():
        old = _text(place / name) if os.path.lexists(place / name) else None
        if old not in (None, text):
            raise UsageError(
                f"{Place(str(place / name), 1, 1)}: this file would be replaced, and what you have "
                "written in it lost",
                advice="Choose another folder.",
            )
        if old is None:
            changed[name] = text
    _save(place, changed, [])
    return GeneratedCode(place, tuple(files), tuple(changed), (), ())


def _written(folder: Path, package: str, made: Package, check: bool) -> GeneratedCode:
    """Weave in what people have written, and write the files that differ."""
    files = made.files
    woven: dict[str, str] = {}
    changed: list[str] = []
    kept: list[str] = []
    for path, text in files.items():
        old = _old(folder / path)
        woven[path] = text
        if old is not None and "<yours: " in text:
            shown = str(folder / path)
            own, new = parts_of(old, shown), parts_of(text, shown)
            refuse_lost(own, new, shown)
            kept += [
                key for key, part in own.items() if key in new and part.lines != new[key].lines
            ]
            woven[path] = with_parts(text, own)
        if old != woven[path]:
            changed.append(path)
    gone = list(_gone(folder, package, files, made.suffixes))
    if not check:
        _save(folder, {path: woven[path] for path in changed}, gone)
    return GeneratedCode(folder, tuple(files), tuple(changed), tuple(gone), tuple(kept))


def _old(path: Path) -> str | None:
    """Return the text of a file that was generated before, None if there is none. UsageError if
    somebody else has written it.
    """
    if not os.path.lexists(path):
        return None
    text = _text(path)
    if text and BY not in text:
        raise UsageError(
            f"{Place(str(path), 1, 1)}: this file was not generated, and would be replaced",
            advice="Move it, or choose another folder.",
        )
    return text


def _gone(
    folder: Path, package: str, files: Mapping[str, str], suffixes: tuple[str, ...]
) -> Iterator[str]:
    """Yield the generated files of State Branches and of the engine that are no more."""
    for below in ("branches", "dsfo"):
        for one in sorted((folder / package / below).glob("*.*")):
            path = one.relative_to(folder).as_posix()
            if path not in files and one.suffix in suffixes and _old(one) is not None:
                yield path


def _save(folder: Path, files: Mapping[str, str], gone: list[str]) -> None:
    try:
        for path, text in files.items():
            target = folder / path
            target.parent.mkdir(parents=True, exist_ok=True)
            replace_file(target, text.encode("utf-8"), None, str(target))
        for path in gone:
            (folder / path).unlink()
    except OSError as error:
        raise SaveError(
            f"{folder} cannot be written: {error.strerror or error}",
            Place(str(folder), 1, 1),
            "Choose another folder, or make room in it.",
        ) from None


def _text(path: Name) -> str:
    try:
        return _raw(path).decode("utf-8")
    except UnicodeDecodeError:
        raise UsageError(f"{os.fspath(path)}:1:1: this text is not UTF-8") from None


def _raw(path: Name) -> bytes:
    try:
        return read_ordinary(Path(path), LARGEST).raw
    except (OSError, ValueError) as error:
        words = getattr(error, "strerror", None) or error
        raise UsageError(f"{os.fspath(path)}:1:1: cannot be read: {words}") from None
