/** Pixel budget of a moving picture for 25 frames per second; the page itself needs some milliseconds. */

const kAim = 32,
  kFast = 26,
  kSlow = 38;
/** Limits at which one frame is sufficient evidence. */
const kMuchTooFast = 12,
  kMuchTooSlow = 100;
const kCoarsest = 0.2;

/** Fraction of the picture's width and height; starts small, so that the first image appears quickly. */
export class Resolution {
  share = 0.3;
  private recent: number[] = [];

  /** Adapts to the time of a moving frame. A single slow frame may be an outlier: the median of three decides. */
  learn(milliseconds: number): void {
    this.recent.push(milliseconds);
    const isPlain = milliseconds < kMuchTooFast || milliseconds > kMuchTooSlow;
    if (this.recent.length < 3 && !isPlain) return;
    const middle = this.recent.sort((a, b) => a - b)[this.recent.length >> 1]!;
    this.recent = [];
    if (middle >= kFast && middle <= kSlow) return;
    const wanted = this.share * Math.sqrt(kAim / Math.max(1, middle));
    this.share = Math.min(1, Math.max(kCoarsest, this.share * 0.6, Math.min(this.share * 1.5, wanted)));
  }
}

/** Pixels of a picture at a fraction of its size; even a coarse one has a minimum. */
export function pixelsAt(full: [number, number], share: number): [number, number] {
  return [Math.max(16, Math.round(full[0] * share)), Math.max(16, Math.round(full[1] * share))];
}
