"""Canonical bytes, digests, chains, and signatures. This package knows neither blueprints nor
runs."""
