# SPDX-License-Identifier: LGPL-3.0-or-later
"""Small pictures of surfaces for notebooks: every triangle is drawn, and near ones hide far ones."""

from __future__ import annotations

import base64
import html
import struct
import zlib
from typing import Any, Dict, Iterator, Sequence, Set, Tuple

import numpy as np
import numpy.typing as npt

_WIDTH, _HEIGHT, _RIM = 480, 340, 8  # pixels; shown at half the size
_MOST = 1 << 19  # pixels that are held at a time
_APART = 0.3  # of the distance to the middle
_COLOURS = ("#4878a8", "#c8553d", "#588b5b", "#b08830", "#7d5a9e", "#3d8f95", "#a0606e", "#6b7280")
_SHADES = np.array([[int(c[i:i + 2], 16) for i in (1, 3, 5)] for c in _COLOURS], dtype=np.float64)

_Floats = npt.NDArray[np.float64]
_Integers = npt.NDArray[np.int64]


def _projected(vertices: _Floats) -> _Floats:
    """Return x and y of the picture, in pixels from its upper left corner, and the depth, seen from the south-east and above."""
    low, high = vertices.min(axis=0), vertices.max(axis=0)
    half = high / 2 - low / 2  # of numbers that may be as large as doubles get
    p = (vertices / 2 - (high / 4 + low / 4) * 2) / max(half.max(), 1e-300)
    if half[2] > 0:  # heights are stretched where a model is flat
        p[:, 2] *= min(max(1.0, 0.35 * max(half[0], half[1]) / half[2]), 1e6)
    a, b = np.radians(-30), np.radians(28)
    x = np.cos(a) * p[:, 0] - np.sin(a) * p[:, 1]
    far = np.sin(a) * p[:, 0] + np.cos(a) * p[:, 1]
    seen: _Floats = np.stack([x, -np.sin(b) * far - np.cos(b) * p[:, 2], np.cos(b) * far - np.sin(b) * p[:, 2]], axis=1)
    size, room = np.ptp(seen[:, :2], axis=0), np.array([_WIDTH, _HEIGHT]) - 2.0 * _RIM
    seen *= (room / np.maximum(size, 1e-9)).min()
    seen[:, :2] += np.array([_WIDTH, _HEIGHT]) / 2 - (seen[:, :2].min(axis=0) + seen[:, :2].max(axis=0)) / 2
    return seen


def _between(low: _Floats, high: _Floats) -> Tuple[_Integers, _Integers]:
    """Return the first pixel whose middle is in each interval, and the number of them; none where low > high."""
    first = np.ceil(low - 0.5).astype(np.int64)
    return first, np.maximum(np.floor(high - 0.5).astype(np.int64) - first + 1, 0)


def _spread(first: _Integers, counts: _Integers) -> Iterator[Tuple[_Integers, _Integers]]:
    """Yield, some at a time, the index of each interval as often as it has pixels, and these pixels."""
    before = np.concatenate([[0], np.cumsum(counts)])
    begin = 0
    while begin < len(counts):
        end = max(begin + 1, int(np.searchsorted(before, before[begin] + _MOST, side="right")) - 1)
        index = np.repeat(np.arange(begin, end), counts[begin:end])
        yield index, first[index] + np.arange(before[begin], before[end]) - before[index]
        begin = end


def _covered(corners: _Floats) -> Iterator[Tuple[_Integers, _Integers, _Floats]]:
    """Yield triangles, pixels whose middles they cover, and the depths there."""
    a, u, v = corners[:, 0], corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0]
    area = u[:, 0] * v[:, 1] - u[:, 1] * v[:, 0]
    for triangle, row in _spread(*_between(corners[:, :, 1].min(axis=1), corners[:, :, 1].max(axis=1))):
        y = row + 0.5
        left, right = np.full(len(row), np.inf), np.full(len(row), -np.inf)
        for k in range(3):  # where the row crosses a side
            p, q = corners[triangle, k], corners[triangle, k - 1]
            rise = q[:, 1] - p[:, 1]
            share = (y - p[:, 1]) / np.where(rise == 0, np.nan, rise)
            x = np.where((share >= 0) & (share <= 1), p[:, 0] + share * (q[:, 0] - p[:, 0]), np.nan)
            left, right = np.fmin(left, x), np.fmax(right, x)
        met = left <= right
        for span, column in _spread(*_between(np.where(met, left, 1), np.where(met, right, 0))):
            t = triangle[span]
            dx, dy = column + 0.5 - a[t, 0], y[span] - a[t, 1]
            flat = np.where(area[t] == 0, np.nan, area[t])  # such triangles are lines
            depth = a[t, 2] + ((dx * v[t, 1] - dy * v[t, 0]) * u[t, 2] + (u[t, 0] * dy - u[t, 1] * dx) * v[t, 2]) / flat
            known = np.isfinite(depth)
            yield t[known], (row[span] * _WIDTH + column)[known], depth[known]


def _drawn(corners: _Floats, groups: _Integers) -> npt.NDArray[np.uint8]:
    """Return the picture's rows of red, green, blue and opacity."""
    nearest, seen = np.full(_WIDTH * _HEIGHT, np.inf), np.full(_WIDTH * _HEIGHT, -1)
    for triangle, pixel, depth in _covered(corners):
        order = np.lexsort((depth, pixel))
        first = order[np.flatnonzero(np.diff(pixel[order], prepend=-1))]
        first = first[depth[first] < nearest[pixel[first]]]
        nearest[pixel[first]], seen[pixel[first]] = depth[first], triangle[first]
    normals = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    lengths = np.linalg.norm(normals, axis=1)
    light = 0.7 + 0.3 * np.abs(normals @ np.array([0.35, -0.8, 0.49])) / np.where(lengths > 0, lengths, 1)
    colours = _SHADES[groups % len(_COLOURS)] * light[:, None] + 38 * (1 - light[:, None])
    image = np.zeros((_HEIGHT * _WIDTH, 4))
    image[seen >= 0] = np.column_stack([colours, np.full(len(colours), 255.0)])[seen[seen >= 0]]
    # A dark line where one group ends before another one.
    group = np.where(seen >= 0, groups[seen], -1).reshape(_HEIGHT, _WIDTH)
    edge = np.zeros(group.shape, dtype=bool)
    edge[:, 1:] |= group[:, 1:] != group[:, :-1]
    edge[1:] |= group[1:] != group[:-1]
    image[edge.ravel() & (seen >= 0), :3] *= 0.55
    return image.reshape(_HEIGHT, _WIDTH, 4).astype(np.uint8)


def _png(image: npt.NDArray[np.uint8]) -> bytes:
    def chunk(name: bytes, data: bytes) -> bytes:
        return struct.pack(">I", len(data)) + name + data + struct.pack(">I", zlib.crc32(name + data))

    rows = b"".join(b"\0" + row.tobytes() for row in image)
    header = struct.pack(">IIBBBBB", image.shape[1], image.shape[0], 8, 6, 0, 0, 0)
    return b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", header) + chunk(b"IDAT", zlib.compress(rows, 6)) + chunk(b"IEND", b"")


def picture(vertices: Any, triangles: Any, groups: Any = None) -> str:
    """Return an image element that shows all triangles whose vertices are finite, with a colour per group; "" for none."""
    v, t = np.asarray(vertices, dtype=np.float64).reshape(-1, 3), np.asarray(triangles).astype(np.int64).reshape(-1, 3)
    kept = np.all(np.isfinite(v), axis=1)[t].all(axis=1)
    if not kept.any():
        return ""
    g = np.zeros(len(t), dtype=np.int64) if groups is None else np.asarray(groups).astype(np.int64)
    used, corners = np.unique(t[kept], return_inverse=True)
    with np.errstate(all="ignore"):
        image = _drawn(_projected(v[used])[corners.reshape(-1, 3)], g[kept])
    data = base64.b64encode(_png(image)).decode()
    return f'<img width="{_WIDTH // 2}" height="{_HEIGHT // 2}" alt="" src="data:image/png;base64,{data}">'


def apart(vertices: _Floats, triangles: Any, sides: Any) -> Tuple[_Floats, _Integers, _Integers]:
    """Return the boundaries of blocks pulled apart: vertices, triangles, and the block of each; `sides` as `Volumes.of_sides`."""
    t, b = np.asarray(triangles).astype(np.int64), np.asarray(sides).astype(np.int64)
    between = b[:, 0] != b[:, 1]
    sided = [between & (b[:, k] > 0) for k in (0, 1)]
    corners = np.concatenate([t[sided[0]], t[sided[1]]])
    of = np.concatenate([b[sided[0], 0], b[sided[1], 1]])
    points = np.asarray(vertices, dtype=np.float64)[corners]
    low, high = np.full((b.max(initial=0) + 1, 3), np.inf), np.full((b.max(initial=0) + 1, 3), -np.inf)
    np.minimum.at(low, of, points.min(axis=1))
    np.maximum.at(high, of, points.max(axis=1))
    if len(of) > 0:
        middle = (points.min(axis=(0, 1)) + points.max(axis=(0, 1))) / 2
        points += _APART * ((low[of] + high[of]) / 2 - middle)[:, None]
    return points.reshape(-1, 3), np.arange(3 * len(of)).reshape(-1, 3), of


def unlike_neighbours(sides: Any) -> _Integers:
    """Return a colour of each block, other than those of blocks that it touches as far as there are enough."""
    pairs = np.unique(np.asarray(sides).astype(np.int64), axis=0)
    pairs = pairs[(pairs > 0).all(axis=1) & (pairs[:, 0] != pairs[:, 1])]
    colours = np.zeros(np.asarray(sides).max(initial=0) + 1, dtype=np.int64)
    beside: Dict[int, Set[int]] = {}
    for one, other in pairs.tolist():
        beside.setdefault(one, set()).add(other)
        beside.setdefault(other, set()).add(one)
    for block in range(1, len(colours)):
        taken = {int(colours[n]) for n in beside.get(block, ()) if n < block}
        colours[block] = next((c for k in range(len(_COLOURS)) if (c := (block - 1 + k) % len(_COLOURS)) not in taken),
                              (block - 1) % len(_COLOURS))
    return colours


def _cells(name: Any, value: Any, colour: str = "") -> str:
    mark = f'<span style="color:{colour}">&#9632;</span> ' if colour else ""
    return f"<tr><td>{mark}{html.escape(str(name))}</td><td>{html.escape(str(value))}</td></tr>"


def card(title: str, numbers: Dict[str, Any], vertices: Any, triangles: Any, groups: Any = None,
         legend: Sequence[Tuple[str, Any, int]] = ()) -> str:
    """Return HTML with a title, a table of numbers, and a picture; an entry of `legend` is a name, a value and a group."""
    most = 12
    rows = "".join(_cells(k, v) for k, v in numbers.items())
    rows += "".join(_cells(name, value, _COLOURS[group % len(_COLOURS)]) for name, value, group in legend[:most])
    if len(legend) > most:
        rows += _cells(f"and {len(legend) - most} more", "")
    return (f'<div style="display:flex;gap:1em;align-items:center">'
            f"<div>{picture(vertices, triangles, groups)}</div>"
            f"<div><strong>{html.escape(title)}</strong><table>{rows}</table></div></div>")
