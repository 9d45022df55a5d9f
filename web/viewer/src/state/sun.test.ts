import { describe, expect, it } from "vitest";
import { firstSun, isSun, sunTimeOf, textOfSunTime } from "./sun";

describe("the sun", () => {
  it("is a day of the year and an hour", () => {
    expect(sunTimeOf("2026-06-21 15:00")).toEqual({ year: 2026, day: 172, hour: 15, zone: "" });
    expect(sunTimeOf("2028-12-31 08:30+02:00")).toEqual({ year: 2028, day: 366, hour: 8.5, zone: "+02:00" });
    expect(sunTimeOf("at noon")).toBeNull();
    for (const text of ["2026-01-01 00:00", "2026-12-31 23:45", "2028-02-29 12:15Z"]) expect(textOfSunTime(sunTimeOf(text)!)).toBe(text);
    expect(textOfSunTime({ year: 2026, day: 172, hour: 24, zone: "" })).toBe("2026-06-21 23:59");
  });

  it("is recognized in links", () => {
    expect(isSun(firstSun(2026))).toBe(true);
    expect(isSun({ time: "2026-06-21 15:00", place: [52.5, 13.4] })).toBe(true);
    for (const other of [null, 3, {}, { time: 3 }, { time: "", place: [1] }, { time: "", place: ["a", 2] }])
      expect(isSun(other)).toBe(false);
  });
});
