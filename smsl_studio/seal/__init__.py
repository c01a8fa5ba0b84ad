"""Canonical bytes and digests: bytes in, bytes out; knows nothing of blueprints."""
