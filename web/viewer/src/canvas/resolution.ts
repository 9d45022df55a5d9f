/** How many pixels a moving picture may have, so that frames come every 30 to 60 ms. */

const kFast = 30, kSlow = 60, kAim = 45;
const kCoarsest = 0.2;

/** Share of the picture's width and height; starts small, so that the first image comes soon. */
export class Resolution {
  share = 0.3;

  /** Learns from a moving frame that took so long. */
  learn(milliseconds: number): void {
    if (milliseconds >= kFast && milliseconds <= kSlow) return;
    const wanted = this.share * Math.sqrt(kAim / Math.max(1, milliseconds));
    // One slow frame may be chance; the way back is as short.
    const bounded = Math.min(this.share * 1.5, Math.max(this.share * 0.5, wanted));
    this.share = Math.min(1, Math.max(kCoarsest, bounded));
  }
}

/** Pixels of a picture at a share of its size; even a coarse one has some. */
export function pixelsAt(full: [number, number], share: number): [number, number] {
  return [Math.max(16, Math.round(full[0] * share)), Math.max(16, Math.round(full[1] * share))];
}
