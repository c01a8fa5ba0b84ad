"""Blueprints in the forms of other programs: what is written for them, and what is read of them.

Nothing that is read is run or fetched. What a form cannot hold is told as findings.
"""
