// A number with its range: told when it is let go, and brought back when the run refuses it.
import { DEG, el, fixed, setText } from '../dom';
import type { Parameter } from '../protocol';

const SCREEN: Record<string, [number, string]> = { m: [1000, 'mm'], rad: [DEG, 'deg'], '1': [1, ''] };
const STEPS = 400; // of a slider at least

function readable(name: string): string {
  return name.replace(/_(1_s2|1_s|m|s|rad|N|Nm)(\.|$)/, '$2').replaceAll(/[_.]/g, ' ');
}

export class Slider {
  readonly element: HTMLElement;
  private readonly scale: number;
  private readonly unit: string;
  private readonly digits: number;
  private readonly shown = el('b', {});
  private readonly input: HTMLInputElement;
  private held = NaN; // what the run has

  constructor(parameter: Parameter, send: (value: number) => void, label = readable(parameter.name)) {
    [this.scale, this.unit] = SCREEN[parameter.unit] ?? [1, parameter.unit.replace('s2', 's²')];
    const [low, high] = [parameter.low * this.scale, parameter.high * this.scale];
    this.digits = Math.max(0, Math.ceil(Math.log10(STEPS / (high - low))));
    this.input = el('input', {
      type: 'range',
      min: low,
      max: high,
      step: 10 ** -this.digits,
      'data-parameter': parameter.name,
    });
    this.input.addEventListener('input', () => this.tell());
    this.input.addEventListener('change', () => {
      send(Math.min(parameter.high, Math.max(parameter.low, Number(this.input.value) / this.scale)));
    });
    const range = `${fixed(low, this.digits)} to ${fixed(high, this.digits)} ${this.unit}`;
    this.element = el(
      'label',
      { class: 'slider', title: `${parameter.text}; ${range}` },
      el('span', {}, label),
      this.input,
      this.shown,
    );
    this.set(parameter.default);
  }

  private tell(): void {
    const text = fixed(Number(this.input.value), this.digits);
    setText(this.shown, `${Number(text) === 0 ? text.replace('-', '') : text} ${this.unit}`);
  }

  // What the run has now.
  set(value: number): void {
    this.held = value;
    this.input.value = String(value * this.scale);
    this.tell();
  }

  back(): void {
    this.set(this.held);
  }
}
