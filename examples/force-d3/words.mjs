// Invented words and places, the same each time.

/** Pseudorandom numbers from 0 to 1, the same for the same seed. */
export function seeded(seed) {
  let state = seed;
  return () => {
    state = (Math.imul(state, 1664525) + 1013904223) >>> 0;
    return state / 2 ** 32;
  };
}

const starts = ['Ka', 'Lo', 'Mi', 'Ren', 'Ta', 'Bor', 'Se', 'Ul', 'Ha', 'Dri', 'No', 'Vel', 'Ash', 'Ost', 'Mar', 'Win'];
const middles = ['', '', 'ra', 'li', 'mo', 'nde', 'ster', 'vi', 'ka', 'bu', 'se'];
const ends = ['ford', 'wick', 'na', 'dal', 'mere', 'stad', 'ton', 'by', 'len', 'heim', 'ra', 'burg', 'os'];

/** The word for a number. */
export const wordOf = (k) => starts[(k * 7) % 16] + middles[(k * 5) % 11] + ends[(k * 3) % 13];

/** The width and height of the map, in units. */
export const mapSize = [1000, 640];

/** Places with names, the largest first, most of them near one of the cities. */
export function placesOf(count) {
  const random = seeded(11);
  const bell = () => random() + random() + random() - 1.5;
  const cities = Array.from({ length: 90 }, () => [mapSize[0] * random(), mapSize[1] * random(), 6 + 50 * random()]);
  return Array.from({ length: count }, (_, k) => {
    const [cityX, cityY, reach] = cities[k < 90 ? k : Math.floor(90 * random() ** 1.4)];
    const far = k < 90 ? 0 : k % 5 === 0 ? 260 : reach;
    return {
      name: wordOf(k),
      x: cityX + far * bell(),
      y: cityY + far * bell(),
      size: Math.max(10, 18 - 2 * Math.log10(k + 1) * 1.1),
    };
  });
}
