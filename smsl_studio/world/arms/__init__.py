"""The arms that worlds share: one small file for each, with the value ``ARM``.

The name of the file is the name of the arm (``--robot panda``), so a further file is a further arm.
"""
