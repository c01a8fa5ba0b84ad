"""Scripts: files with commands of a supervisor, chosen operations and injected faults.

``words`` has the commands and their arguments. ``lines`` reads a file and reports its faults.
``player`` carries a script out during a run.
"""
