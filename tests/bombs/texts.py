"""Texts that are broken, or written so that a reader works far more than their content needs.

Each function makes a text in one form that repeats a piece ``n`` times.
"""

from __future__ import annotations

_ENDS = {"json": "}\n", "smsl": "}\n", "yaml": ""}
_SAFE = {
    "json": '"Z": {"S": {"o": "S"}}',
    "smsl": "{\n# NAME: Z\nS: [o -> S]\n}\n",
    "yaml": "Z: {S: {o: S}}\n",
}


def _wrapped(form: str, body: str) -> str:
    """A body of one form, with a whole SB behind it."""
    if form == "json":
        return f"{{{body}, {_SAFE['json']}}}\n"
    return f"{body}\n{_SAFE[form]}"


def _in_state(form: str, body: str) -> str:
    """A body inside the first state of an SB."""
    return {
        "json": f'{{"B": {{"S": {{{body}}}, "T": {{}}}}}}\n',
        "smsl": f"{{\n# NAME: B\nS: [{body}]\nT: []\n}}\n",
        "yaml": f"B:\n S: {{{body}}}\n T: {{}}\n",
    }[form]


def nested_lists(form: str, n: int) -> str:
    return {
        "json": f'{{"_x": {"[" * n}{"]" * n}, {_SAFE["json"]}}}\n',
        "smsl": f"# _x: {'[' * n}{']' * n}\n{_SAFE['smsl']}",
        "yaml": f"_x: {'[' * n}{']' * n}\n{_SAFE['yaml']}",
    }[form]


def nested_maps(form: str, n: int) -> str:
    deep = '{"a":' * n + "1" + "}" * n
    head = '{"_x": ' if form == "json" else "# _x: " if form == "smsl" else "_x: "
    return head + deep + (f", {_SAFE['json']}}}" if form == "json" else f"\n{_SAFE[form]}")


def opened_only(form: str, n: int) -> str:
    return {"json": "[", "smsl": "{", "yaml": "["}[form] * n


def opened_braces(form: str, n: int) -> str:
    return "{" * n


def closed_only(form: str, n: int) -> str:
    return _wrapped(form, _doubled_body(form, 1) + "}" * n)


def brackets_in_a_state(form: str, n: int) -> str:
    return _in_state(form, "[" * n)


def mixed_brackets(form: str, n: int) -> str:
    return _wrapped(form, "{[}]" * n)


def commas(form: str, n: int) -> str:
    return _in_state(form, "," * n)


def colons(form: str, n: int) -> str:
    return _in_state(form, ":" * n)


def arrows(form: str, n: int) -> str:
    return _in_state(form, "a -> " * n)


def comments(form: str, n: int) -> str:
    mark = "#" if form == "yaml" else "//"
    lines = f"{mark} x\n" * n
    return _in_state(form, f"\n{lines}") if form == "smsl" else lines + _wrapped(form, "")


def slashes(form: str, n: int) -> str:
    return _wrapped(form, ("/" if form == "json" else "# ") * n)


def blanks(form: str, n: int) -> str:
    return _wrapped(form, _doubled_body(form, 1) + " " * n)


def tabs(form: str, n: int) -> str:
    return _wrapped(form, _doubled_body(form, 1) + "\n\t" * n)


def line_ends(form: str, n: int) -> str:
    return _wrapped(form, _doubled_body(form, 1) + "\r\n\r" * n)


def nulls(form: str, n: int) -> str:
    return _wrapped(form, "\0" * n)


def byte_order_marks(form: str, n: int) -> str:
    return "\ufeff" * n + _wrapped(form, _doubled_body(form, 1))


def one_word(form: str, n: int) -> str:
    return "x" * n


def hyphens(form: str, n: int) -> str:
    return _wrapped(form, "-" * n)


def lost_quotes(form: str, n: int) -> str:
    """A quote that is missing on every line."""
    return _in_state(form, "\n" + '"o: "T",\n' * n)


def one_lost_quote(form: str, n: int) -> str:
    return _in_state(form, '"o' + "x" * n)


def lone_quotes(form: str, n: int) -> str:
    return _in_state(form, '"' * (n | 1))


def backslashes(form: str, n: int) -> str:
    return _in_state(form, '"' + "\\" * (n | 1))


def bare_names(form: str, n: int) -> str:
    return _in_state(form, "a b " * n)


def missing_commas(form: str, n: int) -> str:
    return _in_state(form, " ".join(f'"o{i}": "T"' for i in range(n)))


def escapes(form: str, n: int) -> str:
    quoted = '"' + "\\u00e9" * n + '"'
    return _wrapped(form, {"json": f'"_x": {quoted}', "smsl": f"# _x: {quoted}"}.get(form, quoted))


def half_pairs(form: str, n: int) -> str:
    quoted = '"' + "\\ud800" * n + '"'
    head = {"json": '"_x": ', "smsl": "# _x: ", "yaml": "_x: "}[form]
    return _wrapped(form, head + quoted)


def long_number(form: str, n: int) -> str:
    head = {"json": '"_x": ', "smsl": "# _x: ", "yaml": "_x: "}[form]
    return _wrapped(form, head + "9" * n)


def large_exponents(form: str, n: int) -> str:
    head = {"json": '"_x": ', "smsl": "# _x: ", "yaml": "_x: "}[form]
    return _wrapped(form, f"{head}[{','.join(['1e999999'] * n)}]")


def long_fractions(form: str, n: int) -> str:
    head = {"json": '"_x": ', "smsl": "# _x: ", "yaml": "_x: "}[form]
    return _wrapped(form, f"{head}[{','.join(['0.' + '3' * 3000] * n)}]")


def _doubled_body(form: str, n: int) -> str:
    """An SB with one state, ``n`` times."""
    return {
        "json": ",".join(['"A":{"S":{"o":"S"}}'] * n),
        "smsl": "{\n# NAME: A\nS:[o->S]\n}\n" * n,
        "yaml": "A: {S: {o: S}}\n" * n,
    }[form]


def doubled_sb(form: str, n: int) -> str:
    return _wrapped(form, _doubled_body(form, n))


def doubled_states(form: str, n: int) -> str:
    """Every state is written twice."""
    if form == "smsl":
        rows = "".join(f"S{i}: [a -> S0]\n" * 2 for i in range(n))
        return f"{{\n# NAME: B\n{rows}}}\n"
    if form == "yaml":
        return "B:\n" + "".join(f' S{i}: {{"a": "S0"}}\n' * 2 for i in range(n))
    pairs = ",\n".join(f'"S{i}":{{"a":"S0"}},"S{i}":{{"a":"S0"}}' for i in range(n))
    return f'{{"B":{{{pairs}}}}}\n'


def doubled_operations(form: str, n: int) -> str:
    arrow = " -> " if form == "smsl" else ": "
    return _in_state(form, ",".join([f'"o"{arrow}"T"'] * n))


def doubled_headers(form: str, n: int) -> str:
    if form == "smsl":
        lines = "# INITIAL: S\n" * n
        return f"{{\n# NAME: B\n{lines}S: [o -> S]\n}}\n"
    inner = ",".join(['"INITIAL": "S"'] * n)
    if form == "yaml":
        return f"B:\n HEADER: {{{inner}}}\n S: {{o: S}}\n"
    return f'{{"B": {{"HEADER": {{{inner}}}, "S": {{"o": "S"}}}}}}\n'


def doubled_everywhere(form: str, n: int) -> str:
    """In every state of a ring an operation twice."""
    arrow = " -> " if form == "smsl" else ": "
    rows = [(f"S{i}", f'"o"{arrow}"S{(i + 1) % n}"') for i in range(n)]
    if form == "smsl":
        return "{\n# NAME: B\n" + "".join(f"{s}: [{o}, {o}]\n" for s, o in rows) + "}\n"
    if form == "yaml":
        return "B:\n" + "".join(f" {s}: {{{o}, {o}}}\n" for s, o in rows)
    return '{"B": {' + ",\n".join(f'"{s}": {{{o}, {o}}}' for s, o in rows) + "}}\n"


def trailing_text(form: str, n: int) -> str:
    return _wrapped(form, _doubled_body(form, 1)) + "} x\n" * n


def not_closed(form: str, n: int) -> str:
    """SBs that are never closed."""
    return {
        "json": "{" + "".join(f'"B{i}": {{"S": {{"o": "S"}},\n' for i in range(n)),
        "smsl": "".join(f"{{\n# NAME: B{i}\nS: [o -> S\n" for i in range(n)),
        "yaml": "".join(f"B{i}: {{S: {{o: S}},\n" for i in range(n)),
    }[form]


def lines_of_headers(form: str, n: int) -> str:
    return "# NAME: B\n" * n if form != "json" else '"HEADER": {' * n


def without_names(form: str, n: int) -> str:
    return {"json": '{"": {}},' * n, "smsl": "{\nS: []\n}\n" * n, "yaml": ": {}\n" * n}[form]


def laughs(form: str, n: int) -> str:
    """Anchors that stand for nine times the one before; in JSON and native text they are noise."""
    lines = ["_a0: &a0 [x, x, x]"]
    for i in range(1, 30):
        lines.append(f"_a{i}: &a{i} [{', '.join([f'*a{i - 1}'] * 9)}]")
    return "\n".join(lines) + "\n" + "# x\n" * n + _SAFE["yaml"]


def merge_keys(form: str, n: int) -> str:
    anchor = "_a: &a {x: 1}\n"
    return anchor + "".join(f"B{i}: {{<<: *a}}\n" for i in range(n)) + _SAFE["yaml"]


def many_anchors(form: str, n: int) -> str:
    return "_x: [" + ",".join(f"&a{i} 1,*a{i}" for i in range(n)) + "]\n" + _SAFE["yaml"]


def anchored_states(form: str, n: int) -> str:
    head = "_a: &a {" + ", ".join(f"o{i}: S" for i in range(200)) + "}\n"
    return head + "B:\n" + "".join(f" S{i}: *a\n" for i in range(n))


def tags(form: str, n: int) -> str:
    return "_x: [" + ",".join(["!!str 1"] * n) + "]\n" + _SAFE["yaml"]


def foreign_tags(form: str, n: int) -> str:
    return "_x: [" + ",".join(["!x 1"] * n) + "]\n" + _SAFE["yaml"]


def dashes(form: str, n: int) -> str:
    return "- " * n + "x\n"


def block_lists(form: str, n: int) -> str:
    return "_x:\n" + "- 1\n" * n + _SAFE["yaml"]


def stairs(form: str, n: int) -> str:
    """Each line stands one column further in: the text grows with the square of its lines."""
    depth = max(2, int((2 * n) ** 0.5))
    return "".join(f"{' ' * i}a{i}:\n" for i in range(depth)) + " " * depth + "x\n"


def flow_one_key_maps(form: str, n: int) -> str:
    return "B: [" + ", ".join(f"S{i}: [o: S{i}]" for i in range(n)) + "]\n"


def documents(form: str, n: int) -> str:
    return "--- {}\n" * n


def folded(form: str, n: int) -> str:
    return "_x: >\n" + "  word\n" * n + _SAFE["yaml"]


def question_marks(form: str, n: int) -> str:
    return "? " * n + "a\n"


def native_in_pieces(form: str, n: int) -> str:
    return "{ # NAME: B\n" * n


def native_maps(form: str, n: int) -> str:
    entries = ", ".join(f"B{i}: {i}" for i in range(n))
    return f"{{\n# NAME: A\n# SUB_SBS: ({entries})\nS: [o -> S]\n}}\n"


def native_equals(form: str, n: int) -> str:
    return "{\n# NAME: B\n" + "S: [a => T]\n" * n + "}\n"


def native_comments_between(form: str, n: int) -> str:
    return "{\n# NAME: B\nS: [a // x\n" + "// y\n" * n + "-> S]\n}\n"


def native_fields(form: str, n: int) -> str:
    return "".join(f"# _x{i}: [1, 2]\n" for i in range(n)) + _SAFE["smsl"]


def native_sbs_on_a_line(form: str, n: int) -> str:
    return "".join(f"{{# NAME: B{i}\nS:[o->S]}}" for i in range(n))


def native_json_over_lines(form: str, n: int) -> str:
    return "# _x: [\n" + "1,\n" * n + "]\n" + _SAFE["smsl"]
