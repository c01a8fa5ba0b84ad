"""Painters of states, operations and marks. They know no view."""
