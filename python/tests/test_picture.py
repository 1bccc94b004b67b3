# SPDX-License-Identifier: LGPL-3.0-or-later
"""Pictures of results in notebooks: what they show, pixel by pixel."""

import base64
import re
import struct
import zlib

import numpy as np
import pytest

import terrane
from terrane._picture import apart, picture, unlike_neighbours


def pixels(text):
    """Decode the picture of a page: rows of red, green, blue, opacity. The filter of each row must be none."""
    data = base64.b64decode(re.search('base64,([^"]+)"', text).group(1))
    assert data[:8] == b"\x89PNG\r\n\x1a\n"
    at, packed = 8, b""
    while at < len(data):
        size, name = struct.unpack(">I4s", data[at:at + 8])
        body = data[at + 8:at + 8 + size]
        assert struct.unpack(">I", data[at + 8 + size:at + 12 + size]) == (zlib.crc32(name + body),)
        if name == b"IHDR":
            width, height, depth, colours = struct.unpack(">IIBB", body[:10])
            assert (depth, colours) == (8, 6)
        packed += body if name == b"IDAT" else b""
        at += 12 + size
    rows = np.frombuffer(zlib.decompress(packed), np.uint8).reshape(height, 1 + 4 * width)
    assert not rows[:, 0].any()
    return rows[:, 1:].reshape(height, width, 4).astype(int)


def plane(n, height=0.0):
    """A square sheet of 2 n^2 triangles."""
    x, y = np.meshgrid(np.linspace(0, 1, n + 1), np.linspace(0, 1, n + 1))
    corner = (np.arange(n)[:, None] * (n + 1) + np.arange(n)).ravel()
    triangles = np.concatenate([np.stack([corner, corner + 1, corner + n + 2], 1),
                                np.stack([corner, corner + n + 2, corner + n + 1], 1)])
    return np.column_stack([x.ravel(), y.ravel(), np.full(x.size, height)]), triangles


def test_no_triangle_is_left_out():
    """A sheet looks the same however finely it is divided."""
    coarse, fine = pixels(picture(*plane(1))), pixels(picture(*plane(400)))
    assert (coarse[:, :, 3] > 0).sum() > 30_000
    assert (np.abs(coarse - fine).max(axis=2) > 2).sum() < 20  # pixels whose middle is on the border


def test_pixels_are_the_same_however_many_are_held(monkeypatch):
    whole = pixels(picture(*plane(20)))
    monkeypatch.setattr("terrane._picture._MOST", 999)
    assert np.array_equal(whole, pixels(picture(*plane(20))))


def test_sides_of_a_box_have_shades_of_their_own():
    mesh = terrane.mesh(terrane.box((0, 0, 0), (1, 1, 1)))
    image = pixels(picture(mesh.vertices, mesh.triangles))
    colours, count = np.unique(image.reshape(-1, 4), axis=0, return_counts=True)
    assert (count[colours[:, 3] > 0] > 2000).sum() == 3


def test_near_triangles_hide_far_ones():
    vertices, triangles = plane(3)
    above = vertices + [0, 0, 0.2]
    for first, second in ((vertices, above), (above, vertices)):
        both = pixels(picture(np.concatenate([first, second]), np.concatenate([triangles, triangles + len(vertices)]),
                              np.repeat([0, 1], len(triangles))))
        row, column = np.argwhere(both[:, :, 3] > 0).mean(axis=0).astype(int)  # both sheets are there
        shade = both[row, column]
        assert (shade[2] > shade[0]) == (first is above), "the first sheet is blue, the second red"


def test_triangles_that_cross_hide_each_other_in_part():
    vertices = np.array([[0, 0, 0], [1, 0, 0], [1, 1, 1], [0, 1, 1], [0, 0, 1], [1, 0, 1], [1, 1, 0], [0, 1, 0.0]])
    image = pixels(picture(vertices, [[0, 1, 2], [0, 2, 3], [4, 5, 6], [4, 6, 7]], [0, 0, 1, 1]))
    blue = (image[:, :, 2] > image[:, :, 0] + 20).sum()
    red = (image[:, :, 0] > image[:, :, 2] + 20).sum()
    assert blue > 5000 and red > 5000


def test_a_mesh_of_many_triangles_is_no_longer_text_than_others():
    vertices, triangles = plane(300)
    assert len(picture(vertices, triangles)) < 200_000


@pytest.mark.parametrize("scale", [0, 5e-324, 1e-300, 1, 1e300, 1.7e308])
def test_any_size_is_drawn(scale):
    vertices, triangles = plane(2)
    pixels(picture((vertices - 0.5) * 2 * scale, triangles))
    pixels(picture((vertices - 0.5) * [scale, 1, 1e-3], triangles))


def test_lines_points_and_what_is_not_finite():
    random = np.random.default_rng(3)
    for k in range(200):
        vertices = random.choice([0, 1, 2.5, -3, 1e9, 1e-9], (6, 3))
        if k % 3 == 0:
            vertices[random.integers(6)] = random.choice([np.nan, np.inf, -np.inf])
        text = picture(vertices, random.integers(0, 6, (8, 3)), random.integers(0, 99, 8))
        if text:
            pixels(text)


def test_blocks_are_apart_and_unlike():
    boxes = [terrane.box((i, j, 0), (i + 1, j + 1, 1)) for i in range(3) for j in range(3)]
    with pytest.warns(terrane.Doubt):
        model = terrane.model([s for box in boxes for s in box])
    sides = model.volumes.of_sides
    vertices, triangles, of = apart(model.mesh.vertices, model.mesh.triangles, sides)
    assert len(set(of)) == 9
    low = np.array([vertices[triangles[of == b]].min(axis=(0, 1)) for b in range(1, 10)])
    high = np.array([vertices[triangles[of == b]].max(axis=(0, 1)) for b in range(1, 10)])
    assert np.allclose(high - low, 1)  # moved, not changed
    for a in range(9):
        for b in range(a):
            assert ((low[a] > high[b] + 0.2) | (low[b] > high[a] + 0.2)).any()
    colours = unlike_neighbours(sides)
    assert all(colours[a] != colours[b] for a, b in sides if a > 0 and b > 0 and a != b)


def test_legends_name_what_is_seen():
    model = terrane.model(terrane.box((0, 0, 0), (1, 1, 1)))
    (name,) = model.blocks
    assert f"</span> {name}</td><td>1</td>" in model._repr_html_()
    sheet = terrane.Surface(*plane(1), "<top>")
    assert "</span> &lt;top&gt;</td>" in terrane.mesh([sheet])._repr_html_()
    many = terrane.mesh([sheet.replace(name=f"s{i}") for i in range(20)])._repr_html_()
    assert "</span> s11</td>" in many and "s12" not in many and "and 8 more" in many
