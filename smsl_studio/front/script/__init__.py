"""Scripts: what a supervisor does, which operations are chosen and what goes wrong, written down.

``words`` has the commands and what each takes, ``lines`` makes a script of a file or says where
it is wrong, ``player`` carries it out while a run goes.
"""
