"""Carries out a joint step: the data of a run, its senses, guards and checks, and its failures."""
