"""The page Inspection: hazards and properties, their verdicts, and the runs that show them."""
