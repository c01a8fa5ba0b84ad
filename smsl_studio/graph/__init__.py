"""Questions about the shape of a blueprint: reachable states, cheapest routes, places in a drawing.

Inside the room, states and operations are integers in arrays. Questions and answers use names and
addresses, and never an object of a library.
"""
