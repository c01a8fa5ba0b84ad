"""Approval: what people signed, and whether it counts. docs/approval.md explains it for people.

``statement`` is what one person signs, ``record_file`` the file of all who signed. ``policy`` and
``register`` say who may. ``judge`` is the one place that decides; it reads no file and no clock.
``key_store``, ``seen_records`` and ``audit_log`` are the folder of the user.
"""
