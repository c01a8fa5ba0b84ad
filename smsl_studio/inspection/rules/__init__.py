"""The rules: one small function each, Blueprint in, Findings out, in files by what they look at.

A rule must bear any blueprint that can be read, however broken: what another rule reports (a
target that is no state, a digit out of range) it passes over. Messages continue the address
("SB1/State_a/Op_1 leads to ..."), and the advice comes after a semicolon.
"""
