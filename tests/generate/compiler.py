"""The C++ compiler that generated code is tried with."""

from __future__ import annotations

import shutil

import pytest

COMPILER = shutil.which("g++")
FLAGS = ("-std=c++17", "-Wall", "-Wextra", "-Wpedantic", "-Werror", "-O0")
needs_compiler = pytest.mark.skipif(COMPILER is None, reason="needs g++")
