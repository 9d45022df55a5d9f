import { expect, it } from "vitest";
import { Resolution } from "./resolution";

/** The share after frames of a machine that needs `cost` milliseconds for all pixels. */
function adapted(cost: number, frames = 60): number {
  const resolution = new Resolution();
  for (let n = 0; n < frames; ++n) resolution.learn(cost * resolution.share ** 2);
  return resolution.share;
}

it("takes all pixels where they are quick, and a fifth of width and height where they are slow", () => {
  expect(adapted(10)).toBe(1);
  expect(adapted(10_000)).toBe(0.2);
});

it("finds the share whose frames take 26 to 38 ms", () => {
  for (const cost of [60, 150, 400, 700]) {
    const milliseconds = cost * adapted(cost) ** 2;
    expect(milliseconds).toBeGreaterThanOrEqual(26);
    expect(milliseconds).toBeLessThanOrEqual(38);
  }
});

it("is not moved by one slow frame among usual ones", () => {
  const resolution = new Resolution();
  for (const milliseconds of [32, 90, 32, 30, 34, 90]) resolution.learn(milliseconds);
  expect(resolution.share).toBe(0.3);
});
