"""The rules: one small function each, Blueprint in, Remarks out. Each file has one subject.

A rule must accept every blueprint that can be read, however broken it is. A rule ignores faults
that another rule reports (a target that is no state, a digit out of range). A message continues
the address ("SB1/State_a/Op_1 leads to ..."), and the advice comes after a semicolon, in lower
case.

A remark points at the element of its address, or at a key ``below`` that element. For a key that
stands elsewhere, such as one of ``_operations``, ``spot`` is the SB's own path in its file and the
path of the key. R29 is an example.
"""
