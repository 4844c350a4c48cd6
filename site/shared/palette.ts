// The colours of the boxes, light and dark, made in OKLCH so that no hue stands out.
// The conversion is B. Ottosson's, https://bottosson.github.io/posts/oklab/.
import { cellSlot, chosenSlot, heatSlot, heats, hues, partnerSlot, shades, slotCount } from './groups.ts';

const gamma = (c: number) => {
  const v = Math.min(1, Math.max(0, c));
  return v <= 0.0031308 ? 12.92 * v : 1.055 * v ** (1 / 2.4) - 0.055;
};

/** sRGB, 0 to 1, of a lightness (0 to 1), a chroma and a hue in degrees. */
function oklch(lightness: number, chroma: number, hue: number): [number, number, number] {
  const a = chroma * Math.cos((hue * Math.PI) / 180);
  const b = chroma * Math.sin((hue * Math.PI) / 180);
  const l = (lightness + 0.3963377774 * a + 0.2158037573 * b) ** 3;
  const m = (lightness - 0.1055613458 * a - 0.0638541728 * b) ** 3;
  const s = (lightness - 0.0894841775 * a - 1.291485548 * b) ** 3;
  return [
    gamma(4.0767416621 * l - 3.3077115913 * m + 0.2309699292 * s),
    gamma(-1.2684380046 * l + 2.6097574011 * m - 0.3413193965 * s),
    gamma(-0.0041960863 * l - 0.7034186147 * m + 1.707614701 * s),
  ];
}

export interface Palette {
  /** Red, green, blue, alpha of every slot, 0 to 1. */
  slots: Float32Array;
  background: readonly [number, number, number];
}

/** The palette for a light or dark page of this background, as '#rrggbb'. */
export function makePalette(dark: boolean, background: string): Palette {
  const slots = new Float32Array(slotCount * 4);
  slots.set([...oklch(dark ? 0.5 : 0.68, 0.012, 260), dark ? 0.62 : 0.6]);
  for (let hue = 0; hue < hues; hue++) {
    for (let shade = 0; shade < shades; shade++) {
      const depth = shade / (shades - 1);
      const lightness = dark ? 0.7 + 0.13 * depth : 0.68 - 0.18 * depth;
      const colour = oklch(lightness, 0.14 + 0.03 * depth, 15 + (hue * 360) / hues);
      slots.set([...colour, 1], (1 + hue * shades + shade) * 4);
    }
  }
  slots.set([...oklch(dark ? 0.74 : 0.5, 0.11, 265), dark ? 0.42 : 0.36], cellSlot * 4);
  for (let heat = 0; heat < heats; heat++) {
    const depth = heat / (heats - 1);
    slots.set(
      [...oklch(0.78 - 0.16 * depth, 0.15 + 0.05 * depth, 75 - 45 * depth), 0.3 + 0.6 * depth],
      (heatSlot + heat) * 4,
    );
  }
  slots.set([...oklch(dark ? 0.97 : 0.2, 0, 0), 1], chosenSlot * 4);
  slots.set([...oklch(dark ? 0.85 : 0.42, 0.03, 265), 1], partnerSlot * 4);
  const part = (at: number) => Number.parseInt(background.slice(at, at + 2), 16) / 255;
  return { slots, background: [part(1), part(3), part(5)] };
}
