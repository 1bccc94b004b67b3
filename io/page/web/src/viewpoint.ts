// SPDX-License-Identifier: LGPL-3.0-or-later
//
// From where the model is seen: a camera with and one without perspective, and how they move.
import { OrthographicCamera, PerspectiveCamera, Vector3 } from "three";
import { OrbitControls } from "three/examples/jsm/controls/OrbitControls.js";
import type { Axis } from "./caps";
import { needed, type ViewName } from "./items";

/** Half the edges of the box round the model as it is drawn, and the radius that is seen round its centre. */
export interface Bounds { half: Vector3; radius: number }

export class Viewpoint {
  readonly controls: OrbitControls;
  camera: PerspectiveCamera | OrthographicCamera;
  jumps = false; ///< while another view is chosen, which is no motion
  private readonly perspective = new PerspectiveCamera(32, 1, 0.1, 100);
  private readonly orthographic = new OrthographicCamera();

  constructor(private readonly place: HTMLElement, canvas: HTMLCanvasElement,
    private readonly bounds: () => Bounds, private readonly changed: () => void) {
    this.camera = this.perspective;
    for (const camera of [this.perspective, this.orthographic]) camera.up.set(0, 0, 1);
    this.controls = new OrbitControls(this.camera, canvas);
    this.controls.zoomToCursor = true;
  }

  /** Shows all from one of the usual sides. */
  look(name: ViewName): void {
    const direction = { perspective: [-0.62, -1, 0.62], top: [0, -1e-4, 1], north: [0, -1, 0], east: [-1, 0, 0] }[name];
    this.use(name === "perspective" ? this.perspective : this.orthographic);
    this.aim(new Vector3(), new Vector3(...direction).normalize(), this.bounds().radius);
  }
  /** Goes to a place of the scene without turning, and shows so much around it; at most all. */
  goTo(target: Vector3, radius: number): void {
    const direction = this.camera.position.clone().sub(this.controls.target).normalize();
    this.aim(target, direction, Math.min(radius, this.bounds().radius));
  }

  /** Turns by degrees round the vertical and the horizontal axis. */
  turn(around: number, over: number): void {
    const arm = this.camera.position.clone().sub(this.controls.target);
    arm.applyAxisAngle(new Vector3(0, 0, 1), (around * Math.PI) / 180);
    const flat = Math.hypot(arm.x, arm.y), pitch = Math.atan2(arm.z, flat) + (over * Math.PI) / 180;
    const limited = Math.min(Math.max(pitch, -1.5705), 1.5705), length = arm.length();
    const heading = flat > 1e-9 * length ? Math.atan2(arm.y, arm.x) : -Math.PI / 2;
    arm.set(Math.cos(limited) * Math.cos(heading), Math.cos(limited) * Math.sin(heading), Math.sin(limited)).multiplyScalar(length);
    this.camera.position.copy(this.controls.target).add(arm);
    this.controls.update();
    this.changed();
  }
  zoom(factor: number): void {
    if (this.camera === this.orthographic) {
      this.orthographic.zoom *= factor;
      this.orthographic.updateProjectionMatrix();
    } else {
      const arm = this.camera.position.clone().sub(this.controls.target).divideScalar(factor);
      this.camera.position.copy(this.controls.target).add(arm);
    }
    this.controls.update();
    this.changed();
  }
  pan(right: number, up: number): void {
    const step = this.unitsPerPixel() * 40;
    const move = new Vector3().setFromMatrixColumn(this.camera.matrix, 0).multiplyScalar(right * step)
      .add(new Vector3().setFromMatrixColumn(this.camera.matrix, 1).multiplyScalar(up * step));
    this.camera.position.add(move);
    this.controls.target.add(move);
    this.controls.update();
    this.changed();
  }

  private use(camera: PerspectiveCamera | OrthographicCamera): void {
    this.camera = camera;
    this.controls.object = camera;
    this.resize();
  }
  private aim(target: Vector3, direction: Vector3, radius: number): void {
    const aspect = this.place.clientWidth / Math.max(this.place.clientHeight, 1);
    const whole = this.bounds();
    const half = radius >= whole.radius ? whole.half : new Vector3(radius, radius, radius).multiplyScalar(0.6);
    const need = needed(half, direction, Math.tan((this.perspective.fov * Math.PI) / 360), aspect);
    this.controls.target.copy(target);
    this.camera.position.copy(target).addScaledVector(direction, this.isPerspective ? need.distance : 4 * whole.radius);
    this.perspective.near = need.distance / 200;
    this.perspective.far = need.distance + 8 * whole.radius;
    this.orthographic.near = 0;
    this.orthographic.far = 10 * whole.radius;
    this.orthographic.zoom = this.orthographic.top / need.height;
    for (const camera of [this.perspective, this.orthographic]) camera.updateProjectionMatrix();
    this.jumps = true;
    this.controls.update();
    this.jumps = false;
    this.changed();
  }

  /** Length in the scene that one pixel at the centre of the view covers. */
  unitsPerPixel(): number {
    const height = Math.max(this.place.clientHeight, 1);
    if (this.camera === this.orthographic)
      return (this.orthographic.top - this.orthographic.bottom) / this.orthographic.zoom / height;
    const distance = this.camera.position.distanceTo(this.controls.target);
    return (2 * distance * Math.tan((this.perspective.fov * Math.PI) / 360)) / height;
  }
  /** Whether the camera looks from the lower side of an axis. */
  isBehind(axis: Axis): boolean {
    return this.camera.position.getComponent(axis) < this.controls.target.getComponent(axis);
  }
  get isPerspective(): boolean { return this.camera === this.perspective; }

  /** Takes the size of the place on the page. */
  resize(): void {
    const { clientWidth: width, clientHeight: height } = this.place;
    if (width === 0 || height === 0) return;
    this.perspective.aspect = width / height;
    const half = this.bounds().radius;
    Object.assign(this.orthographic, { left: -half * width / height, right: half * width / height, top: half, bottom: -half });
    for (const camera of [this.perspective, this.orthographic]) camera.updateProjectionMatrix();
    this.changed();
  }

  /** Directions of east, north and up on the screen, each to the right, upwards, and towards us. */
  axes(): { name: string; x: number; y: number; z: number }[] {
    const turned = this.camera.quaternion.clone().invert();
    return [["E", 1, 0, 0], ["N", 0, 1, 0], ["Up", 0, 0, 1]].map(([name, x, y, z]) => {
      const v = new Vector3(x as number, y as number, z as number).applyQuaternion(turned);
      return { name: name as string, x: v.x, y: v.y, z: v.z };
    });
  }
}
