/** Mouse, touch and keys over the picture: moves the camera and reports clicks. */

import type { Pick, Point } from "../engine";
import type { Session } from "../session";
import { kOtherFirstValues } from "../state/member_controls";
import type { Camera } from "../state/view_state";
import { basisOf, lookAround, orbit, pan, pointAt, walk, zoom } from "./camera";
import { add, distance, dot, sub } from "./vec";

/** Rotation in radians for a drag over the whole height of the picture. */
const kTurnPerHeight = Math.PI;
const kClickSlop = 5;
const kLongPress = 550;
/** Metres within which walking searches for room. */
const kFarLook = 8;

export interface ControlsHost {
  session: Session;
  element: HTMLElement;
  /** Fractions of the picture. */
  clicked(x: number, y: number, event: PointerEvent): void;
  listed(x: number, y: number): void;
  /** Asks for the context menu of a point. @param at  in the window, pixels */
  menu(x: number, y: number, at: { x: number; y: number }, isTouch: boolean): void;
  framed(x: number, y: number): void;
  /** The pointer hovers, or has left (null). */
  hovered(at: { x: number; y: number; isDown: boolean } | null): void;
  /** Returns true if the wheel event was handled, "ignored" if it is not for the picture. */
  wheeled(event: WheelEvent): boolean | "ignored";
}

interface Finger {
  x: number;
  y: number;
}

export class Controls {
  private readonly fingers = new Map<number, Finger>();
  private down: { x: number; y: number; time: number; button: number; isMoved: boolean } | null = null;
  private longPress = 0;
  /** Zoom target of the wheel, valid until the pointer moves. */
  private zoomTarget: { x: number; y: number; point: Point | null; time: number } | null = null;
  private readonly keys = new Set<string>();
  private walking = 0;

  constructor(private readonly host: ControlsHost) {
    const e = host.element;
    e.addEventListener("pointerdown", (event) => this.pressed(event));
    e.addEventListener("pointermove", (event) => this.moved(event));
    e.addEventListener("pointerup", (event) => this.released(event));
    e.addEventListener("pointercancel", (event) => this.lost(event));
    e.addEventListener("pointerleave", () => host.hovered(null));
    e.addEventListener("contextmenu", (event) => event.preventDefault());
    e.addEventListener("wheel", (event) => this.wheeled(event), { passive: false });
    e.addEventListener("dblclick", (event) => host.framed(...this.shareOf(event)));
    e.addEventListener("keydown", (event) => this.keyDown(event));
    e.addEventListener("keyup", (event) => this.keys.delete(event.key.toLowerCase()));
    e.addEventListener("blur", () => this.keys.clear());
  }

  private get session(): Session {
    return this.host.session;
  }
  private get camera(): Camera | null {
    return this.session.view.now.camera;
  }

  private shareOf(event: { clientX: number; clientY: number }): [number, number] {
    const box = this.host.element.getBoundingClientRect();
    return [(event.clientX - box.left) / box.width, (event.clientY - box.top) / box.height];
  }

  private pressed(event: PointerEvent): void {
    if (event.target !== this.host.element && !(event.target as Element).hasAttribute("data-picture")) return;
    this.host.element.focus({ preventScroll: true });
    // A pointer that is already gone, or a synthetic one, cannot be captured.
    try {
      this.host.element.setPointerCapture(event.pointerId);
    } catch {
      // It then moves the picture only while it is above the picture.
    }
    this.fingers.set(event.pointerId, { x: event.clientX, y: event.clientY });
    const isFirst = this.fingers.size === 1;
    this.down = isFirst ? { x: event.clientX, y: event.clientY, time: performance.now(), button: event.button, isMoved: false } : null;
    clearTimeout(this.longPress);
    if (isFirst && event.pointerType === "touch") {
      const at = this.shareOf(event);
      this.longPress = window.setTimeout(() => {
        this.down = null;
        this.host.menu(...at, { x: event.clientX, y: event.clientY }, true);
      }, kLongPress);
    }
  }

  private moved(event: PointerEvent): void {
    const [x, y] = this.shareOf(event);
    const finger = this.fingers.get(event.pointerId);
    this.host.hovered({ x, y, isDown: this.fingers.size > 0 });
    if (!finger) return;
    const dx = event.clientX - finger.x,
      dy = event.clientY - finger.y;
    if (this.down && !this.down.isMoved) {
      if (Math.hypot(event.clientX - this.down.x, event.clientY - this.down.y) < kClickSlop) return;
      this.down.isMoved = true;
      clearTimeout(this.longPress);
    }
    if (this.fingers.size === 2) this.pinched(event, finger);
    else if (this.fingers.size === 1) this.dragged(dx, dy, event);
    finger.x = event.clientX;
    finger.y = event.clientY;
  }

  private dragged(dx: number, dy: number, event: PointerEvent): void {
    const height = this.host.element.clientHeight;
    if (!this.camera) return;
    const isPan = event.shiftKey || (event.buttons & 6) !== 0;
    if (isPan) return this.session.view.turn(pan(this.camera, dx / height, dy / height, this.depth()));
    this.rotate((-dx / height) * kTurnPerHeight, (dy / height) * kTurnPerHeight);
  }

  private rotate(turn: number, rise: number): void {
    const camera = this.camera;
    if (!camera) return;
    if (this.session.view.isWalking) this.session.view.turn(lookAround(camera, -turn * 0.6, -rise * 0.6));
    else this.session.view.turn(orbit(camera, camera.target, turn, rise));
  }

  private pinched(event: PointerEvent, finger: Finger): void {
    const other = [...this.fingers.entries()].find(([id]) => id !== event.pointerId)?.[1];
    if (!other || !this.camera) return;
    const height = this.host.element.clientHeight;
    const before = Math.hypot(finger.x - other.x, finger.y - other.y);
    const after = Math.hypot(event.clientX - other.x, event.clientY - other.y);
    const middle = this.shareOf({ clientX: (event.clientX + other.x) / 2, clientY: (event.clientY + other.y) / 2 });
    const towards = pointAt(this.camera, this.session.view.aspect, ...middle, this.depth());
    const zoomed = zoom(this.camera, towards, Math.min(2, Math.max(0.5, before / Math.max(1, after))));
    this.session.view.turn(pan(zoomed, (event.clientX - finger.x) / 2 / height, (event.clientY - finger.y) / 2 / height, this.depth()));
  }

  private released(event: PointerEvent): void {
    this.fingers.delete(event.pointerId);
    clearTimeout(this.longPress);
    const down = this.down;
    this.down = null;
    if (!down || down.isMoved) return;
    const [x, y] = this.shareOf(event);
    if (down.button === 2) this.host.menu(x, y, { x: event.clientX, y: event.clientY }, false);
    if (down.button !== 0) return;
    if (event.altKey) this.host.listed(x, y);
    else this.host.clicked(x, y, event);
  }

  private lost(event: PointerEvent): void {
    this.fingers.delete(event.pointerId);
    clearTimeout(this.longPress);
    this.down = null;
  }

  private wheeled(event: WheelEvent): void {
    const answer = this.host.wheeled(event);
    if (answer === "ignored") return;
    event.preventDefault();
    if (!this.camera || answer) return;
    const [x, y] = this.shareOf(event);
    const pixels = event.deltaY * (event.deltaMode === 1 ? 33 : event.deltaMode === 2 ? 400 : 1);
    this.zoomTo(x, y, Math.exp(Math.min(240, Math.max(-240, pixels)) * 0.0018));
  }

  /** Zooms towards a position; the point there stays in place. */
  private zoomTo(x: number, y: number, factor: number): void {
    const camera = this.camera;
    if (!camera) return;
    if (this.session.view.isWalking) return void this.stepTo(walk(camera, (1 - factor) * 3, 0, 0));
    const now = performance.now();
    const target = this.zoomTarget;
    if (!target || Math.hypot(target.x - x, target.y - y) > 0.01 || now - target.time > 800) this.findZoomTarget(x, y);
    if (this.zoomTarget) this.zoomTarget.time = now;
    const point = this.zoomTarget?.point ?? pointAt(camera, this.session.view.aspect, x, y, this.depth());
    this.session.view.turn(zoom(camera, point, factor));
  }

  private findZoomTarget(x: number, y: number): void {
    const found = { x, y, point: null as Point | null, time: performance.now() };
    this.zoomTarget = found;
    void this.session.volume.engine?.pick(x, y).then(
      (pick: Pick | null) => (found.point = pick?.point ?? null),
      () => undefined,
    );
  }

  /** Depth of the camera target. */
  private depth(): number {
    const camera = this.camera!;
    return Math.max(1e-3, dot(sub(camera.target, camera.eye), basisOf(camera).forward));
  }

  private keyDown(event: KeyboardEvent): void {
    if (event.ctrlKey || event.metaKey || event.altKey || !this.camera) return;
    const key = event.key.toLowerCase();
    if (this.session.view.isWalking && "wasdqe".includes(key) && key.length === 1) {
      this.keys.add(key);
      if (!this.walking) this.stepWalk(performance.now());
      event.preventDefault();
      event.stopPropagation();
      return;
    }
    if (!this.steered(event)) return;
    event.preventDefault();
    event.stopPropagation();
  }

  private steered(event: KeyboardEvent): boolean {
    const arrows: Record<string, [number, number]> = { ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, -1], ArrowDown: [0, 1] };
    const arrow = arrows[event.key];
    if (arrow) {
      const [dx, dy] = arrow;
      if (event.shiftKey) this.session.view.turn(pan(this.camera!, -dx * 0.04, -dy * 0.04, this.depth()));
      else this.rotate((dx * Math.PI) / 36, (-dy * Math.PI) / 36);
    } else if (event.key === "+" || event.key === "=") this.zoomTo(0.5, 0.5, 0.88);
    else if (event.key === "-") this.zoomTo(0.5, 0.5, 1 / 0.88);
    else if (event.key === "Enter") this.host.clicked(0.5, 0.5, new PointerEvent("pointerup", { ctrlKey: event.ctrlKey }));
    else if (event.key.toLowerCase() === "l") this.host.listed(0.5, 0.5);
    else return false;
    return true;
  }

  private stepWalk(before: number): void {
    this.walking = requestAnimationFrame(async (now) => {
      const held = (key: string) => (this.keys.has(key) ? 1 : 0);
      const metres = Math.min(0.2, (now - before) / 1000) * 2.5;
      if (this.camera && this.keys.size)
        await this.stepTo(
          walk(this.camera, (held("w") - held("s")) * metres, (held("d") - held("a")) * metres, (held("e") - held("q")) * metres),
        );
      this.walking = 0;
      if (this.keys.size && this.session.view.isWalking) this.stepWalk(now);
    });
  }

  /** Steps as far as there is air, and along obstacles. */
  private async stepTo(wanted: Camera): Promise<void> {
    const from = this.camera!;
    const eye = await this.session.volume.engine?.step(from.eye, sub(wanted.eye, from.eye)).catch(() => null);
    // Meanwhile the view may have turned, or walking may have ended.
    const now = this.camera;
    if (!eye || !now || !this.session.view.isWalking) return;
    const by = sub(eye, from.eye);
    this.session.view.turn({ ...now, eye: add(now.eye, by), target: add(now.target, by) });
  }
}

/** Turns a standing camera to the direction with the most room. */
export async function standAt(camera: Camera, eye: Point, step: (eye: Point, by: Point) => Promise<Point>): Promise<Camera> {
  const { forward } = basisOf(camera);
  const ahead = Math.atan2(forward[1], forward[0]);
  let best = ahead,
    most = -1;
  for (let n = 0; n < 8; ++n) {
    // Alternates around the direction of the view, which has priority if the room is equal.
    const angle = ahead + ((n % 2 ? (n + 1) / 2 : -n / 2) * Math.PI) / 4;
    const end = await step(eye, [kFarLook * Math.cos(angle), kFarLook * Math.sin(angle), 0]).catch(() => eye);
    const room = Math.round((end[0] - eye[0]) * Math.cos(angle) + (end[1] - eye[1]) * Math.sin(angle));
    if (room > most) [best, most] = [angle, room];
  }
  const target: Point = [eye[0] + 3 * Math.cos(best), eye[1] + 3 * Math.sin(best), eye[2]];
  return {
    ...camera,
    parallel: false,
    eye,
    target,
    fieldOfView: kOtherFirstValues.walkingFieldOfView.value,
    height: Math.max(1, distance(eye, target)),
  };
}
