"""The page Rules of the mode Draw: a text of rules, what it gives, and what the drawing lacks."""
