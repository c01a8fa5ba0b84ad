"""The canvas: one SB as a picture of states and operations, and the gestures that edit it.

``Canvas`` is the view, ``CanvasEditor`` ties it to a session, ``Marks`` says what is lit. Geometry
(routing, lanes, loops, labels) is pure and knows no Qt.
"""
