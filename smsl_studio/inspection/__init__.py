"""Inspection: the findings about a blueprint before anything moves."""
