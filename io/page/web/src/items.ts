// SPDX-License-Identifier: LGPL-3.0-or-later
//
// What the view draws, and from how far away it must be seen.
import { Vector3, type BufferGeometry, type Color, type LineSegments, type Mesh, type MeshLambertMaterial } from "three";
import type { Axis, Cut } from "./caps";

/** A surface or block as it is drawn, or all those of a kind that are too many to be drawn one by one. */
export interface Item {
  kind: "surface" | "block";
  numbers: number[]; ///< of its surfaces or blocks; the first alone, but for the rest of a kind
  filled: boolean; ///< of a surface: the triangles that fill its holes
  name: string;
  area: number;   ///< as far as it is drawn as this item, before decimation
  volume: number; ///< of blocks
  mesh: Mesh<BufferGeometry, MeshLambertMaterial>;
  geometry: BufferGeometry;      ///< all triangles; the mesh may have fewer while it turns
  coarse: Map<number, BufferGeometry>; ///< fewer triangles by level of `budgets`, made when they are needed
  edges: LineSegments | null;
  cap: Mesh<BufferGeometry, MeshLambertMaterial> | null;
  capEdges: LineSegments | null;
  cut: Cut | null;
  centre: Vector3;
  reach: number;
  visible: boolean;
  colour: Color;
  opacity: number;
  tetrahedra: Uint32Array;
}
export interface Pick { item: Item; place: [number, number, number]; point: Vector3; tetrahedron: number }
export interface Section { axis: Axis; share: number; flipped: boolean }

/** Surfaces, and blocks, that are drawn and listed one by one, the largest; the rest is one item. */
export const mostItems = 1000;

/** Divides the numbers from `first` on into those of items of their own, by size, and the rest. */
export function divided(first: number, sizes: number[], most = mostItems): { own: number[]; rest: number[] } {
  const order = sizes.map((_, i) => i);
  if (sizes.length > most) order.sort((a, b) => sizes[b] - sizes[a] || a - b);
  const numbers = (list: number[]) => list.sort((a, b) => a - b).map((i) => i + first);
  return { own: numbers(order.slice(0, most)), rest: numbers(order.slice(most)) };
}

export type ViewName = "perspective" | "top" | "north" | "east";

const margin = 1.12; ///< round a model that is shown as a whole

/**
 * How far a camera must be to see a box round its target from `direction`, and how high, halved, the
 * picture must be without perspective. `slope` is the tangent of half the field of view.
 */
export function needed(half: Vector3, direction: Vector3, slope: number, aspect: number): { distance: number; height: number } {
  const right = new Vector3(0, 0, 1).cross(direction).normalize();
  const up = direction.clone().cross(right);
  let distance = 0, height = 0;
  for (let corner = 0; corner < 8; ++corner) {
    const p = new Vector3(corner & 1 ? half.x : -half.x, corner & 2 ? half.y : -half.y, corner & 4 ? half.z : -half.z);
    const span = Math.max(Math.abs(p.dot(up)), Math.abs(p.dot(right)) / aspect) * margin;
    distance = Math.max(distance, span / slope + p.dot(direction));
    height = Math.max(height, span);
  }
  return { distance, height };
}
