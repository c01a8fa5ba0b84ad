"""The processes of the bench ``stopping``: programs with long work that are stopped during it."""
