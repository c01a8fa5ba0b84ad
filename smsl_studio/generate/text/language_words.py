"""The words by which the reader knows what a sentence is, in English and German."""

from __future__ import annotations

import re
from typing import NamedTuple

ROLES = {
    "surgeon": "surgeon", "senior surgeon": "senior surgeon",
    "assistant surgeon": "assistant surgeon",
    "nurse": "nurse", "scrub nurse": "scrub nurse", "anaesthetist": "anaesthetist",
    "anesthesiologist": "anesthesiologist", "anaesthesiologist": "anaesthesiologist",
    "radiographer": "radiographer", "radiologist": "radiologist", "physician": "physician",
    "doctor": "doctor", "clinician": "clinician", "technician": "technician",
    "engineer": "engineer", "operator": "operator", "assistant": "assistant",
    "physicist": "physicist", "therapist": "therapist", "paramedic": "paramedic",
    "first aider": "first aider", "helper": "helper", "second helper": "second helper",
    "rescuer": "rescuer", "bystander": "bystander", "supervisor": "supervisor",
    "chirurg": "Chirurg", "chirurgin": "Chirurgin", "arzt": "Arzt", "ärztin": "Ärztin",
    "pflegekraft": "Pflegekraft", "pfleger": "Pfleger", "pflegerin": "Pflegerin",
    "krankenschwester": "Krankenschwester", "anästhesist": "Anästhesist",
    "anästhesistin": "Anästhesistin", "radiologe": "Radiologe", "radiologin": "Radiologin",
    "techniker": "Techniker", "technikerin": "Technikerin", "ingenieur": "Ingenieur",
    "ingenieurin": "Ingenieurin", "assistent": "Assistent", "assistentin": "Assistentin",
    "assistenz": "Assistenz", "ersthelfer": "Ersthelfer", "ersthelferin": "Ersthelferin",
    "helfer": "Helfer", "helferin": "Helferin", "sanitäter": "Sanitäter",
    "sanitäterin": "Sanitäterin", "operateur": "Operateur", "operateurin": "Operateurin",
}  # fmt: skip
"""People who are named in texts, as written in small letters, and the role that a blueprint has."""
ROBOTS = frozenset({"robot", "robot arm", "system", "machine", "device", "roboter", "roboterarm",
                    "gerät", "maschine"})  # fmt: skip
"""Who is no person: the system carries it out."""

EQUIPMENT = re.compile(
    r"\b(equipment|materials?|devices?|hardware|tools|instruments|you (will )?need|what is needed"
    r"|ausrüstung|materialien|material|geräte|instrumente|hilfsmittel|benötigt|sie brauchen)\b",
    re.IGNORECASE,
)
"""Headings of lists of things that are needed."""
ASIDE = re.compile(
    r"\b(sources?|references?|literature|bibliography|licen[cs]e|notes?|remarks?|background|aims?"
    r"|purpose|scope|contents|glossary|abbreviations|warnings?|cautions?|contraindications?"
    r"|indications?|about|history|authors?|disclaimer|quellen?|literatur|hinweise?|anmerkung(en)?"
    r"|zweck|ziel|inhalt|glossar|abkürzungen|warnung(en)?|vorsicht|kontraindikation(en)?"
    r"|indikation(en)?|autor(en)?|haftung)\b",
    re.IGNORECASE,
)
"""Headings of parts that are no steps."""
CAUTION = re.compile(
    r"^(never|do not|don't|avoid|caution|warning|note|important|niemals|nie|keinesfalls"
    r"|auf keinen fall|vorsicht|achtung|warnung|hinweis|wichtig|vermeiden)\b",
    re.IGNORECASE,
)
"""Sentences that forbid or explain. They are kept as cautions and are no steps."""

_END = r"\s*[.!]?\s*$"
WAIT = re.compile(
    r"^(?:please\s+)?(?:wait\s+(?:until|till|for)|warten?\s*(?:sie)?,?\s*(?:bis|auf)|(?P<once>once)"
    rf"|(?P<sobald>sobald))\s+(?P<what>.+?){_END}",
    re.IGNORECASE,
)
PAUSE = re.compile(
    r"^(?:wait|pause)\s+(?:for\s+)?(?P<time>(?:about\s+)?\d.*)$|^(?P<zeit>\d\S*\s*\w+)\s+warten\b"
    r"|^warten?\s+(?:sie\s+)?(?P<dauer>(?:etwa\s+)?\d.*)$",
    re.IGNORECASE,
)
UNTIL = re.compile(
    rf"^(?P<act>.+?),?\s+(?:until|till|so lange bis|solange,? bis|bis)\s+(?P<what>\D.+?){_END}",
    re.IGNORECASE,
)
IF_FIRST = re.compile(
    r"^(?:(?:but|however|aber)\s+)?(?:if|in case(?: of)?|should|wenn|falls|im falle?(?: von| einer"
    r"| eines)?)\s+(?P<when>.+?)(?:\s*,\s*(?:then\s+|dann\s+|so\s+)?|\s+(?:then|dann)\s+|\s*:\s*)"
    rf"(?P<act>.+?){_END}",
    re.IGNORECASE,
)
IF_OPEN = re.compile(r"^(?:if|in case of|wenn|falls)\s+(?P<when>[^,]+?)\s*:\s*$", re.IGNORECASE)
IF_LAST = re.compile(
    rf"^(?P<act>.+?),?\s+(?:if|in case|wenn|falls)\s+(?P<when>.+?){_END}", re.IGNORECASE
)
ELSE = re.compile(r"^(?:otherwise|or else|else|if not|sonst|andernfalls|ansonsten),?\s+(?P<act>.+)",
                  re.IGNORECASE)  # fmt: skip
AGAIN = re.compile(
    r"\b(again|repeat|retry|redo|once more|anew|erneut|noch einmal|nochmals?|wiederhol\w*"
    r"|von neuem|wieder)\b",
    re.IGNORECASE,
)
GO_ON = re.compile(
    r"\b(go on|carry on|continue|proceed|skip|next step|weiter\w*|fortfahren|fortsetzen"
    r"|überspringen)\b",
    re.IGNORECASE,
)
BACK_TO = re.compile(
    r"\b(?:go back|return|start again|begin again|repeat|continue|zurück|wiederhol\w*|weiter)\b.*?"
    r"\b(?:steps?|schritt\w*|punkt)\s+(?P<step>\d{1,3}(?:\.\d{1,3})*)",
    re.IGNORECASE,
)
FROM_START = re.compile(
    r"\b(start over|from the (?:start|beginning)|von vorn\w*|ganz von vorn\w*|abort|abbrechen"
    r"|brechen sie\b.*\bab)\b",
    re.IGNORECASE,
)
TIME = re.compile(
    r"(?P<many>\d+(?:[.,]\d+)?)\s*(?:-|to|bis)?\s*(?:\d+)?\s*"
    r"(?P<unit>ms|s|sec|secs|seconds?|sekunden?|min|mins|minutes?|minuten?|h|hours?|stunden?)\b\.?",
    re.IGNORECASE,
)
WITHIN = re.compile(
    r"\b(?:within|in less than|at most|innerhalb(?:\s+von)?|binnen|höchstens)\s+(?=\d)",
    re.IGNORECASE,
)
CONFIRMED = re.compile(
    r"\b(?:(?:only\s+)?after|once|when|nachdem|wenn)\s+(?P<who>.+?)\s+"
    r"(?:(?:has|have)\s+(?:confirmed|agreed|approved)|(?:es\s+)?bestätigt\s+(?:hat|haben)"
    r"|zugestimmt\s+(?:hat|haben))",
    re.IGNORECASE,
)
RISK = re.compile(
    r"\(?\b(?P<en>low|medium|high)[ -]risk\b\)?|\(?\brisk:?\s*(?P<of>low|medium|high)\b\)?"
    r"|\(?\b(?P<de>geringes|niedriges|mittleres|hohes) risiko\b\)?",
    re.IGNORECASE,
)
RISK_WORDS = {"geringes": "low", "niedriges": "low", "mittleres": "medium", "hohes": "high"}
WITH = re.compile(
    r"\b(?:with|using|by means of|mit|mittels|mithilfe)\s+(?:the|a|an|your|dem|der|den|einem|einer"
    r"|eines|des)\s+(?P<what>[^.,;:()]+)",
    re.IGNORECASE,
)
PHRASE_END = re.compile(
    r"\s+(?:and|or|to|until|from|on|in|into|at|of|for|over|that|which|so|if|before|after|while|by"
    r"|und|oder|zu|bis|von|auf|an|im|am|für|über|die|das|so|wenn|bevor|nach|während)\s.*$",
    re.IGNORECASE,
)


class Wording(NamedTuple):
    """The words that the reader writes itself, in the language of the text."""

    start: str
    done: str
    yes: str
    no: str
    waiting: str


ENGLISH = Wording("Start", "Done: ", "yes", "no", "Wait until ")
GERMAN = Wording("Beginn", "Erledigt: ", "ja", "nein", "Warten, bis ")
_GERMAN = frozenset(("der", "die", "das", "und", "ist", "ein", "eine", "mit", "den", "dem", "auf",
                     "für", "nicht", "wenn", "bis", "sie", "zu"))  # fmt: skip
_ENGLISH = frozenset(("the", "and", "is", "a", "an", "with", "on", "of", "for", "not", "if",
                      "until", "to", "in", "it", "you", "be"))  # fmt: skip


LEAST = 8
"""So many words show in which language a text is."""


def wording_of(text: str) -> tuple[Wording, bool]:
    """Return the words in the language of a text, and whether it is English or German at all."""
    words = re.findall(r"[^\W\d_]+", text.lower())
    german, english = (sum(word in of for word in words) for of in (_GERMAN, _ENGLISH))
    known = 20 * max(german, english) >= len(words)
    return (GERMAN if german > english else ENGLISH), known


def is_foreign(text: str) -> bool:
    """Return whether a text is in a language that the reader does not know. Of a few words in Latin
    letters nobody can say it."""
    words = re.findall(r"[^\W\d_]+", text)
    _, known = wording_of(text)
    return not known and (len(words) >= LEAST or not any(word.isascii() for word in words))
