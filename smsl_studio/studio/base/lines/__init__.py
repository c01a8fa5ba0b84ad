"""The lines of forms: a name, a field of one kind, and what is to be said about its value.

A line never edits. It shows values, checks what is typed, says a refusal right below the field,
and tells with ``given`` what was meant; the form around it makes the edit.
"""
