"""The Operation Library (paper, Generation of Operation Library): it finds the code for the names
of operations and facts."""
