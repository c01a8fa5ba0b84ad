"""Tables of two procedures by brute force: every combination of values is tried with every
operation, and what the start does not reach is taken out. It shares no line with the package."""

from __future__ import annotations

from itertools import product

Table = dict[str, dict[str, str]]


def hanoi(disks: int) -> Table:
    """The towers as stacks; digit 0 is the peg of the smallest disk."""
    table: Table = {}
    for pegs in product("abc", repeat=disks):
        tower = {peg: [disk for disk in range(disks) if pegs[disk] == peg] for peg in "abc"}
        row = table["State_" + "".join(pegs)] = {}
        for here, there in product("abc", repeat=2):
            if tower[here] and (not tower[there] or tower[here][0] < tower[there][0]):
                disk = tower[here][0]
                after = "".join(pegs[:disk]) + there + "".join(pegs[disk + 1 :])
                row[f"Op_{disk + 1}{there}"] = "State_" + after
    return table


def registration() -> Table:
    """The paper's registration: landmarks planned, digitized, tool pose planned, registered."""
    table: Table = {}
    for planned, digitized, posed, registered in product((False, True), repeat=4):
        row: dict[str, tuple[bool, bool, bool, bool]] = {}
        row["Op_UsePrevReg"] = True, True, posed, True
        if posed:
            row["Op_ReplanToolPose"] = planned, digitized, posed, registered
            row["Op_ClearToolPose"] = planned, digitized, False, registered
        else:
            row["Op_PlanToolPose"] = planned, digitized, True, registered
        if planned:
            row["Op_ClearLandmarks"] = False, False, posed, False
            if not registered:
                row["Op_ReplanLandmarks"] = True, False, posed, False
            if not digitized:
                row["Op_DigitizeLandmarks"] = True, True, posed, registered
        else:
            row["Op_PlanLandmarks"] = True, digitized, posed, registered
        if digitized and not registered:
            row["Op_Redigitize"] = planned, digitized, posed, registered
            row["Op_ClearDigitization"] = planned, False, posed, registered
            row["Op_Register"] = planned, digitized, posed, True
        if registered:
            row["Op_ClearReg"] = planned, digitized, posed, False
        table[_name((planned, digitized, posed, registered))] = {
            operation: _name(after) for operation, after in row.items()
        }
    return _reached(table, "State_0000")


def _name(facts: tuple[bool, ...]) -> str:
    return "State_" + "".join("01"[one] for one in facts)


def _reached(table: Table, start: str) -> Table:
    """The table without the states that no way from the start leads to."""
    kept = {start}
    while more := {after for state in kept for after in table[state].values()} - kept:
        kept |= more
    return {state: row for state, row in table.items() if state in kept}
