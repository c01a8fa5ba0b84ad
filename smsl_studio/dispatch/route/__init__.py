"""The route of a run: the costs of operations, the excluded edges, and the plan to the goals."""
