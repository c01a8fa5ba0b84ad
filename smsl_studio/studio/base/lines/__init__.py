"""The lines of forms: a name, a field of one kind, and a sentence about its value.

A line never edits the blueprint. It shows values, checks what is typed, and shows a refusal below
the field. The signal ``given`` carries a new value, and the form makes the edit.
"""
