// How finely is drawn: as fine as the machine keeps up with, judged by the time between pictures.

export interface Tier {
  scale: number; // pixels of the picture by pixels of the screen
  fine: boolean; // the robot's fine surface
  fineSoil: boolean; // a vertex a cell, else one for four
  shadowEvery: number; // pictures; 0 none
}

export const TIERS: Tier[] = [
  { scale: 2, fine: true, fineSoil: true, shadowEvery: 1 },
  { scale: 1, fine: true, fineSoil: true, shadowEvery: 1 },
  { scale: 1, fine: false, fineSoil: true, shadowEvery: 2 },
  { scale: 0.75, fine: false, fineSoil: false, shadowEvery: 3 },
  { scale: 0.6, fine: false, fineSoil: false, shadowEvery: 4 },
  { scale: 0.45, fine: false, fineSoil: false, shadowEvery: 0 },
];
const SLOW_MS = 40;
const QUICK_MS = 19;
const WINDOW = 24; // pictures
const PATIENCE = 10; // quick windows before it is tried finer

export class Quality {
  tier: number;
  private readonly gaps: number[] = [];
  private quick = 0;
  private failed = new Map<number, number>(); // tier -> how often it was too slow

  private readonly held: boolean;

  // held: a tier to stay at (the page's ?quality=0..5), or NaN.
  constructor(pixelRatio: number, software: boolean, held: number) {
    this.held = held in TIERS;
    this.tier = this.held ? held : software ? 3 : pixelRatio > 1 ? 0 : 1;
  }

  // True when the tier has changed. gap_ms: since the last picture, while pictures follow each other.
  note(gap_ms: number): boolean {
    if (this.held || gap_ms > 400) return false; // the page was hidden, or stood still
    this.gaps.push(gap_ms);
    if (this.gaps.length < WINDOW) return false;
    const median = [...this.gaps].sort((a, b) => a - b)[WINDOW >> 1];
    this.gaps.length = 0;
    if (median > SLOW_MS && this.tier + 1 < TIERS.length) {
      this.failed.set(this.tier, (this.failed.get(this.tier) ?? 0) + 1);
      this.tier++;
      this.quick = 0;
      return true;
    }
    this.quick = median < QUICK_MS ? this.quick + 1 : 0;
    const patience = PATIENCE * 4 ** (this.failed.get(this.tier - 1) ?? 0);
    if (this.quick < patience || this.tier === 0 || (this.tier === 1 && devicePixelRatio <= 1)) return false;
    this.tier--;
    this.quick = 0;
    return true;
  }
}
