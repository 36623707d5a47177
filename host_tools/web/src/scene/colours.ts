// The colours of the marks, the same in the 3D view and in the plots.

export const COM = '#fac714';
export const COP = '#ff5a5f';
export const CP = '#2fd08a';
export const RIGHT = '#f08a3c';
export const LEFT = '#4b97ff';
export const PUSH = '#e25bc9';
export const REFERENCE = '#8b98a9';

// Sinkage: full, half, untouched, half raised, fully raised; the rise has a fifth of the scale.
export const SOIL: [number, number, number][] = [
  [24, 50, 100],
  [92, 122, 152],
  [205, 180, 138],
  [232, 214, 176],
  [255, 246, 222],
];
export const SOIL_RISE_SHARE = 0.2;

export function soilColour(change_m: number, full_scale_m: number, out: [number, number, number]): void {
  const share = change_m < 0 ? change_m / full_scale_m : change_m / (SOIL_RISE_SHARE * full_scale_m);
  const place = Math.min(Math.max(2 + 2 * share, 0), 3.9999);
  const k = Math.floor(place);
  const f = place - k;
  for (let i = 0; i < 3; i++) out[i] = SOIL[k][i] + f * (SOIL[k + 1][i] - SOIL[k][i]);
}
