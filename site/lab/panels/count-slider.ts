// The slider for the number of boxes: logarithmic, in counts of two digits.
import { formatCount } from '../../shared/format.ts';
import { mostBoxes } from '../catalog.ts';

const least = 100;

export interface CountSlider {
  /** The slider keeps the count that was chosen; `count` is the actual number of boxes. */
  show(count: number, enabled: boolean): void;
}

/** @param changed called with a count that was chosen */
export function createCountSlider(
  slider: HTMLInputElement,
  first: number,
  changed: (count: number) => void,
): CountSlider {
  const last = Number(slider.max);
  slider.valueAsNumber = Math.round(Math.max(0, Math.log(first / least) / Math.log(mostBoxes / least)) * last);
  slider.addEventListener('input', () => {
    const count = least * (mostBoxes / least) ** (slider.valueAsNumber / last);
    const digit = 10 ** (Math.floor(Math.log10(count)) - 1);
    changed(Math.round(count / digit) * digit);
  });
  return {
    show(count, enabled) {
      slider.disabled = !enabled;
      slider.style.setProperty('--filled', `${(100 * slider.valueAsNumber) / last}%`);
      slider.setAttribute('aria-valuetext', `${formatCount(count)} boxes`);
    },
  };
}
