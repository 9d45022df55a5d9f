import { afterEach, beforeEach, expect, it, vi } from "vitest";
import type { CityLook, CityOptions, Engine, VolumeInfo } from "../engine";
import { Messages } from "../session/messages";
import { OpenVolume } from "../session/open_volume";
import { Selection } from "../session/selection";
import { ShownPicture } from "../session/shown_picture";
import { Answers } from "../session/answers";
import { View } from "../session/view";
import type { Camera } from "../state/view_state";
import type { CityFiles } from "./city_files";
import { CityStream } from "./city_stream";

const kInfo = {
  name: "town",
  features: [],
  buildings: 3,
  spacing: [1, 1, 1],
  size: [9, 9, 9],
  dimension: [9, 9, 9],
} as unknown as VolumeInfo;
const cameraAt = (x: number): Camera => ({ eye: [x, 0, 9], target: [0, 0, 0], parallel: false, height: 10, fieldOfView: 40 });

beforeEach(() => {
  vi.useFakeTimers();
  vi.stubGlobal("navigator", { deviceMemory: 8 });
  vi.stubGlobal("matchMedia", () => ({ matches: false }));
  vi.stubGlobal("cancelAnimationFrame", () => undefined);
});
afterEach(() => {
  vi.useRealTimers();
  vi.unstubAllGlobals();
});

/** A city whose looks take 10 ms, and are answered by `answer`; `asked` are the widths of their voxels. */
function started(answer: (options: CityOptions) => Partial<CityLook> | Error = () => ({ info: kInfo })) {
  const volume = new OpenVolume(),
    messages = new Messages();
  const view = new View(volume, messages, new Answers(volume));
  const parts = { volume, view, messages };
  const selection = new Selection(parts),
    picture = new ShownPicture(parts);
  const asked: number[] = [];
  const look = async (options: CityOptions) => {
    asked.push(options.pixels);
    await new Promise((done) => setTimeout(done, 10));
    const given = answer(options);
    if (given instanceof Error) throw given;
    return { info: null, key: "k", lacks: [], pixels: options.pixels, ...given } as CityLook;
  };
  volume.engine = {
    followCity: (_files: unknown, _scene: unknown, _size: unknown, options: CityOptions) => look(options),
    cityInfo: () => Promise.resolve(kInfo),
  } as unknown as Engine;
  const city = new CityStream({} as CityFiles, { ...parts, selection, picture });
  city.show(kInfo);
  view.state = { ...view.state, camera: cameraAt(1) };
  city.begin();
  const draw = () => (picture.report = { width: 9, height: 9, milliseconds: 1, engine: "cpu" });
  return { city, view, messages, asked, draw };
}

it("waits for the first picture, then fetches coarse tiles, finer ones, and rests", async () => {
  const { city, asked, draw } = started();
  await vi.advanceTimersByTimeAsync(1000);
  expect(asked).toEqual([]);
  draw();
  await vi.advanceTimersByTimeAsync(1000);
  expect(asked).toEqual([4, 2, 2, 2, 1]);
  expect(city.isComplete).toBe(true);
  draw();
  await vi.advanceTimersByTimeAsync(1000);
  expect(asked.length).toBe(5);
});

it("follows a camera that moves, and is complete once it stands", async () => {
  const { city, view, asked, draw } = started();
  draw();
  await vi.advanceTimersByTimeAsync(1000);
  asked.length = 0;
  for (let x = 2; x < 8; ++x) {
    view.state = { ...view.state, camera: cameraAt(x) };
    expect(city.isComplete).toBe(false);
    await vi.advanceTimersByTimeAsync(100);
  }
  expect(asked.every((pixels) => pixels === 2)).toBe(true);
  await vi.advanceTimersByTimeAsync(1000);
  expect(asked.at(-1)).toBe(1);
  expect(city.isComplete).toBe(true);
});

it("rests where tiles cannot be had, and tries again with the next movement", async () => {
  let isBroken = true;
  const { city, view, messages, asked, draw } = started(() => (isBroken ? new Error("offline") : { info: kInfo }));
  draw();
  await vi.advanceTimersByTimeAsync(1000);
  expect(asked).toEqual([4]);
  expect(messages.message?.text).toBe("offline");
  expect(city.isComplete).toBe(true);
  isBroken = false;
  view.state = { ...view.state, camera: cameraAt(2) };
  await vi.advanceTimersByTimeAsync(1000);
  expect(asked[1]).toBe(4);
  expect(asked.at(-1)).toBe(1);
});

it("fetches nothing more once another model is open", async () => {
  const { city, view, asked, draw } = started();
  draw();
  city.end();
  view.state = { ...view.state, camera: cameraAt(2) };
  await vi.advanceTimersByTimeAsync(1000);
  expect(asked).toEqual([4]);
  expect(city.isComplete).toBe(false);
});
