// SPDX-License-Identifier: LGPL-3.0-or-later
//
// The content of a report: JSON and arrays in one compressed block. io/page/html.cpp and
// io/page/arrays.cpp write it; docs/reference/report.md lists the keys.

export interface ArrayPlace { at: number; count: number; stride: number }
export interface Part {
  surfaces: number[]; blocks: [number, number] | null; first: number; count: number;
  area: number; filled: boolean;
}
export interface Line {
  kind: string; surfaces: number[]; length: number; first: number; count: number;
}
export interface SurfaceInfo {
  label: string; name: string; role: string; file: string | null; triangles: number; area: number;
}
export interface BlockInfo {
  number: number; name: string; unit: string; volume: number; area: number;
  above: string; below: string; beside: string; neighbours: number[];
}
export interface Finding {
  kind: string; text: string; size: number; measure: string;
  place: [number, number, number]; extent: number;
}
export interface Axis { label: string; measure: string }
export interface Plot {
  title: string; x: Axis; y: Axis; bounds?: number[]; names?: string[]; blocks?: number[];
  lines?: { name: string; x: number[]; y: number[]; dots: boolean }[];
  series?: { name: string; values: number[] }[];
}
export type Cell = string | number | boolean | null;
export interface Table { title: string; columns: { title: string; measure: string }[]; rows: Cell[][] }
export interface Content {
  format: string; version: number; terrane: string; command: string; title: string; unit: string;
  verdict: { text: string; good: boolean };
  surfaces: SurfaceInfo[]; blocks: BlockInfo[]; parts: Part[]; lines: Line[];
  findings: { counts: Record<string, number>; list: Finding[] };
  plots: Plot[]; tables: Table[]; statistics: Record<string, unknown>;
  view: {
    origin: [number, number, number]; step: number; triangles: number; drawn: number;
    cell: number; tetrahedra_left_out: number;
  };
  arrays: Record<"vertices" | "triangles" | "segments" | "nodes" | "tetrahedra" | "blocks", ArrayPlace>;
}
export interface RunInfo { seconds: Record<string, number>; peak_rss_mb: number | null; threads: number }

export interface Report {
  content: Content;
  run: RunInfo;
  array(name: keyof Content["arrays"]): Uint32Array;
}

function decodeBase64(text: string): Uint8Array {
  const bytes = new Uint8Array(Math.floor(text.length / 4) * 3 - (text.endsWith("==") ? 2 : text.endsWith("=") ? 1 : 0));
  const step = 1 << 20; // a multiple of 4: whole bytes
  let at = 0;
  for (let i = 0; i < text.length; i += step) {
    const piece = atob(text.slice(i, i + step));
    for (let k = 0; k < piece.length; ++k) bytes[at++] = piece.charCodeAt(k);
  }
  return bytes;
}

/** Undoes Arrays::add: byte planes of differences whose sign is in the lowest bit. */
function unfold(bytes: Uint8Array, place: ArrayPlace): Uint32Array {
  const { at, count, stride } = place;
  const values = new Uint32Array(count);
  for (let i = 0; i < count; ++i) {
    const word = (bytes[at + i] | bytes[at + count + i] << 8 | bytes[at + 2 * count + i] << 16 |
      bytes[at + 3 * count + i] << 24) >>> 0;
    const difference = (word >>> 1) ^ -(word & 1);
    values[i] = difference + (i < stride ? 0 : values[i - stride]);
  }
  return values;
}

/** Reads the report that this page carries. */
export async function readReport(): Promise<Report> {
  const text = (id: string) => document.getElementById(id)?.textContent ?? "";
  const packed = decodeBase64(text("terrane-data"));
  document.getElementById("terrane-data")?.remove(); // megabytes that nobody needs any more
  const stream = new Blob([packed as BlobPart]).stream().pipeThrough(new DecompressionStream("gzip"));
  const bytes = new Uint8Array(await new Response(stream).arrayBuffer());
  const length = new DataView(bytes.buffer).getUint32(0, true);
  const content = JSON.parse(new TextDecoder().decode(bytes.subarray(4, 4 + length))) as Content;
  const arrays = bytes.subarray(4 + length);
  return {
    content,
    run: JSON.parse(text("terrane-run")) as RunInfo,
    array: (name) => unfold(arrays, content.arrays[name]),
  };
}
