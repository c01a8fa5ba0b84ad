"""What moves and is sensed. PyBullet lives in ``bullet`` and nowhere else."""
