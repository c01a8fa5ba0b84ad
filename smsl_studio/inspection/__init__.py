"""Inspection: findings about a blueprint, made before a run begins (paper, Regulated Workflow,
Inspection: the inspector has the full view of the blueprint)."""
