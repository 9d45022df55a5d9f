import { expect, it, vi } from "vitest";
import type { Engine, FrameReport } from "../engine";
import type { Described } from "../state/scene_of";
import { PictureLoop, type Quality } from "./picture_loop";

/** A loop whose pictures are completed manually. */
function start() {
  const shown: Quality[] = [];
  const finish: (() => void)[] = [];
  const draw = (_: unknown, width: number, height: number) =>
    new Promise<FrameReport>((done) => finish.push(() => done({ width, height, milliseconds: 1 } as FrameReport)));
  const loop = new PictureLoop({
    engine: { draw } as unknown as Engine,
    size: () => [640, 360],
    describe: () => ({ scene: {}, effects: {} }) as unknown as Described,
    shown: (_, quality) => shown.push(quality),
    take: () => null,
    failed: (error) => expect.fail(String(error)),
  });
  const next = async () => {
    await vi.waitFor(() => expect(finish.length).toBe(1));
    finish.pop()!();
    await Promise.resolve();
  };
  return { loop, shown, finish, next };
}

it("goes from coarse to fine", async () => {
  vi.stubGlobal("window", globalThis);
  const { loop, shown, next } = start();
  loop.invalidate();
  for (let n = 0; n < 3; ++n) await next();
  await vi.waitFor(() => expect(shown).toEqual(["moving", "full", "fine"]));
});

it("never calls a picture fine that lacks the newest change", async () => {
  vi.stubGlobal("window", globalThis);
  const { loop, shown, finish, next } = start();
  loop.invalidate();
  await next();
  await next();
  await vi.waitFor(() => expect(finish.length).toBe(1));
  loop.invalidate();
  await next();
  await vi.waitFor(() => expect(shown).toEqual(["moving", "full", "moving"]));
});
