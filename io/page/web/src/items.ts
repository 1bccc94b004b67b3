// SPDX-License-Identifier: LGPL-3.0-or-later
//
// What the view draws, and from how far away it must be seen.
import { Vector3, type BufferGeometry, type Color, type LineSegments, type Mesh, type MeshLambertMaterial } from "three";
import type { Axis, Cut } from "./caps";
import type { Content, Part } from "./data";

/** A surface or block as it is drawn. */
export interface Item {
  kind: "surface" | "block";
  number: number;
  filled: boolean; ///< of a surface: the triangles that fill its holes
  name: string;
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
/** The area of a block, or of a surface as far as it is drawn as this item, before decimation. */
export function areaOf(item: Item, content: Content): number {
  const own = (part: Part) => item.kind === "block"
    ? part.blocks !== null && part.blocks[0] !== part.blocks[1] && part.blocks.includes(item.number)
    : part.filled === item.filled && part.surfaces.includes(item.number);
  return content.parts.filter(own).reduce((sum, part) => sum + part.area, 0);
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
