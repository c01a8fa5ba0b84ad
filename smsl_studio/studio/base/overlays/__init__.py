"""What floats over a canvas: breadcrumb, zoom control, legends, banner, cards.

These widgets are children of the view, not of its viewport: a viewport scrolls its children along.
"""
