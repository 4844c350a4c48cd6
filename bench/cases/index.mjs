// The cases: one JSON file each under cases/, and the recordings of a folder that is given. A case names a scene of
// src/scenes and its number of boxes, or a recording and a part of it: the first frame, and the frame before which to
// stop. `engineMs` and `bestNativeMs` are the times of its own engine and of the fastest native library.
import { readdirSync, readFileSync } from 'node:fs';
import { basename, resolve } from 'node:path';
import { fileURLToPath } from 'node:url';

const folder = fileURLToPath(new URL('./', import.meta.url));
const recordings = /\.(bin|trace)(\.gz)?$/;

/** All cases, by name. Those of the README come first, so that a run that ends early has them. */
export function loadCases(traces) {
  const cases = readdirSync(folder)
    .filter((file) => file.endsWith('.json'))
    .map((file) => {
      const item = JSON.parse(readFileSync(folder + file, 'utf8'));
      if (item.recording) item.recording = resolve(folder, '../..', item.recording);
      return { name: basename(file, '.json'), ...item };
    });
  if (traces) {
    for (const file of readdirSync(traces)
      .filter((name) => recordings.test(name))
      .sort()) {
      cases.push({ name: file.replace(recordings, ''), recording: resolve(traces, file) });
    }
  }
  const headline = ['uniform2d', 'mixed2d', 'clustered2d', 'uniform3d', 'rain'];
  const rank = ({ name }) => (headline.indexOf(name) + headline.length + 1) % (headline.length + 1);
  cases.sort((a, b) => rank(a) - rank(b) || (a.name < b.name ? -1 : 1));
  return new Map(cases.map((item) => [item.name, item]));
}
