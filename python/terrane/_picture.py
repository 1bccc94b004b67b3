# SPDX-License-Identifier: LGPL-3.0-or-later
"""Small pictures of surfaces as SVG, for notebooks."""

from __future__ import annotations

import html
from typing import Any, Dict, List

import numpy as np
import numpy.typing as npt

_MOST = 1500  # triangles drawn: a picture is about 100 kB then
_WIDTH, _HEIGHT = 240.0, 170.0
_COLOURS = ("#4878a8", "#c8553d", "#588b5b", "#b08830", "#7d5a9e", "#3d8f95", "#a0606e", "#6b7280")


def _projected(vertices: npt.NDArray[np.float64]) -> npt.NDArray[np.float64]:
    """Return x, y of the picture and the depth, seen from the south-east and above."""
    centre = (vertices.min(axis=0) + vertices.max(axis=0)) / 2
    p = vertices - centre
    spread = np.ptp(p, axis=0)
    if spread[2] > 0:  # heights are stretched where a model is flat
        p = p * np.array([1.0, 1.0, max(1.0, 0.35 * max(spread[0], spread[1]) / spread[2])])
    a, b = np.radians(-30), np.radians(28)
    x = np.cos(a) * p[:, 0] - np.sin(a) * p[:, 1]
    far = np.sin(a) * p[:, 0] + np.cos(a) * p[:, 1]
    y = np.sin(b) * far + np.cos(b) * p[:, 2]
    depth = np.cos(b) * far - np.sin(b) * p[:, 2]
    return np.stack([x, y, depth], axis=1)


def _shade(colour: str, light: float) -> str:
    channels = [int(colour[i:i + 2], 16) for i in (1, 3, 5)]
    return "#" + "".join(f"{int(c * light + 255 * (1 - light) * 0.15):02x}" for c in channels)


def picture(vertices: Any, triangles: Any, groups: Any = None) -> str:
    """Return an SVG of triangles, far ones first; `groups` chooses their colours.

    At most 1500 triangles are drawn, evenly chosen; vertices that are not finite are left out.
    """
    v, t = np.asarray(vertices, dtype=np.float64), np.asarray(triangles)
    head = f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {_WIDTH:g} {_HEIGHT:g}" width="{_WIDTH:g}">'
    if len(t) > 0:
        finite = np.all(np.isfinite(v), axis=1)
        t_kept = np.flatnonzero(np.all(finite[t], axis=1))
        t_kept = t_kept[::max(1, -(-len(t_kept) // _MOST))]
    if len(t) == 0 or len(t_kept) == 0:
        return head + '<text x="8" y="20" font-size="12">no triangles</text></svg>'
    g = np.zeros(len(t), dtype=np.int64) if groups is None else np.asarray(groups).astype(np.int64)
    used = np.unique(t[t_kept])
    number = np.zeros(len(v), dtype=np.int64)
    number[used] = np.arange(len(used))
    p, t, g = _projected(v[used]), number[t[t_kept].astype(np.int64)], g[t_kept]
    low, size = p[:, :2].min(axis=0), np.ptp(p[:, :2], axis=0)
    scale = min((_WIDTH - 12) / max(size[0], 1e-300), (_HEIGHT - 12) / max(size[1], 1e-300))
    xy = (p[:, :2] - low) * scale + 6
    corners = p[t]
    normals = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    lengths = np.linalg.norm(normals, axis=1)
    light = 0.55 + 0.45 * np.abs(normals[:, 2]) / np.where(lengths > 0, lengths, 1)
    shapes: List[str] = []
    for i in np.argsort(-corners[:, :, 2].mean(axis=1)):
        path = " ".join(f"{xy[k, 0]:.1f},{_HEIGHT - xy[k, 1]:.1f}" for k in t[i])
        fill = _shade(_COLOURS[int(g[i]) % len(_COLOURS)], float(light[i]))
        shapes.append(f'<polygon points="{path}" fill="{fill}" stroke="{fill}" stroke-width="0.3"/>')
    return head + "".join(shapes) + "</svg>"


def card(title: str, numbers: Dict[str, Any], vertices: Any, triangles: Any, groups: Any = None) -> str:
    """Return HTML with a title, a table of numbers and a picture."""
    rows = "".join(f"<tr><td>{html.escape(str(k))}</td><td>{html.escape(str(v))}</td></tr>"
                   for k, v in numbers.items())
    return (f'<div style="display:flex;gap:1em;align-items:center">'
            f"<div>{picture(vertices, triangles, groups)}</div>"
            f"<div><strong>{html.escape(title)}</strong><table>{rows}</table></div></div>")
