"""Scripts: what a supervisor does, which operations are chosen and what goes wrong, written down.

``words`` has the commands and what each takes, ``reading`` makes a script of a file or says where
it is wrong, ``acting`` carries it out while a run goes.
"""
