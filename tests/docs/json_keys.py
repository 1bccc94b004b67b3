# SPDX-License-Identifier: LGPL-3.0-or-later
"""The keys of a JSON value as paths: {"a": [{"b": 1}]} has a and a[].b."""


def key_paths(value, prefix=""):
    """All paths in the value; the members of a list share one path, that of the list with []."""
    if isinstance(value, dict):
        paths = set()
        for key, inner in value.items():
            path = f"{prefix}.{key}" if prefix else key
            paths |= {path} | key_paths(inner, path)
        return paths
    if isinstance(value, list):
        return set().union(*(key_paths(inner, prefix + "[]") for inner in value), set())
    return set()
