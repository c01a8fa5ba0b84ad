"""Code that carries a blueprint out without Studio: its files as text, from templates."""
