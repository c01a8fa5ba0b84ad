"""The part of people in a run: their tasks, who may answer, and the results."""
