import { describe, expect, it } from "vitest";
import { History } from "./history";
import { initialState, type Camera, type ViewState } from "./view_state";

const camera = (x: number): Camera => ({ eye: [x, 0, 0], target: [0, 0, 0], parallel: false, height: 10, fieldOfView: 40 });
const start: ViewState = { ...initialState(), camera: camera(1) };

describe("history", () => {
  it("takes back and repeats, newest first", () => {
    const history = new History();
    const hidden = { ...start, hide: ["class=Roof"] };
    const cut = { ...hidden, sections: [{ axis: "z" as const, at: 1, flip: false, turn: 0, tilt: 0 }] };
    history.record(start, hidden, 0);
    history.record(hidden, cut, 10_000);
    expect(history.last).toEqual(["sections"]);
    const once = history.undo(cut)!;
    expect(once).toEqual(hidden);
    expect(history.undo(once)).toEqual(start);
    expect(history.undo(start)).toBeNull();
    expect(history.next).toEqual(["hide"]);
    expect(history.redo(start)).toEqual(hidden);
    expect(history.redo(hidden)).toEqual(cut);
    expect(history.redo(cut)).toBeNull();
  });

  it("makes one step of a drag, and two of two drags", () => {
    const history = new History();
    const at = (x: number): ViewState => ({ ...start, camera: camera(x) });
    history.record(at(1), at(2), 0);
    history.record(at(2), at(3), 100);
    history.record(at(3), at(4), 5_000);
    expect(history.undo(at(4))!.camera).toEqual(camera(3));
    expect(history.undo(at(3))!.camera).toEqual(camera(1));
    expect(history.undo(at(1))).toBeNull();
  });

  it("makes steps of their own of what is sealed, and of different members", () => {
    const history = new History();
    const at = (x: number): ViewState => ({ ...start, camera: camera(x) });
    history.record(at(1), at(2), 0);
    history.seal();
    history.record(at(2), at(3), 1);
    const named = { ...at(3), names: true };
    history.record(at(3), named, 2);
    expect(history.undo(named)).toEqual(at(3));
    expect(history.undo(at(3))).toEqual(at(2));
  });

  it("leaves out selections, the first camera, and a lens that follows the mouse", () => {
    const history = new History();
    history.record(start, { ...start, selection: ["a"] }, 0);
    history.record({ ...start, camera: null }, start, 1);
    const lens = { ...start, effect: "lens" as const };
    history.record(lens, { ...lens, lens: { ...lens.lens, x: 0.1 } }, 2);
    expect(history.last).toBeNull();
    history.record(lens, { ...lens, lens: { ...lens.lens, x: 0.1, pinned: true } }, 3);
    expect(history.last).toEqual(["lens"]);
  });

  it("counts choices before the first camera, and keeps that camera", () => {
    const history = new History();
    const early = { ...start, camera: null };
    history.record(early, { ...early, hide: ["class=Roof"] }, 0);
    expect(history.undo({ ...start, hide: ["class=Roof"] })).toEqual(start);
  });

  it("keeps what no step changed, and forgets what was undone when something else is done", () => {
    const history = new History();
    const hidden = { ...start, hide: ["x"] };
    history.record(start, hidden, 0);
    const undone = history.undo({ ...hidden, selection: ["b"] })!;
    expect(undone.selection).toEqual(["b"]);
    expect(undone.hide).toEqual([]);
    history.record(undone, { ...undone, names: true }, 1);
    expect(history.redo(undone)).toBeNull();
  });
});
