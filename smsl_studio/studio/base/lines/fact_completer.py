"""Completion for the names of facts, over all SBs, by place and by plain name."""

from __future__ import annotations

from PySide6.QtCore import QModelIndex, QObject, QPersistentModelIndex, Qt
from PySide6.QtGui import QStandardItem, QStandardItemModel
from PySide6.QtWidgets import QCompleter

from smsl_studio.blueprint.address import fact_text, split_fact
from smsl_studio.blueprint.model import Blueprint
from smsl_studio.errors import did_you_mean
from smsl_studio.studio.base.controls import NameDelegate

MOST = 4096
"""The most facts that are offered. Others can still be typed."""
TEXT = Qt.ItemDataRole.UserRole


def fact_model(blueprint: Blueprint, parent: QObject) -> QStandardItemModel:
    """The facts as rows: ``SB/digit`` and the plain name."""
    model = QStandardItemModel(parent)
    for branch in blueprint:
        for digit in range(branch.num_facts if branch.table else 0):
            if model.rowCount() >= MOST:
                return model
            text = fact_text(branch.name, digit)
            item = QStandardItem(f"{text}  {branch.fact_name(digit)}")
            item.setData(text, TEXT)
            model.appendRow(item)
    return model


class FactCompleter(QCompleter):
    """Finds facts by any part of their place or name, and completes to their place."""

    def __init__(self, model: QStandardItemModel, parent: QObject) -> None:
        super().__init__(model, parent)
        self.setFilterMode(Qt.MatchFlag.MatchContains)
        self.setCaseSensitivity(Qt.CaseSensitivity.CaseInsensitive)
        self.setMaxVisibleItems(10)
        popup = self.popup()
        if popup is not None:
            popup.setMinimumWidth(220)
            popup.setItemDelegate(NameDelegate(popup))

    def pathFromIndex(self, index: QModelIndex | QPersistentModelIndex) -> str:
        """The text that a row completes to: the place of the fact."""
        return str(index.data(TEXT))


def fact_fault(blueprint: Blueprint, text: str) -> str:
    """A sentence about why a text names no fact; empty if it names one."""
    fact = split_fact(text)
    if fact is None:
        return f"“{text[:40]}” names no fact. Write SB/digit, such as {_example(blueprint)}."
    name, digit = fact
    if name not in blueprint.branches:
        advice = did_you_mean(name, blueprint.branches)
        return f"There is no State Branch “{name[:40]}”. {advice}".strip()
    count = blueprint[name].num_facts if blueprint[name].table else 0
    if digit >= count:
        return f"{name} has no digit {digit}. Its digits go from 0 to {count - 1}."
    return ""


def _example(blueprint: Blueprint) -> str:
    return next((fact_text(branch.name, 0) for branch in blueprint if branch.table), "SB1/0")
