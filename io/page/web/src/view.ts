// SPDX-License-Identifier: LGPL-3.0-or-later
//
// The three-dimensional view. It draws only when something has changed.
import {
  AmbientLight, BufferAttribute, BufferGeometry, Color, DirectionalLight, DoubleSide, FrontSide, Group,
  LineBasicMaterial, LineSegments, Mesh, MeshBasicMaterial, MeshLambertMaterial, Plane, Raycaster, Scene,
  SphereGeometry, Vector2, Vector3, WebGLRenderer,
} from "three";
import { LineMaterial } from "three/examples/jsm/lines/LineMaterial.js";
import { LineSegments2 } from "three/examples/jsm/lines/LineSegments2.js";
import { LineSegmentsGeometry } from "three/examples/jsm/lines/LineSegmentsGeometry.js";
import { cutBoundary, cutTetrahedra } from "./caps";
import { colourOf, colourOfRole, lineColours } from "./colours";
import type { Report } from "./data";
import { divided, type Item, type Pick, type Section, type ViewName } from "./items";
import { ModelGeometry } from "./model";
import { budgets, Pace } from "./pace";
import { Viewpoint, type Bounds } from "./viewpoint";

export type { Item, Pick, ViewName };

const edgeOpacity = 0.28;

/** The lines of a kind: wide ones, and thin ones that cost little while the view moves. */
interface Lines { kind: string; object: LineSegments2; thin: LineSegments<BufferGeometry, LineBasicMaterial>; wanted: boolean }

const colourOfRest = new Color("#9aa3ad");
function moreOf(numbers: number[], what: string): string {
  return `${numbers.length.toLocaleString("en")} more ${what}`;
}

export class View {
  readonly model: ModelGeometry;
  readonly items: Item[] = [];
  readonly lines: Lines[] = [];
  readonly renderer: WebGLRenderer;
  readonly viewpoint: Viewpoint;
  readonly pace: Pace;
  section: Section | null = null;
  exploded = 0;
  exaggeration = 1;
  frames = 0;
  onFrame: () => void = () => {};
  private readonly scene = new Scene();
  private readonly root = new Group();
  private readonly plane = new Plane(new Vector3(-1, 0, 0), 0);
  private readonly sun = new DirectionalLight(0xffffff, 1.9);
  private readonly markers = new Group();
  private readonly cells = new Map<number, number>(); ///< edges of the cells in which vertices are joined, by level
  private edgesShown = false;
  private pending = 0; ///< the request for the next picture; 0: none

  constructor(private readonly place: HTMLElement, readonly report: Report) {
    this.model = new ModelGeometry(report);
    this.renderer = new WebGLRenderer({ antialias: true, preserveDrawingBuffer: true });
    this.renderer.localClippingEnabled = true;
    this.renderer.setPixelRatio(Math.min(window.devicePixelRatio, 2));
    this.pace = new Pace(this.renderer.getContext() as WebGL2RenderingContext, (level) => this.setLevel(level));
    place.prepend(this.renderer.domElement);
    this.viewpoint = new Viewpoint(place, this.renderer.domElement, () => this.bounds(), () => this.draw());
    this.controls.addEventListener("change", () => {
      if (!this.viewpoint.jumps) this.pace.moved();
      this.draw();
    });
    this.scene.add(this.root, this.sun, this.sun.target, new AmbientLight(0xffffff, 1.35));
    this.root.add(this.markers);
    this.addItems();
    this.addLines();
    this.setTheme();
    this.exaggerate(this.defaultExaggeration());
    new ResizeObserver(() => this.resize()).observe(place);
    this.resize();
    this.look("perspective");
  }

  /** Flat models, as most are, are stretched so that they can be seen. */
  private defaultExaggeration(): number {
    const { x, y, z } = this.model.half;
    const flat = Math.max(x, y) / Math.max(z, 1e-12);
    return flat > 12 && flat < 1000 ? Math.min(10, Math.round(flat / 6)) : 1;
  }

  private addItems(): void {
    const { surfaces, blocks } = this.report.content;
    const { x, y, z } = this.model.half;
    const filled = blocks.reduce((sum, b) => sum + b.volume / this.model.unit ** 3, 0) / (8 * x * y * z);
    const hasBlocks = filled > 0.15; // else blocks are accidents between surfaces
    const ofSurfaces = divided(0, surfaces.map((_, s) => this.model.areaOfSurface(s)));
    for (const s of ofSurfaces.own) this.addSurfaces([s], surfaces[s].label, colourOfRole(surfaces[s].role, s), !hasBlocks && surfaces[s].role !== "boundary");
    if (ofSurfaces.rest.length) this.addSurfaces(ofSurfaces.rest, moreOf(ofSurfaces.rest, "surfaces"), colourOfRest, !hasBlocks);
    const ofBlocks = divided(1, blocks.map((b) => b.volume));
    for (const b of ofBlocks.own) this.addBlocks([b], blocks[b - 1].name, colourOf(b - 1), hasBlocks);
    if (ofBlocks.rest.length) this.addBlocks(ofBlocks.rest, moreOf(ofBlocks.rest, "blocks"), colourOfRest, hasBlocks);
    if (!this.items.some((i) => i.visible)) for (const item of this.items) item.visible = true;
    for (const item of this.items) item.mesh.visible = item.visible;
    if (!hasBlocks) this.items.filter((i) => this.isLid(i)).forEach((i) => this.setOpacity(i, 0.45));
  }

  private addSurfaces(numbers: number[], label: string, own: Color, visible: boolean): void {
    for (const filled of [false, true]) {
      const drawn = this.model.surfaces(numbers, filled);
      if (drawn) this.addItem({ kind: "surface", numbers, filled, name: filled ? `${label}: filled` : label, ...drawn, volume: 0 },
        filled ? new Color("#e0763a") : own, visible);
    }
  }
  private addBlocks(numbers: number[], name: string, colour: Color, visible: boolean): void {
    const drawn = this.model.blocks(numbers);
    const volume = numbers.reduce((sum, b) => sum + this.report.content.blocks[b - 1].volume, 0);
    if (drawn.geometry.index!.count > 0) this.addItem({ kind: "block", numbers, filled: false, name, ...drawn, volume }, colour, visible);
  }

  /** Whether a surface lies above most of the others and hides them from above. */
  private isLid(item: Item): boolean {
    if (item.kind !== "surface" || this.items.filter((i) => i.visible).length < 3) return false;
    const least = [Infinity, Infinity], most = [-Infinity, -Infinity];
    for (const v of item.geometry.index!.array as Uint32Array)
      for (let k = 0; k < 2; ++k) {
        const at = this.model.vertices[3 * v + k];
        if (at < least[k]) least[k] = at;
        if (at > most[k]) most[k] = at;
      }
    const covered = (most[0] - least[0]) * (most[1] - least[1]) / (4 * this.model.half.x * this.model.half.y);
    const below = this.items.filter((i) => i.kind === "surface" && i.centre.z < item.centre.z).length;
    return covered > 0.7 && below >= 0.6 * (this.report.content.surfaces.length - 1);
  }

  private addItem(what: Omit<Item, "mesh" | "coarse" | "edges" | "cap" | "capEdges" | "cut" | "centre" | "reach" | "visible" | "colour" | "opacity" | "tetrahedra">, colour: Color, visible: boolean): void {
    const { kind, numbers, geometry } = what;
    const material = new MeshLambertMaterial({
      color: colour, flatShading: true, side: kind === "block" ? FrontSide : DoubleSide,
      polygonOffset: true, polygonOffsetFactor: 1, polygonOffsetUnits: 1,
    });
    const mesh = new Mesh(geometry, material);
    mesh.frustumCulled = false;
    this.root.add(mesh);
    const centre = this.model.centre(geometry);
    this.items.push({
      ...what, mesh, coarse: new Map(), edges: null, cap: null, capEdges: null, cut: null, centre,
      reach: this.model.reach(geometry, centre), visible, colour: colour.clone(), opacity: 1,
      tetrahedra: kind === "block" ? this.model.tetrahedraOf(numbers) : new Uint32Array(),
    });
  }

  private addLines(): void {
    for (const kind of new Set(this.report.content.lines.map((line) => line.kind))) {
      const geometry = new LineSegmentsGeometry().setPositions(this.model.segmentsOf(kind));
      const material = new LineMaterial({ color: lineColours[kind] ?? "#111111", linewidth: { "boundary line": 1.1, "improper contact": 3 }[kind] ?? 1.8 });
      const object = new LineSegments2(geometry, material);
      const thin = new LineSegments(new BufferGeometry().setAttribute("position", new BufferAttribute(this.model.segmentsOf(kind), 3)),
        new LineBasicMaterial());
      thin.visible = false;
      for (const line of [object, thin]) {
        line.frustumCulled = false;
        line.renderOrder = 1;
        this.root.add(line);
      }
      this.lines.push({ kind, object, thin, wanted: true });
    }
  }

  /** Takes colours of the style sheet, which differ between light and dark. */
  setTheme(): void {
    const value = (name: string) => getComputedStyle(document.documentElement).getPropertyValue(name).trim();
    this.renderer.setClearColor(new Color(value("--scene")), 1);
    const dark = document.documentElement.dataset.theme === "dark";
    for (const { kind, object, thin } of this.lines) {
      const colour = new Color(lineColours[kind] ?? "#111111");
      thin.material.color = object.material.color = dark ? colour.lerp(new Color("#ffffff"), ["free border", "improper contact"].includes(kind) ? 0.35 : 0.6) : colour;
    }
    this.draw();
  }

  // ---------------------------------------------------------------------------------------- what is shown

  show(item: Item, visible: boolean): void {
    item.visible = visible;
    this.update(item);
  }
  recolour(item: Item, colour: string): void {
    item.colour.set(colour);
    item.mesh.material.color.copy(item.colour);
    item.cap?.material.color.copy(item.colour);
    this.draw();
  }
  setOpacity(item: Item, opacity: number): void {
    item.opacity = opacity;
    for (const material of [item.mesh.material, item.cap?.material])
      if (material) {
        material.opacity = opacity;
        material.transparent = opacity < 1;
        material.depthWrite = opacity >= 1;
        material.needsUpdate = true;
      }
    this.draw();
  }
  showEdges(shown: boolean): void {
    this.edgesShown = shown;
    for (const item of this.items) this.update(item);
  }
  get showsEdges(): boolean { return this.edgesShown; }
  showLines(kind: string, shown: boolean): void {
    for (const line of this.lines) if (line.kind === kind) line.wanted = shown;
    this.placeLines();
  }

  /** Moves blocks apart: each away from the centre, by `share` of its distance from there. */
  explode(share: number): void {
    this.exploded = share;
    for (const item of this.items) this.update(item);
  }
  offsetOf(item: Item): Vector3 {
    return item.kind === "block" ? item.centre.clone().multiplyScalar(this.exploded) : new Vector3();
  }

  exaggerate(factor: number): void {
    this.exaggeration = factor;
    this.root.scale.z = factor;
    this.placePlane();
    for (const marker of this.markers.children) marker.scale.z = marker.scale.x / factor;
    this.draw();
  }

  cutAt(section: Section | null): void {
    this.section = section;
    this.placePlane();
    for (const item of this.items) this.update(item);
  }

  /** Where the plane is along its axis, relative to the model's centre, without exaggeration. */
  private levelOf(section: Section): number {
    const half = this.model.half.getComponent(section.axis) * (1 + 2 * this.exploded);
    return half * (2 * section.share - 1);
  }
  private placePlane(): void {
    const planes: Plane[] = [];
    if (this.section) {
      const normal = new Vector3().setComponent(this.section.axis, this.section.flipped ? 1 : -1);
      const level = this.levelOf(this.section) * (this.section.axis === 2 ? this.exaggeration : 1);
      this.plane.set(normal, this.section.flipped ? -level : level);
      planes.push(this.plane);
    }
    for (const item of this.items) {
      item.mesh.material.clippingPlanes = planes;
      if (item.edges) (item.edges.material as LineBasicMaterial).clippingPlanes = planes;
    }
    for (const { object, thin } of this.lines) thin.material.clippingPlanes = object.material.clippingPlanes = planes;
  }

  private update(item: Item): void {
    const offset = this.offsetOf(item);
    item.mesh.visible = item.visible;
    item.mesh.position.copy(offset);
    if (item.visible && this.edgesShown && !item.edges) {
      item.edges = new LineSegments(this.model.edges(item.geometry), this.edgeMaterial());
      item.edges.frustumCulled = false;
      this.root.add(item.edges);
      this.placePlane();
    }
    if (item.edges) {
      item.edges.visible = item.visible && this.edgesShown;
      item.edges.position.copy(offset);
    }
    this.cap(item, offset);
    this.placeLines();
  }

  /** Lines belong to several blocks: they are not shown while blocks are moved apart. */
  private placeLines(): void {
    const apart = this.exploded > 0 && this.items.some((i) => i.kind === "block" && i.visible);
    for (const { object, thin, wanted } of this.lines) {
      object.visible = wanted && !apart && this.pace.level === 0;
      thin.visible = wanted && !apart && this.pace.level > 0;
    }
    this.draw();
  }

  private edgeMaterial(): LineBasicMaterial {
    return new LineBasicMaterial({ color: 0x101418, transparent: true, opacity: edgeOpacity, depthWrite: false });
  }

  /** Closes a block where the section plane opens it. */
  private cap(item: Item, offset: Vector3): void {
    for (const object of [item.cap, item.capEdges])
      if (object) {
        this.root.remove(object);
        object.geometry.dispose();
      }
    item.cap = item.capEdges = item.cut = null;
    if (!this.section || item.kind !== "block" || !item.visible) return;
    const { axis } = this.section;
    const at = this.levelOf(this.section) - offset.getComponent(axis);
    const cut = item.tetrahedra.length
      ? cutTetrahedra(this.model.nodes, this.model.tetrahedra, item.tetrahedra, axis, at)
      : cutBoundary(this.model.vertices, item.geometry.index!.array as Uint32Array, axis, at);
    item.cut = cut;
    if (cut.triangles.length === 0) return;
    const listed = (numbers: number[]) => {
      const made = new BufferGeometry();
      made.setAttribute("position", new BufferAttribute(new Float32Array(numbers), 3));
      return made;
    };
    item.cap = new Mesh(listed(cut.triangles), new MeshLambertMaterial({
      color: item.colour, side: DoubleSide, flatShading: true, emissive: item.colour, emissiveIntensity: 0.18,
      opacity: item.opacity, transparent: item.opacity < 1, depthWrite: item.opacity >= 1,
      polygonOffset: true, polygonOffsetFactor: 1, polygonOffsetUnits: 1,
    }));
    item.capEdges = new LineSegments(listed(cut.edges), this.edgeMaterial());
    (item.capEdges.material as LineBasicMaterial).opacity = item.tetrahedra.length ? 0.22 : 0.8;
    item.capEdges.visible = item.tetrahedra.length === 0 || this.edgesShown || item.tetrahedra.length < 200_000;
    for (const object of [item.cap, item.capEdges]) {
      object.position.copy(offset);
      object.frustumCulled = false;
      this.root.add(object);
    }
  }

  // ---------------------------------------------------------------------------------------- drawing

  get camera() { return this.viewpoint.camera; }
  get controls() { return this.viewpoint.controls; }

  /** The box round the model as it is drawn: moved apart and stretched. */
  private bounds(): Bounds {
    const { half } = this.model, { exaggeration, exploded } = this;
    const drawn = (apart: number) => half.clone().multiplyScalar(apart).setZ(half.z * apart * exaggeration);
    return { half: drawn(1 + exploded), radius: drawn(1).length() * (1 + 0.8 * exploded) };
  }

  look(name: ViewName): void {
    this.viewpoint.look(name);
  }
  /** Goes to a place given in the input's coordinates, marks it, and shows so much around it. */
  flyTo(place: [number, number, number], extent: number): void {
    this.viewpoint.goTo(this.toScene(place), Math.max(extent / this.model.unit, this.model.radius * 2e-4));
    this.mark([place], true);
  }
  resize(): void {
    const { clientWidth: width, clientHeight: height } = this.place;
    if (width === 0 || height === 0) return;
    this.renderer.setSize(width, height);
    this.viewpoint.resize();
  }

  /** Asks for a picture before the next refresh of the screen. */
  draw(): void {
    if (this.pending === 0) this.pending = requestAnimationFrame(() => this.drawNow());
  }
  drawNow(): void {
    cancelAnimationFrame(this.pending);
    this.pending = 0;
    this.sun.position.copy(this.camera.position).sub(this.controls.target).normalize()
      .add(new Vector3(0.35, -0.15, 0.9)).multiplyScalar(this.model.radius).add(this.controls.target);
    this.sun.target.position.copy(this.controls.target);
    for (const marker of this.markers.children) {
      const size = 7 * this.viewpoint.unitsPerPixel();
      marker.scale.set(size, size, size / this.exaggeration);
    }
    this.renderer.render(this.scene, this.camera);
    this.pace.drawn(this.renderer.info.render.triangles);
    ++this.frames;
    this.onFrame();
  }

  /** Draws with the detail of a level of `budgets` from now on. */
  private setLevel(level: number): void {
    const ratio = Math.min(window.devicePixelRatio, 2), shown = this.items.filter((i) => i.visible);
    this.renderer.setPixelRatio(level > 0 ? ratio / 2 : ratio);
    const simplify = shown.reduce((sum, i) => sum + i.geometry.index!.count / 3, 0) > budgets[level];
    if (simplify && !this.cells.has(level)) {
      const area = shown.reduce((sum, i) => sum + i.area, 0);
      this.cells.set(level, Math.sqrt(2 * area / budgets[level])); // a vertex for each cell, two triangles for each vertex
    }
    for (const item of this.items) {
      if (simplify && item.visible && !item.coarse.has(level))
        item.coarse.set(level, this.model.coarse(item.geometry, this.cells.get(level)!));
      item.mesh.geometry = (simplify && item.coarse.get(level)) || item.geometry;
      if (item.edges) item.edges.visible = item.visible && this.edgesShown && !simplify;
    }
    this.placeLines();
  }

  // ---------------------------------------------------------------------------------------- picking

  toScene(place: [number, number, number]): Vector3 {
    const [x, y, z] = place.map((c, k) => (c - this.model.origin[k]) / this.model.unit);
    return new Vector3(x, y, z * this.exaggeration);
  }

  /** Finds what is drawn at a point of the view, in pixels from its upper left corner. */
  pick(x: number, y: number): Pick | null {
    const { clientWidth: width, clientHeight: height } = this.place;
    this.pace.stop();
    const caster = new Raycaster();
    caster.setFromCamera(new Vector2((2 * x) / width - 1, 1 - (2 * y) / height), this.camera);
    this.scene.updateMatrixWorld();
    let best: { distance: number; item: Item; point: Vector3; tetrahedron: number } | null = null;
    for (const item of this.items) {
      if (!item.visible) continue;
      for (const object of [item.mesh, item.cap]) {
        if (!object) continue;
        for (const hit of caster.intersectObject(object, false)) {
          if (best && hit.distance >= best.distance) break;
          if (object === item.mesh && this.section && this.plane.distanceToPoint(hit.point) < 0) continue;
          const owner = object === item.cap && hit.faceIndex != null ? item.cut!.owners[hit.faceIndex] : -1;
          best = { distance: hit.distance, item, point: hit.point, tetrahedron: owner };
          break;
        }
      }
    }
    if (!best) return null;
    const local = best.point.clone();
    local.z /= this.exaggeration;
    local.sub(this.offsetOf(best.item));
    return { item: best.item, place: this.model.toInput(local), point: best.point, tetrahedron: best.tetrahedron };
  }

  /** Marks places; a finding stays visible through what is before it. */
  mark(places: [number, number, number][], through = false): void {
    this.markers.clear();
    for (const place of places) {
      const material = new MeshBasicMaterial({ color: "#d4127c", depthTest: !through, transparent: true, opacity: 0.9 });
      const marker = new Mesh(new SphereGeometry(1, 20, 12), material);
      const at = this.toScene(place);
      marker.position.set(at.x, at.y, at.z / this.exaggeration);
      marker.renderOrder = 3;
      this.markers.add(marker);
    }
    this.draw();
  }
  get marked(): number { return this.markers.children.length; }
}
