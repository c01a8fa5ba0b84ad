"""A joint step carried out: the facts of a run, its senses, guards, checks, and what goes wrong."""
