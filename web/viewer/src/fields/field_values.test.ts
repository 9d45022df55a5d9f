import { afterEach, describe, expect, it } from "vitest";
import { setLanguage } from "../texts";
import { seriesPath, timeIndex, timeText, unitText, valueAt, valueText } from "./field_values";

describe("values and times of fields", () => {
  afterEach(() => setLanguage("en"));

  it("have their unit as people write it, and numbers of the language", () => {
    expect(valueText(21.456, "Cel")).toBe("21.46 °C");
    expect(valueText(0.5, "1")).toBe("0.5");
    expect(unitText("[ppm]")).toBe("[ppm]");
    setLanguage("de");
    expect(valueText(21.456, "Cel")).toBe("21,46 °C");
  });

  it("are durations without an epoch, and dates in the zone of the epoch with one", () => {
    expect(timeText({ epoch: null }, 5400)).toBe("1:30:00");
    expect(timeText({ epoch: null }, -61.5)).toBe("−0:01:01.5");
    expect(timeText({ epoch: "2026-06-21T06:00:00+02:00" }, 3600)).toBe("Jun 21, 2026, 7:00 AM");
    expect(timeText({ epoch: "2026-06-21T23:30:00Z" }, 3600)).toBe("Jun 22, 2026, 12:30 AM");
    expect(timeText({ epoch: "no date" }, 1)).toBe("0:00:01");
  });

  it("find the last time that is not later", () => {
    expect(timeIndex([0, 10, 20], undefined)).toBe(0);
    expect([-5, 0, 9.9, 10, 25].map((seconds) => timeIndex([0, 10, 20], seconds))).toEqual([0, 0, 0, 1, 2]);
  });

  it("are linear between two times, and unknown beside an unknown one", () => {
    const times = [0, 10, 20];
    expect([-5, 0, 2.5, 10, 15, 20, 30].map((seconds) => valueAt(times, [1, 3, null], seconds))).toEqual([1, 1, 1.5, 3, null, null, null]);
    expect(valueAt(times, [null, 3, 4], 5)).toBeNull();
    expect(valueAt([7], [2], 7)).toBe(2);
  });

  it("are a line that missing values interrupt", () => {
    expect(seriesPath([0, 10, 20], [1, 2, 3])).toBe("M0.00 29.00L50.00 15.00L100.00 1.00");
    expect(seriesPath([0, 10, 40], [1, null, 3])).toBe("M0.00 29.00M100.00 1.00");
    expect(seriesPath([0, 10], [2, 2])).toBe("M0.00 15.00L100.00 15.00");
    expect(seriesPath([0], [1])).toBe("");
    expect(seriesPath([0, 10], [null, 1])).toBe("");
  });
});
