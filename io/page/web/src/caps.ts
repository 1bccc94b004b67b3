// SPDX-License-Identifier: LGPL-3.0-or-later
//
// What a plane across an axis cuts out of a block: of its tetrahedra, or of its closed boundary.

export type Axis = 0 | 1 | 2;

/** Triangles of a cut, three coordinates per corner, and the edges to draw on it. */
export interface Cut { triangles: number[]; edges: number[]; area: number; owners: number[] }

/** Cuts the tetrahedra `chosen`. `owners` has the tetrahedron of each triangle. */
export function cutTetrahedra(nodes: Float32Array, tetrahedra: Uint32Array, chosen: Uint32Array,
  axis: Axis, at: number): Cut {
  const cut: Cut = { triangles: [], edges: [], area: 0, owners: [] };
  const point = [0, 0, 0];
  const corners: number[][] = [];
  const cross = (a: number, b: number) => {
    const share = (at - nodes[3 * a + axis]) / (nodes[3 * b + axis] - nodes[3 * a + axis]);
    for (let k = 0; k < 3; ++k) point[k] = nodes[3 * a + k] + share * (nodes[3 * b + k] - nodes[3 * a + k]);
    point[axis] = at;
    corners.push([point[0], point[1], point[2]]);
  };
  for (const t of chosen) {
    const below: number[] = [], above: number[] = [];
    for (let k = 0; k < 4; ++k) {
      const v = tetrahedra[4 * t + k];
      (nodes[3 * v + axis] < at ? below : above).push(v);
    }
    if (below.length === 0 || above.length === 0) continue;
    corners.length = 0;
    if (below.length === 2) { // a quadrilateral, in the order of its sides
      cross(below[0], above[0]); cross(below[0], above[1]);
      cross(below[1], above[1]); cross(below[1], above[0]);
    } else {
      const [one, three] = below.length === 1 ? [below[0], above] : [above[0], below];
      for (const v of three) cross(one, v);
    }
    for (let k = 0; k < corners.length; ++k) cut.edges.push(...corners[k], ...corners[(k + 1) % corners.length]);
    for (let k = 2; k < corners.length; ++k) {
      cut.triangles.push(...corners[0], ...corners[k - 1], ...corners[k]);
      cut.area += areaOf(corners[0], corners[k - 1], corners[k], axis);
      cut.owners.push(t);
    }
  }
  return cut;
}

function areaOf(a: number[], b: number[], c: number[], axis: Axis): number {
  const u = (axis + 1) % 3, v = (axis + 2) % 3;
  return Math.abs((b[u] - a[u]) * (c[v] - a[v]) - (b[v] - a[v]) * (c[u] - a[u])) / 2;
}

/** Most rows in which the inside of a closed boundary is filled. */
const mostRows = 3000;

/**
 * Cuts a closed boundary. Its triangles leave segments in the plane; what lies between an odd and an
 * even one, along each row, is inside. Rows end where segments end, so that the outline is met.
 */
export function cutBoundary(vertices: Float32Array, index: Uint32Array, axis: Axis, at: number): Cut {
  const u = (axis + 1) % 3, v = (axis + 2) % 3;
  const cut: Cut = { triangles: [], edges: [], area: 0, owners: [] };
  const segments: number[][] = []; // u0 v0 u1 v1, v0 < v1
  for (let t = 0; t < index.length; t += 3) {
    const ends: number[] = [];
    for (let k = 0; k < 3; ++k) {
      const a = index[t + k], b = index[t + (k + 1) % 3];
      const p = vertices[3 * a + axis], q = vertices[3 * b + axis];
      if ((p < at) === (q < at)) continue;
      const [low, high] = a < b ? [a, b] : [b, a]; // both triangles of an edge get the same point
      const share = (at - vertices[3 * low + axis]) / (vertices[3 * high + axis] - vertices[3 * low + axis]);
      for (const w of [u, v]) ends.push(vertices[3 * low + w] + share * (vertices[3 * high + w] - vertices[3 * low + w]));
    }
    if (ends.length !== 4) continue;
    pushPoint(cut.edges, axis, at, ends[0], ends[1]);
    pushPoint(cut.edges, axis, at, ends[2], ends[3]);
    if (ends[1] !== ends[3])
      segments.push(ends[1] < ends[3] ? ends : [ends[2], ends[3], ends[0], ends[1]]);
  }
  let rows = [...new Set(segments.flatMap((s) => [s[1], s[3]]))].sort((a, b) => a - b);
  if (rows.length > mostRows) {
    const first = rows[0], last = rows[rows.length - 1];
    rows = Array.from({ length: mostRows + 1 }, (_, i) => first + (last - first) * i / mostRows);
  }
  fillRows(cut, segments, rows, axis, at);
  return cut;
}

function pushPoint(list: number[], axis: Axis, at: number, pu: number, pv: number): void {
  const point = [0, 0, 0];
  point[axis] = at;
  point[(axis + 1) % 3] = pu;
  point[(axis + 2) % 3] = pv;
  list.push(point[0], point[1], point[2]);
}

function fillRows(cut: Cut, segments: number[][], rows: number[], axis: Axis, at: number): void {
  segments.sort((a, b) => a[1] - b[1]);
  let next = 0;
  let active: number[][] = [];
  const along = (s: number[], row: number) => s[0] + (s[2] - s[0]) * (row - s[1]) / (s[3] - s[1]);
  for (let r = 0; r + 1 < rows.length; ++r) {
    const low = rows[r], high = rows[r + 1], middle = (low + high) / 2;
    while (next < segments.length && segments[next][1] <= middle) active.push(segments[next++]);
    active = active.filter((s) => s[3] > middle);
    const order = active.map((s) => ({ s, key: along(s, middle) })).sort((a, b) => a.key - b.key);
    for (let i = 0; i + 1 < order.length; i += 2) {
      const left = order[i].s, right = order[i + 1].s;
      const clamp = (s: number[], row: number) => along(s, Math.min(Math.max(row, s[1]), s[3]));
      const corners = [[clamp(left, low), low], [clamp(right, low), low], [clamp(right, high), high], [clamp(left, high), high]];
      for (const k of [0, 1, 2, 0, 2, 3]) pushPoint(cut.triangles, axis, at, corners[k][0], corners[k][1]);
      cut.area += (order[i + 1].key - order[i].key) * (high - low);
      cut.owners.push(-1, -1);
    }
  }
}
