"""The grammar of the native form for lark: an oracle that shares no code with the reader.

Of header values it knows only what the generated texts hold.
"""

from __future__ import annotations

from lark import Lark
from lark.exceptions import LarkError

_TEXT = r'"(?:[^"\\\r\n]|\\["\\\/bfnrt]|\\u[0-9a-fA-F]{4})*"'
_NAME = rf'(?:(?:[^\s{{}}\[\]:,#\/"()>-]|-(?!>))+|{_TEXT})'
_END = r"[ \t,]*(?:\/\/[^\r\n]*)?(?=[\r\n]|$)"
_START = r"#[ \t]*"
_COLON = r"[ \t]*:[ \t]*"
_JSON = rf"(?:-?[0-9]+|{_TEXT}|\{{\}}|\[[0-9]*\]|null)"
_ENTRY = rf"{_NAME}{_COLON}[0-9]+(?=[ \t,)])[ \t,]*"
_STATE = rf"(?:INITIAL|ACTIVATING){_COLON}{_NAME}"
_SUBS = rf"SUB_SBS{_COLON}\([ \t,]*(?:{_ENTRY})*\)"
_NUMBER = rf"NUM_FACTS{_COLON}[0-9]*"

GRAMMAR = rf"""
start: (branch | FIELD | ",")*
branch: "{{" part* NAME_LINE part* "}}"
part: HEADER | HEADER_FIELD | FIELD | state | ","
state: NAME ":" "[" (edge | FIELD | ",")* "]"
edge: NAME "->" NAME

NAME: /{_NAME}/
NAME_LINE.3: /{_START}NAME{_COLON}{_NAME}{_END}/
FIELD.3: /{_START}_[a-z]+{_COLON}{_JSON}{_END}/
HEADER_FIELD.4: /{_START}HEADER\._[a-z]+{_COLON}{_JSON}{_END}/
HEADER.2: /{_START}(?:{_STATE}|{_SUBS}|{_NUMBER}){_END}/

%ignore /\s+/
%ignore /\/\/[^\r\n]*/
"""

_PARSER = Lark(GRAMMAR, parser="lalr")


def accepts(text: str) -> bool:
    """Whether a text is one of the grammar; HEADER is no name of a state."""
    try:
        tree = _PARSER.parse(text)
    except LarkError:
        return False
    states = tree.find_data("state")
    return all(str(state.children[0]).strip('"') != "HEADER" for state in states)
