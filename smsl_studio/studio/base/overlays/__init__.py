"""Widgets that float over a canvas: breadcrumb, legends, banner, cards.

They are children of the view. Children of its viewport would scroll with the picture.
"""
