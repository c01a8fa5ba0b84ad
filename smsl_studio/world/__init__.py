"""Worlds: simulated or real surroundings that move and are sensed. Only ``bullet`` uses
PyBullet."""
