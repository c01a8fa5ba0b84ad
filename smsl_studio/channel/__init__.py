"""The protocol between a dispatcher and a world that is somewhere else (``docs/remote.md``).

It has frames, addresses, and both ends of a connection. It knows the form of messages and no
blueprint.
"""
