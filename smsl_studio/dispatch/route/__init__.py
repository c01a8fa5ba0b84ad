"""The way of a run: what operations cost, what is shut out, and the plan to the goals."""
