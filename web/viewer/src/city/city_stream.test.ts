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
  const asked: number[] = [],
    shown: string[] = [],
    files = { askedUntil: 0, forget: vi.fn() };
  const look = async (options: CityOptions) => {
    asked.push(options.pixels);
    shown.push(options.shown);
    await new Promise((done) => setTimeout(done, 10));
    const given = answer(options);
    if (given instanceof Error) throw given;
    return { info: null, key: "k", lacks: [], pixels: options.pixels, ...given } as CityLook;
  };
  volume.engine = {
    followCity: (_files: unknown, _scene: unknown, _size: unknown, options: CityOptions) => look(options),
    cityInfo: () => Promise.resolve(kInfo),
  } as unknown as Engine;
  const city = new CityStream(files as unknown as CityFiles, { ...parts, selection, picture });
  city.show(kInfo);
  view.state = { ...view.state, camera: cameraAt(1) };
  city.begin();
  const draw = () => (picture.report = { width: 9, height: 9, milliseconds: 1, engine: "cpu" });
  return { city, view, messages, files, asked, shown, draw };
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

const kLack = "packs/00000.svtp: the server does not answer";

it("fetches missing tiles again, later each time, and no more once they have come", async () => {
  let lacks: string[] = [kLack, kLack];
  const { city, messages, files, asked, shown, draw } = started(() => ({ info: kInfo, lacks }));
  draw();
  await vi.advanceTimersByTimeAsync(1000);
  expect(city.isComplete).toBe(true);
  expect(city.lacks).toEqual([kLack, kLack]);
  expect(messages.said).toContain("2 tiles of the city cannot be shown");
  const times: number[] = [];
  const first = asked.length;
  const start = Date.now();
  for (let seen = first; Date.now() - start < 9000; await vi.advanceTimersByTimeAsync(100))
    if (asked.length > seen) {
      seen = asked.length;
      times.push(Date.now() - start);
    }
  expect(times.length).toBe(2);
  expect(times[1]! - times[0]!).toBeGreaterThan(3500);
  expect(shown.slice(first)).toEqual(["", ""]);
  expect(files.forget).toHaveBeenCalledWith(["packs/00000.svtp"]);
  lacks = [];
  await vi.advanceTimersByTimeAsync(20_000);
  expect(city.lacks).toEqual([]);
  expect(messages.said).toBe("The missing tiles have come.");
  const last = asked.length;
  await vi.advanceTimersByTimeAsync(600_000);
  expect(asked.length).toBe(last);
});

it("stops to fetch missing tiles after some rounds, until the user asks for them", async () => {
  let lacks: string[] = [kLack];
  const { city, asked, draw } = started(() => ({ info: kInfo, lacks }));
  draw();
  await vi.advanceTimersByTimeAsync(1000);
  const first = asked.length;
  await vi.advanceTimersByTimeAsync(3_600_000);
  expect(asked.length).toBe(first + 5);
  lacks = [];
  city.fetchAgain();
  expect(city.isFetchingAgain).toBe(true);
  city.fetchAgain();
  await vi.advanceTimersByTimeAsync(1000);
  expect(asked.length).toBe(first + 6);
  expect([city.isFetchingAgain, city.lacks]).toEqual([false, []]);
});

it("waits as long as the server asks for, but not for hours", async () => {
  const { city, files, asked, draw } = started(() => ({ info: kInfo, lacks: [kLack] }));
  files.askedUntil = Date.now() + 30_000;
  draw();
  await vi.advanceTimersByTimeAsync(1000);
  const first = asked.length;
  await vi.advanceTimersByTimeAsync(28_000);
  expect(asked.length).toBe(first);
  files.askedUntil = Date.now() + 7_200_000;
  await vi.advanceTimersByTimeAsync(2000);
  expect(asked.length).toBe(first + 1);
  await vi.advanceTimersByTimeAsync(7_300_000);
  expect(asked.length).toBe(first + 1);
  city.end();
});

it("continues by itself after an interruption, and takes its message back", async () => {
  let isBroken = true;
  const { city, messages, asked, draw } = started(() => (isBroken ? new Error("offline") : { info: kInfo }));
  draw();
  await vi.advanceTimersByTimeAsync(1000);
  expect([city.isStopped, messages.message?.text]).toEqual([true, "offline"]);
  isBroken = false;
  await vi.advanceTimersByTimeAsync(3000);
  expect([city.isStopped, messages.message]).toEqual([false, null]);
  expect(asked.at(-1)).toBe(1);
});
