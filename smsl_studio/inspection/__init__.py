"""Inspection: what can be said about a blueprint before anything moves."""
