"""The page Design cycle of Draw: nine stages from the text to the approval."""
