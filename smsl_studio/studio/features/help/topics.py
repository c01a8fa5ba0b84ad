"""What F1 explains: one row for each mode, panel, part and dialog of the window."""

from __future__ import annotations

from PySide6.QtWidgets import QWidget

from smsl_studio.studio.features.help.pages import HelpPlace

_PANELS = "panels-and-what-they-say-when-empty"


def _panel(name: str) -> HelpPlace:
    """The row of a panel in the table of panels."""
    return HelpPlace("window.md", _PANELS, name)


def _window(anchor: str, word: str = "") -> HelpPlace:
    return HelpPlace("window.md", anchor, word)


MODES = {
    "start": _window("the-start-page"),
    "draw": HelpPlace("engineer.md", "2-draw-it"),
    "run": HelpPlace("engineer.md", "4-run-it"),
    "supervise": _window("supervise"),
    "review": _window("review"),
    "replay": _window("replay"),
}
"""By mode: what is explained if no row of ``PARTS`` fits what has the focus."""

PARTS = {
    "Canvas": _panel("Canvas"),
    "Properties": _window("forms"),
    "HeaderForm": _panel("Branch header"),
    "ClaimsLine": _window("inspection"),
    "Findings": _panel("Findings"),
    "SourcePane": _window("the-source"),
    "InspectionPanel": _window("inspection"),
    "ClaimTable": HelpPlace("shown.md"),
    "RunView": HelpPlace("shown.md"),
    "DrawingFindBar": _window("finding"),
    "Palette": _window("finding", "Anything"),
    "FixCard": _panel("Findings"),
    "ChangeBar": _window("files", "Other programs"),
    "WorldView": _panel("World"),
    "TilesView": _window("a-run-without-physics"),
    "FaultDialog": _window("a-run-without-physics", "Faults"),
    "SupervisorsDialog": HelpPlace("supervision.md", "automatic-supervisors-by-name"),
    "WayDialog": HelpPlace("supervision.md", "when-no-way-leads-on-online-generation"),
    "ForecastStrip": HelpPlace("supervision.md", "forecasts"),
    "RequestDialog": HelpPlace("design-cycle.md", "generate-again"),
    "TextDialog": HelpPlace("design-cycle.md", "what-lies-beside-the-blueprint"),
    "FunctionsDialog": HelpPlace("text.md", "functions-that-are-missing"),
    "StageBoard": HelpPlace("design-cycle.md", "what-a-card-says"),
    "StageSide": HelpPlace("design-cycle.md"),
    "CampaignDialog": _window("campaign"),
    "RatesDialog": _window("campaign"),
    "OwnWindow": _window("supervise"),
    "PossiblePanel": _panel("Possible now"),
    "HoldCard": HelpPlace("supervision.md", "when-it-cannot-go-on"),
    "FactsTable": HelpPlace("monitoring.md", "from-sample-to-fact"),
    "StateCheckView": HelpPlace("monitoring.md", "where-an-sb-is-and-what-a-check-says"),
    "CheckPanel": _panel("State check"),
    "Timeline": _panel("Timeline"),
    "Transport": HelpPlace("engineer.md", "4-run-it"),
    "StepIn": _window("supervise", "Deciding"),
    "SignDialog": _window("review", "Signing"),
    "KeyDialog": _window("review", "Signing"),
    "CommentDialog": _window("review", "Comments"),
    "TaskCard": _window("people", "The card"),
    "Continuum": _window("people", "Human and automation"),
    "SettingsDialog": _window("settings"),
    "CrashPage": _window("a-failure-of-the-program"),
    "MenuRow": _window("layout"),
    "ModeBar": _window("layout"),
    "CompareDialog": _window("comparing"),
    "LastChangeForm": _window("who-changed-an-element"),
    "MergePage": _window("merging"),
    "RevisionDialog": _window("comparing"),
    "StatePick": _window("walking-through-configurations"),
    "RefusedShape": _window("changing-the-shape"),
    "IdentifyDialog": _window("changing-the-shape"),
    "FindingsDialog": _window("other-programs"),
    "MapWindow": _window("map-of-branches"),
    "PictureDialog": _window("pictures-diagrams-paper"),
    "RoomPage": HelpPlace("room.md", "the-page-room"),
    "MonitorPage": HelpPlace("monitoring.md", "the-monitor-page"),
    "MonitorWindow": HelpPlace("monitoring.md", "the-monitor-page"),
    "PersonsDialog": _window("people", "Who answers"),
    "LevelEditor": HelpPlace("people.md", "levels"),
    "RecoveryOffer": _window("files", "The journal"),
    "PluginQuestion": _window("plugins"),
    "FixList": _panel("Findings"),
    "HelpWindow": _window("help"),
    "QMessageBox": _window("files", "Saving"),
    "QFileDialog": _window("files"),
}
"""By the class of a widget: what is explained while it, or a part of it, has the focus.

A panel beside the drawing needs no entry: its name leads to its row in the table of panels.
"""


def place_about(focus: QWidget | None, mode: str) -> HelpPlace:
    """What explains the widget that has the keyboard focus.

    The innermost part counts that has an entry or is a panel, else the mode.
    """
    widget = focus
    while widget is not None:
        if found := _entry(widget):
            return PARTS[found]
        if name := widget.property("panel"):
            return _panel(name)
        widget = None if widget.isWindow() else widget.parentWidget()
    # The other pages of Draw have no row of their own.
    return MODES.get(mode, MODES["draw"])


def part_with_row(widget: QWidget | None) -> str:
    """Return the class of the innermost part around a widget that has an entry, or ``""``."""
    while widget is not None:
        if found := _entry(widget):
            return found
        widget = None if widget.isWindow() else widget.parentWidget()
    return ""


def _entry(widget: QWidget) -> str:
    """Return the name under which ``PARTS`` has a widget, or the empty text."""
    return next((one.__name__ for one in type(widget).__mro__ if one.__name__ in PARTS), "")
