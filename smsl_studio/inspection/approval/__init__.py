"""Approval: what people have signed about a blueprint, and whether it counts.

docs/approval.md explains it for users. ``statement`` has what one person signs. ``record_file`` is
the file with the statements of all signers. ``policy`` and ``register`` say who may sign. ``judge``
alone decides; it reads no file and no clock. ``key_store``, ``seen_records`` and ``audit_log``
handle the files in the user's folder.
"""
