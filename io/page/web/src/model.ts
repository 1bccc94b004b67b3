// SPDX-License-Identifier: LGPL-3.0-or-later
//
// The arrays of a report as geometry: one list of vertices, and triangles per surface and block.
// Coordinates are relative to the centre of the model; `origin` brings them back.
import { BufferAttribute, BufferGeometry, Sphere, Vector3 } from "three";
import type { Content, Part, Report } from "./data";

function append<T>(lists: Map<number, T[]>, key: number, value: T): void {
  const list = lists.get(key);
  if (list) list.push(value);
  else lists.set(key, [value]);
}
function areaOf(parts: Part[]): number {
  return parts.reduce((sum, part) => sum + part.area, 0);
}

export class ModelGeometry {
  readonly vertices: Float32Array;
  readonly nodes: Float32Array;
  readonly tetrahedra: Uint32Array;
  readonly origin: [number, number, number]; ///< of the relative coordinates
  readonly half: Vector3;                    ///< half the size of the box round all
  readonly radius: number;
  readonly unit: number; ///< of the relative coordinates, in units of the input: 1 for common sizes
  private readonly triangles: Uint32Array;
  private readonly segments: Uint32Array;
  private readonly blockOf: Uint32Array;
  private readonly position: BufferAttribute;
  private readonly content: Content;
  private readonly partsOfSurface = new Map<number, Part[]>();
  private readonly partsOfBlock = new Map<number, Part[]>(); ///< without parts that dangle in it
  private readonly tetrahedraOfBlock = new Map<number, number[]>();

  constructor(report: Report) {
    this.content = report.content;
    const { origin, step } = this.content.view;
    const packed = { vertices: report.array("vertices"), nodes: report.array("nodes") };
    const size = [0, 0, 0];
    for (const list of [packed.vertices, packed.nodes])
      for (let i = 0; i < list.length; ++i) if (list[i] > size[i % 3]) size[i % 3] = list[i];
    const most = Math.max(...size), extent = most * step;
    this.unit = extent > 1e8 || (extent < 1e-3 && extent > 0) // single precision ends
      ? Math.max(step * (most / 1000), Number.MIN_VALUE) : 1;
    const centre = size.map((s) => Math.round(s / 2));
    const relative = (list: Uint32Array) => {
      const result = new Float32Array(list.length);
      for (let i = 0; i < list.length; ++i) result[i] = (list[i] - centre[i % 3]) * (step / this.unit);
      return result;
    };
    this.origin = [0, 1, 2].map((k) => origin[k] + centre[k] * step) as [number, number, number];
    this.half = new Vector3(...size.map((s) => Math.max(s * (step / this.unit) / 2, 1e-9)));
    this.radius = this.half.length();
    this.vertices = relative(packed.vertices);
    this.nodes = relative(packed.nodes);
    this.triangles = report.array("triangles");
    this.segments = report.array("segments");
    this.tetrahedra = report.array("tetrahedra");
    this.blockOf = report.array("blocks");
    this.position = new BufferAttribute(this.vertices, 3);
    for (const part of this.content.parts) {
      for (const s of part.surfaces) append(this.partsOfSurface, s, part);
      if (part.blocks && part.blocks[0] !== part.blocks[1]) for (const b of part.blocks) append(this.partsOfBlock, b, part);
    }
    this.blockOf.forEach((block, t) => append(this.tetrahedraOfBlock, block, t));
  }

  /** The place of a point in the input's coordinates. */
  toInput(point: Vector3): [number, number, number] {
    return point.toArray().map((c, k) => c * this.unit + this.origin[k]) as [number, number, number];
  }
  private geometry(index: Uint32Array): BufferGeometry {
    const made = new BufferGeometry();
    made.setAttribute("position", this.position);
    made.setIndex(new BufferAttribute(index, 1));
    made.boundingSphere = new Sphere(new Vector3(), this.radius);
    return made;
  }

  /** Returns the triangles of some parts as one index; `turned` ones the other way round. */
  private indexOf(parts: { part: Part; turned: boolean }[]): Uint32Array {
    const total = parts.reduce((sum, p) => sum + p.part.count, 0);
    const index = new Uint32Array(3 * total);
    let at = 0;
    for (const { part, turned } of parts) {
      const of = this.triangles.subarray(3 * part.first, 3 * (part.first + part.count));
      index.set(of, at);
      if (turned)
        for (let i = at; i < at + of.length; i += 3) [index[i + 1], index[i + 2]] = [index[i + 2], index[i + 1]];
      at += of.length;
    }
    return index;
  }

  /** Surfaces, with their filled holes or without them; null if there are none. */
  surfaces(numbers: number[], filled: boolean): { geometry: BufferGeometry; area: number } | null {
    const parts = [...new Set(numbers.flatMap((s) => this.partsOfSurface.get(s) ?? []))].filter((p) => p.filled === filled);
    if (parts.length === 0) return null;
    return { geometry: this.geometry(this.indexOf(parts.map((part) => ({ part, turned: false })))), area: areaOf(parts) };
  }
  areaOfSurface(number: number): number {
    return areaOf(this.partsOfSurface.get(number) ?? []);
  }

  /** The closed boundaries of blocks, front side out. */
  blocks(numbers: number[]): { geometry: BufferGeometry; area: number } {
    const parts = numbers.flatMap((b) => (this.partsOfBlock.get(b) ?? []).map((part) => ({ part, turned: part.blocks![0] === b })));
    return { geometry: this.geometry(this.indexOf(parts)), area: areaOf(parts.map(({ part }) => part)) };
  }

  tetrahedraOf(blocks: number[]): Uint32Array {
    return Uint32Array.from(blocks.flatMap((b) => this.tetrahedraOfBlock.get(b) ?? []));
  }

  /** The ends of all segments of a kind of line, three coordinates each. */
  segmentsOf(kind: string): Float32Array {
    const lines = this.content.lines.filter((line) => line.kind === kind);
    const points = new Float32Array(6 * lines.reduce((sum, line) => sum + line.count, 0));
    let at = 0;
    for (const line of lines)
      for (let i = 2 * line.first; i < 2 * (line.first + line.count); ++i) {
        points.set(this.vertices.subarray(3 * this.segments[i], 3 * this.segments[i] + 3), at);
        at += 3;
      }
    return points;
  }

  private readonly clusters = new Map<number, Uint32Array>();

  /** The triangles that are left when the vertices in each cell of a grid are joined; `cell` is in units of the input. */
  coarse(geometry: BufferGeometry, cell: number): BufferGeometry {
    const first = this.clusters.get(cell) ?? this.firstInCell(cell / this.unit);
    this.clusters.set(cell, first);
    const index = geometry.index!.array as Uint32Array;
    const kept = new Uint32Array(index.length);
    let at = 0;
    for (let t = 0; t < index.length; t += 3) {
      const a = first[index[t]], b = first[index[t + 1]], c = first[index[t + 2]];
      if (a === b || b === c || c === a) continue;
      kept[at++] = a;
      kept[at++] = b;
      kept[at++] = c;
    }
    return this.geometry(kept.slice(0, at));
  }
  private firstInCell(cell: number): Uint32Array {
    const seen = new Map<number, number>(), count = this.vertices.length / 3;
    const result = new Uint32Array(count);
    const along = (v: number, k: number) => Math.floor((this.vertices[3 * v + k] + this.half.getComponent(k)) / cell);
    for (let v = 0; v < count; ++v) {
      const key = (along(v, 0) * 65536 + along(v, 1)) * 65536 + along(v, 2);
      const known = seen.get(key);
      if (known === undefined) seen.set(key, v);
      result[v] = known ?? v;
    }
    return result;
  }

  /** The edges of an index, each once where there are not too many to sort out. */
  edges(geometry: BufferGeometry): BufferGeometry {
    const index = geometry.index!.array as Uint32Array;
    const count = this.vertices.length / 3;
    const seen = index.length < 1_500_000 ? new Set<number>() : null;
    const pairs = new Uint32Array(2 * index.length);
    let at = 0;
    for (let t = 0; t < index.length; t += 3)
      for (let k = 0; k < 3; ++k) {
        const a = index[t + k], b = index[t + (k + 1) % 3];
        if (seen) {
          const key = a < b ? a * count + b : b * count + a;
          if (seen.has(key)) continue;
          seen.add(key);
        }
        pairs[at++] = a;
        pairs[at++] = b;
      }
    return this.geometry(pairs.slice(0, at));
  }

  /** The mean of a geometry's corners. */
  centre(geometry: BufferGeometry): Vector3 {
    const index = geometry.index!.array as Uint32Array;
    const sum = new Vector3();
    for (const v of index) {
      sum.x += this.vertices[3 * v]; sum.y += this.vertices[3 * v + 1]; sum.z += this.vertices[3 * v + 2];
    }
    return index.length ? sum.divideScalar(index.length) : sum;
  }

  /** Half the diagonal of the box round a geometry. */
  reach(geometry: BufferGeometry, centre: Vector3): number {
    let most = 0;
    for (const v of geometry.index!.array as Uint32Array)
      most = Math.max(most, (this.vertices[3 * v] - centre.x) ** 2 + (this.vertices[3 * v + 1] - centre.y) ** 2 +
        (this.vertices[3 * v + 2] - centre.z) ** 2);
    return Math.sqrt(most);
  }
}
