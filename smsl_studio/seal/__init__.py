"""Canonical bytes, digests, chains of hashes, and signatures.

This package does not use blueprints or runs.
"""
