"""The library function to which an operation is bound, and its typed arguments."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import TYPE_CHECKING, Any

from PySide6.QtWidgets import QVBoxLayout, QWidget

from smsl_studio.blueprint.annotations import Binding
from smsl_studio.blueprint.model import StateBranch
from smsl_studio.errors import PluginError
from smsl_studio.library.loaded import Loaded
from smsl_studio.studio.base.controls import Combo, Field
from smsl_studio.studio.base.lines.line import VARIOUS, FormLine, ShownValue, same
from smsl_studio.studio.base.lines.text import number_text
from smsl_studio.studio.base.words import capital

if TYPE_CHECKING:
    from smsl_studio.library.operation_entry import OperationEntry

KINDS: Mapping[object, tuple[str, str]] = {
    int: ("whole number", "a whole number such as 2"),
    float: ("number", "a number such as 2.5"),
    bool: ("true or false", "true or false"),
    str: ("text", "a text"),
}


class BindingLine(FormLine):
    """A choice among the functions of the loaded plugins; ``given`` carries the whole binding."""

    def __init__(self, words: str, tip: str) -> None:
        self.field: Combo = Combo()
        super().__init__(words, self.field, tip)
        self._loaded = Loaded()
        self._functions: dict[str, OperationEntry] = {}
        self._names: list[str | None] = []
        self._shown: tuple[ShownValue, ...] = ()
        self.operation = ""
        self.branch: StateBranch | None = None
        """The SB of the operation; None if the operations stand in several."""
        self.arguments: dict[str, ArgumentLine] = {}
        self._below = QWidget()
        self._column = QVBoxLayout(self._below)
        self._column.setContentsMargins(0, 4, 0, 0)
        self._column.setSpacing(6)
        column = self.layout()
        assert column is not None
        column.addWidget(self._below)
        self.field.activated.connect(self._chosen)

    def set_plugins(self, loaded: Loaded) -> None:
        """Set the functions that can be chosen."""
        self._loaded = loaded
        self._functions = {
            entry.name: entry for plugin in loaded.plugins for entry in plugin.library.operations
        }
        self.show_values(self._shown)

    def show_values(self, shown: Sequence[ShownValue]) -> None:
        """Show the bound function and its arguments, or that the entries differ."""
        super().show_values(shown)
        self._shown = tuple(shown)
        written = shown[0].written if shown and same(list(shown)) else None
        various = not same([one.value for one in shown])
        names: list[str | None] = [None, *sorted(self._functions)]
        if written is not None and written.function not in self._functions:
            names.append(written.function)
        self._names = names
        self.field.clear()
        self.field.addItem(VARIOUS if various else self._standard_words())
        for name in names[1:]:
            assert name is not None
            lost = "" if name in self._functions else " (not loaded)"
            self.field.addItem(f"{name}{lost}")
        self.field.setCurrentIndex(names.index(written.function) if written else 0)
        self._show_arguments(written)

    def said(self, value: Any) -> str:
        """The name of the function, for the history."""
        if isinstance(value, Binding):
            return value.function
        return str(value["function"])

    def _standard_words(self) -> str:
        inherited = self._shown[0].standard if self._shown else None
        if inherited is not None:
            return f"{inherited.function} ({self._shown[0].origin})"
        name = ""
        if self.operation and self.branch is not None:
            # Imported here, because a new window has no operation to bind and needs none of it.
            from smsl_studio.library.by_name import function_by_name

            name = function_by_name(self._loaded, self.branch, self.operation)
        if name:
            return f"By its name: {name}"
        return "Not bound" if self._functions else "No function is loaded"

    def _show_arguments(self, written: Binding | None) -> None:
        for line in self.arguments.values():
            self._column.removeWidget(line)
            line.hide()
            line.deleteLater()
        self.arguments = {}
        self._below.setVisible(written is not None)
        if written is None:
            return
        entry = self._functions.get(written.function)
        types = dict(entry.signature.types) if entry else {}
        for name in dict.fromkeys([*types, *written.arguments]):
            needed = entry is not None and name in entry.signature.required
            line = ArgumentLine(name, types.get(name, str), needed)
            line.show_argument(written.arguments.get(name))
            line.given.connect(lambda value, name=name: self._argue(name, value))
            self.arguments[name] = line
            self._column.addWidget(line)
        if entry is not None:
            self.say(_missing(entry, written.arguments))

    def _chosen(self, at: int) -> None:
        name = self._names[at]
        if name is None:
            self.given.emit(None)
            return
        entry = self._functions.get(name)
        self.given.emit(_written(name, _from_name(entry, self.operation)))

    def _argue(self, name: str, value: Any) -> None:
        binding: Binding = self._shown[0].written
        arguments = {k: v for k, v in binding.arguments.items() if k != name}
        if value is not None:
            arguments[name] = value
        self.given.emit(_written(binding.function, arguments))


class ArgumentLine(FormLine):
    """One argument of a function. The field shows which type it takes."""

    def __init__(self, name: str, kind: object, needed: bool) -> None:
        self.field: Field = Field()
        words, asked = KINDS.get(kind, ("any value", "a value"))
        super().__init__(name, self.field, f"Argument {name}: {asked}")
        self._kind, self._asked = kind, asked
        self.field.set_suffix(words)
        self.field.setPlaceholderText("needed" if needed else "")
        self.field.editingFinished.connect(self._typed)

    def show_argument(self, value: Any) -> None:
        """Show the value of the argument as a user would type it."""
        self.field.settle(_argument_text(value))

    def _typed(self) -> None:
        if not self.field.changed:
            return
        text = self.field.text().strip()
        try:
            self.given.emit(_argument(text, self._kind) if text else None)
        except ValueError:
            self.refuse(f"“{text[:40]}” does not fit. Write {self._asked}.")


def _argument(text: str, kind: object) -> Any:
    if kind is bool:
        if text.casefold() not in ("true", "false"):
            raise ValueError
        return text.casefold() == "true"
    if kind is int:
        return int(text)
    if kind is float:
        return float(text.replace(",", "."))
    return text


def _argument_text(value: Any) -> str:
    if isinstance(value, bool):
        return "true" if value else "false"
    if isinstance(value, int | float):
        return number_text(value)
    return "" if value is None else str(value)


def _written(function: str, arguments: Mapping[str, Any]) -> dict[str, Any]:
    return {"function": function, **({"arguments": dict(arguments)} if arguments else {})}


def _from_name(entry: OperationEntry | None, operation: str) -> dict[str, Any]:
    """The arguments that follow from the operation's name, as a start for a binding by hand."""
    texts = entry.pattern.match(operation) if entry and entry.pattern and operation else None
    if entry is None or texts is None:
        return {}
    try:
        return entry.signature.converted(texts)
    except PluginError:
        return {}


def _missing(entry: OperationEntry, arguments: Mapping[str, Any]) -> str:
    """A sentence about what is wrong with the arguments; empty if they fit the function."""
    try:
        entry.signature.checked(arguments)
    except PluginError as error:
        return " ".join(filter(None, (capital(error.sentence), error.advice)))
    return ""
