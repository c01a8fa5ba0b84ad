"""The parts that every feature of the window uses: colours, controls, the canvas, rows, words.

This room knows no open document.
"""
