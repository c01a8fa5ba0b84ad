"""What generated code may not say, found in its text before any of it runs.

A generated function gets one thing, the world. It has no way to a module, a file or a process: it
imports nothing, it reads no name that begins with ``_`` and no attribute that leads to the frames
and modules of others, and it sets no attribute and no item but those of its own lists and dicts:
who could replace a method of the world could fake its own sweep. This is the first of three walls.
The second looks at what the code does while it runs (``generated_watch``), the third is the
kernel's (``host/shut_in``).
"""

from __future__ import annotations

import ast
import builtins
import inspect
import warnings
from collections.abc import Iterator
from dataclasses import dataclass
from types import CodeType

from smsl_studio.errors import Place, PluginError

LONGEST_CODE = 20_000
"""The largest number of characters of a file. A small motion needs far less."""
ORIGIN = "_origin"
"""The one name with ``_`` that a file may have: who made it, as plain values."""
GIVEN = frozenset((
    "abs", "all", "any", "bool", "dict", "enumerate", "float", "int", "len", "list", "max", "min",
    "range", "reversed", "round", "set", "sorted", "str", "sum", "tuple", "zip", "ArithmeticError",
    "AssertionError", "Exception", "IndexError", "KeyError", "NotImplementedError", "RuntimeError",
    "TypeError", "ValueError", "ZeroDivisionError",
))  # fmt: skip
"""The names of Python that it may use."""

_KINDS = (
    ast.Module, ast.FunctionDef, ast.arguments, ast.arg, ast.Return, ast.Assign, ast.AugAssign,
    ast.AnnAssign, ast.NamedExpr, ast.For, ast.While, ast.If, ast.Break, ast.Continue, ast.Pass,
    ast.Expr, ast.Yield, ast.YieldFrom, ast.Call, ast.keyword, ast.Name, ast.Attribute,
    ast.Constant, ast.BinOp, ast.UnaryOp, ast.BoolOp, ast.Compare, ast.IfExp, ast.Subscript,
    ast.Slice, ast.List, ast.Tuple, ast.Dict, ast.Set, ast.ListComp, ast.SetComp, ast.DictComp,
    ast.GeneratorExp, ast.comprehension, ast.JoinedStr, ast.FormattedValue, ast.Starred, ast.Raise,
    ast.Try, ast.ExceptHandler, ast.Assert, ast.Lambda, ast.expr_context, ast.operator,
    ast.unaryop, ast.boolop, ast.cmpop,
)  # fmt: skip
_NO_PYTHON = (SyntaxError, ValueError, RecursionError, MemoryError)
_LEADING_OUT = ("gi_", "f_", "cr_", "ag_", "tb_", "co_", "func_")
_TEXT_MACHINES = frozenset(("format", "format_map"))
"""They read attributes that stand in a text."""
_WORDS = {
    ast.Import: "it imports something",
    ast.ImportFrom: "it imports something",
    ast.ClassDef: "it makes a class",
    ast.Global: "it changes what is outside of it",
    ast.Nonlocal: "it changes what is outside of it",
    ast.With: "it enters a context",
    ast.Await: "it waits for something else",
    ast.AsyncFunctionDef: "it waits for something else",
}


@dataclass(frozen=True, slots=True)
class CodeFault:
    """What a line of generated code may not say."""

    line: int
    sentence: str


def parsed(text: str, file: str, function: str = "") -> ast.Module:
    """Return the tree of generated code that says nothing forbidden and has a ``function``.
    PluginError, with its first line, for any other."""
    fault = next(code_faults(text, function), None)
    if fault is not None:
        advice = "Generated code asks its world alone. Take this out, or write a plugin yourself."
        raise PluginError(fault.sentence, Place(file, fault.line, 1), advice)
    return ast.parse(text)


def code_faults(text: str, function: str = "") -> Iterator[CodeFault]:
    """Yield what generated code may not say, in the order of its lines. If that is nothing, yield
    why it cannot be compiled, or why its ``function`` is no motion. Nothing of it runs."""
    if len(text) > LONGEST_CODE:
        yield CodeFault(1, f"the code has more than {LONGEST_CODE:,} characters")
        return
    try:
        tree = ast.parse(text)
    except _NO_PYTHON as error:
        yield _no_python(error, 1)
        return
    found = [*_top(tree), *_deep(tree), *_set(tree)]
    if found:
        yield from sorted(found, key=lambda one: one.line)
        return
    made: dict[str, CodeType] = {}
    for one in tree.body:
        if isinstance(one, ast.FunctionDef):
            try:
                made[one.name] = _compiled(one)
            except _NO_PYTHON as error:
                yield _no_python(error, one.lineno)
                return
    if function:
        yield from _no_motion(made.get(function), function)


def _no_python(error: BaseException, line: int) -> CodeFault:
    words = getattr(error, "msg", None) or str(error) or "it is too large"
    return CodeFault(getattr(error, "lineno", None) or line, f"the code is no Python: {words}")


def _compiled(one: ast.FunctionDef) -> CodeType:
    """Return the code of a function, which nobody calls."""
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        whole = compile(ast.Module(body=[one], type_ignores=[]), "generated", "exec")
    found = (part for part in whole.co_consts if isinstance(part, CodeType))
    return next(part for part in found if part.co_name == one.name)


def _no_motion(made: CodeType | None, function: str) -> Iterator[CodeFault]:
    if made is None:
        yield CodeFault(1, f"it has no function {function}")
    elif not made.co_flags & inspect.CO_GENERATOR:
        yield CodeFault(made.co_firstlineno, f"{function} has no yield, where the world goes on")
    elif made.co_argcount != 1:
        yield CodeFault(made.co_firstlineno, f"{function} takes more or less than the world")


def _set(tree: ast.Module) -> Iterator[CodeFault]:
    """Yield where something is set that is not the function's own."""
    for top in tree.body:
        if not isinstance(top, ast.FunctionDef):
            continue
        own = _own_names(top)
        for one in ast.walk(top):
            if isinstance(getattr(one, "ctx", None), ast.Load | None):
                continue
            if isinstance(one, ast.Attribute):
                yield CodeFault(one.lineno, f"it sets {one.attr} of something that is not its own")
            elif isinstance(one, ast.Subscript) and getattr(one.value, "id", None) not in own:
                yield CodeFault(one.lineno, "it sets an item of something that is not its own")


def _own_names(top: ast.FunctionDef) -> set[str]:
    """Return the names that stand for new lists and dicts alone, wherever they are set."""
    new: set[int] = set()
    for one in ast.walk(top):
        if isinstance(one, ast.Assign | ast.AnnAssign) and _is_new(one.value):
            targets = one.targets if isinstance(one, ast.Assign) else [one.target]
            new.update(map(id, targets))
        elif isinstance(one, ast.AugAssign):
            new.add(id(one.target))  # what the name stands for stays the same, or is new
    own: dict[str, bool] = {}
    for one in ast.walk(top):
        if isinstance(one, ast.Name) and isinstance(one.ctx, ast.Store):
            own[one.id] = own.get(one.id, True) and id(one) in new
        elif isinstance(one, ast.arg):
            own[one.arg] = False
    return {name for name, is_own in own.items() if is_own}


def _is_new(value: ast.expr | None) -> bool:
    if isinstance(value, ast.BinOp):
        return _is_new(value.left) or _is_new(value.right)
    if isinstance(value, ast.Call) and isinstance(value.func, ast.Name):
        return value.func.id in ("list", "dict", "sorted")
    return isinstance(value, ast.List | ast.Dict | ast.ListComp | ast.DictComp)


def _top(tree: ast.Module) -> Iterator[CodeFault]:
    """Yield what stands outside of all functions, and so would run when the file is read."""
    for one in tree.body:
        if isinstance(one, ast.FunctionDef) or _is_origin(one):
            continue
        if isinstance(one, ast.Expr) and isinstance(one.value, ast.Constant):
            continue
        if type(one) not in _WORDS:
            yield CodeFault(one.lineno, "something stands outside of its functions")


def _is_origin(one: ast.stmt) -> bool:
    if not (isinstance(one, ast.Assign) and len(one.targets) == 1):
        return False
    target = one.targets[0]
    if not (isinstance(target, ast.Name) and target.id == ORIGIN):
        return False
    try:
        ast.literal_eval(one.value)
    except (ValueError, TypeError, SyntaxError, MemoryError, RecursionError):
        return False
    return True


def _deep(tree: ast.Module) -> Iterator[CodeFault]:
    waiting: list[ast.AST] = [one for one in tree.body if not _is_origin(one)]
    while waiting:
        one = waiting.pop()
        sentence = _forbidden(one)
        if sentence:
            yield CodeFault(getattr(one, "lineno", 1), sentence)
        else:
            waiting.extend(ast.iter_child_nodes(one))


def _forbidden(one: ast.AST) -> str:
    if isinstance(one, ast.Import | ast.ImportFrom):
        names = [alias.name for alias in one.names]
        module = one.module if isinstance(one, ast.ImportFrom) else None
        return f"it imports {module or ', '.join(names)}"[:200]
    if not isinstance(one, _KINDS):
        return _WORDS.get(type(one), f"{type(one).__name__} is not for generated code")
    if isinstance(one, ast.FunctionDef):
        if one.decorator_list:
            return "its function has a decorator"
        defaults = [*one.args.defaults, *filter(None, one.args.kw_defaults)]
        if not all(isinstance(value, ast.Constant) for value in defaults):
            return "a parameter has a default that is no plain value"
        return _hidden(one.name)
    if isinstance(one, ast.Name):
        if one.id not in GIVEN and hasattr(builtins, one.id):
            return f"it asks for {one.id}"
        return _hidden(one.id)
    if isinstance(one, ast.arg | ast.keyword):
        return _hidden(one.arg or "")
    if isinstance(one, ast.Attribute):
        if one.attr in _TEXT_MACHINES or one.attr.startswith(_LEADING_OUT):
            return f"it reads {one.attr}, which leads out of it"
        return _hidden(one.attr)
    if isinstance(one, ast.ExceptHandler):
        return _hidden(one.name or "")
    if isinstance(one, ast.Try):
        # Python compiles a finally once for each way into it, so that a small file could fill the
        # memory of who checks it.
        leaving = (ast.Try, ast.Return, ast.Break, ast.Continue)
        inside = (part for last in one.finalbody for part in ast.walk(last))
        if any(isinstance(part, leaving) for part in inside):
            return "its finally tries or leaves something"
    return ""


def _hidden(name: str) -> str:
    hidden = name.startswith("_") and name != "_"
    return f"it reads {name}, and names with _ are not for it" if hidden else ""
