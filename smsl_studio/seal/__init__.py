"""Canonical bytes, digests and chains. This package knows neither blueprints nor runs."""
