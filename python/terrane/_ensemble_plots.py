# SPDX-License-Identifier: LGPL-3.0-or-later
"""Plots of the report of an ensemble: SVG and PNG as text, without other libraries."""

from __future__ import annotations

import base64
import html
import struct
import zlib
from typing import Any, Dict, List, Sequence, Tuple

import numpy as np

from . import _core

_WIDTH, _HEIGHT, _LEFT, _BOTTOM, _TOP = 420, 200, 12, 34, 18
#: Colours of maps from low to high, evenly spaced and of rising lightness: those of viridis.
_COLOURS = ((68, 1, 84), (59, 82, 139), (33, 145, 140), (94, 201, 98), (253, 231, 37))


def number(value: float) -> str:
    """Return a number for readers, with four significant digits."""
    return "–" if value != value else _core.figure(value, 4)


def histogram(values: Sequence[float], marks: Dict[str, float], given: float, label: str) -> str:
    """Return an SVG of a histogram with the curve of exceedance, P90, P50, P10, and the value of the model."""
    there = np.sort(np.asarray([v for v in values if v == v], dtype=np.float64))
    if there.size == 0:
        return "<p>No value.</p>"
    low, high = float(min(there[0], given)), float(max(there[-1], given))
    span = (high - low) or abs(high) or 1.0
    low, high = low - 0.04 * span, high + 0.04 * span
    bins = int(np.clip(np.sqrt(there.size), 5, 40))
    counts, edges = np.histogram(there, bins=bins, range=(low, high))

    def x(value: float) -> float:
        return _LEFT + (value - low) / (high - low) * (_WIDTH - 2 * _LEFT)

    def y(share: float) -> float:
        return _TOP + (1 - share) * (_HEIGHT - _TOP - _BOTTOM)

    tallest = max(1, int(counts.max()))
    parts = [f'<svg viewBox="0 0 {_WIDTH} {_HEIGHT}" role="img" aria-label="{html.escape(label)}">']
    for count, left, right in zip(counts, edges[:-1], edges[1:]):
        if count:
            top = y(0.92 * count / tallest)
            parts.append(f'<rect class="bar" x="{x(left):.1f}" y="{top:.1f}" width="{max(0.5, x(right) - x(left) - 1):.1f}" '
                         f'height="{y(0) - top:.1f}"/>')
    steps = there[np.unique(np.linspace(0, there.size - 1, min(there.size, 200)).astype(int))]
    ranks = np.searchsorted(there, steps)
    curve = " ".join(f"{x(v):.1f},{y(1 - r / there.size):.1f}" for v, r in zip(steps, ranks))
    parts.append(f'<polyline class="curve" points="{curve}"/>')
    for i, (name, value) in enumerate(marks.items()):
        if value == value:
            parts.append(f'<line class="mark" x1="{x(value):.1f}" x2="{x(value):.1f}" y1="{_TOP}" y2="{y(0)}"/>'
                         f'<text class="head" x="{x(value):.1f}" y="{_TOP - 5}" text-anchor="middle">{name.upper()}</text>')
    parts.append(f'<line class="given" x1="{x(given):.1f}" x2="{x(given):.1f}" y1="{y(0.5)}" y2="{y(0)}"/>')
    parts.append(f'<line class="axis" x1="{_LEFT}" x2="{_WIDTH - _LEFT}" y1="{y(0)}" y2="{y(0)}"/>')
    for at, anchor in ((there[0], "start"), (there[-1], "end")):
        parts.append(f'<text x="{_LEFT if anchor == "start" else _WIDTH - _LEFT}" y="{_HEIGHT - 16}" '
                     f'text-anchor="{anchor}">{number(at)}</text>')
    return "".join(parts) + f'<text x="{_WIDTH / 2}" y="{_HEIGHT - 2}" text-anchor="middle">{html.escape(label)}</text></svg>'


def _png(pixels: Any) -> str:
    """Return an RGBA image, shape (rows, columns, 4), as a data URI."""
    rows, columns = pixels.shape[:2]
    raw = b"".join(b"\0" + row.tobytes() for row in pixels)

    def chunk(kind: bytes, data: bytes) -> bytes:
        return struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))

    file = (b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", struct.pack(">IIBBBBB", columns, rows, 8, 6, 0, 0, 0))
            + chunk(b"IDAT", zlib.compress(raw, 9)) + chunk(b"IEND", b""))
    return "data:image/png;base64," + base64.b64encode(file).decode()


def colour_map(values: Any, low: float, high: float, label: str, frame: Tuple[float, float, float, float]) -> str:
    """Return a figure of a map with its scale; north is up, and cells without a value are transparent."""
    there = np.isfinite(values)
    share = np.clip((np.where(there, values, low) - low) / ((high - low) or 1.0), 0, 1)
    pixels = np.zeros((*values.shape, 4), dtype=np.uint8)
    pixels[..., :3] = _colour(share)
    pixels[..., 3] = np.where(there, 255, 0)
    rows, columns = values.shape
    width = 1000 * (columns * frame[2]) / (rows * frame[3])
    scale = _png(np.concatenate([_colour(np.linspace(0, 1, 64)), np.full((64, 1), 255)], 1)
                 .astype(np.uint8).reshape(1, 64, 4))
    return (f'<figure><svg class="map" role="img" aria-label="{html.escape(label)}" viewBox="0 0 {width:.1f} 1000">'
            f'<image width="{width:.1f}" height="1000" preserveAspectRatio="none" href="{_png(pixels[::-1])}"/></svg><figcaption>{html.escape(label)}<br><span class="scale">{number(low)} '
            f'<img src="{scale}" alt="colours from low to high"> {number(high)}</span></figcaption></figure>')


def _colour(share: Any) -> Any:
    at = np.linspace(0, 1, len(_COLOURS))
    return np.stack([np.interp(share, at, [c[i] for c in _COLOURS]) for i in range(3)], -1).round()


def table(heads: Sequence[str], rows: Sequence[Sequence[Any]]) -> str:
    """Return a table; numbers are set to the right, texts are escaped."""
    def cell(value: Any) -> str:
        if isinstance(value, (int, float, np.integer, np.floating)):
            return f'<td class="n">{number(float(value))}</td>'
        return f"<td>{html.escape(str(value))}</td>"

    lines: List[str] = ["<tr>" + "".join(f"<th>{html.escape(h)}</th>" for h in heads) + "</tr>"]
    lines += ["<tr>" + "".join(map(cell, row)) + "</tr>" for row in rows]
    return '<div class="wide"><table>' + "".join(lines) + "</table></div>"
