// Figures of the world: milliseconds per tick and zone for one, two and three zones (CPU: the whole process), what a
// ghost costs on the wire, how many clients there may be before ticks are late, and the same if every client is sent
// its whole room.
//
//   node measure.mjs [--seconds 20]
import { spawn } from 'node:child_process';
import { createInterface } from 'node:readline';
import { fileURLToPath } from 'node:url';
import { parseArgs } from 'node:util';
import { needNewerNode } from './newer-node.mjs';

await needNewerNode();
const { values } = parseArgs({
  options: { seconds: { type: 'string', default: '20' }, only: { type: 'string' } },
});
/** The last seconds of a run, which count. */
const counted = 8;

const runs = [
  { zones: 1, clients: 300 },
  { zones: 2, clients: 300 },
  { zones: 3, clients: 300 },
  { zones: 1, clients: 100 },
  { zones: 1, clients: 150 },
  { zones: 1, clients: 200 },
  { zones: 3, clients: 600 },
  { zones: 1, clients: 5, everything: true },
  { zones: 1, clients: 30, everything: true },
  { zones: 3, clients: 30, everything: true },
  { zones: 3, clients: 300, everything: true },
];

function play({ zones, clients, everything }, port) {
  const file = fileURLToPath(new URL('index.mjs', import.meta.url));
  const args = ['--json', '--zones', zones, '--clients', clients, '--port', port, '--seconds', values.seconds];
  const child = spawn(process.execPath, [file, ...args.map(String), ...(everything ? ['--everything'] : [])], {
    stdio: ['ignore', 'pipe', 'ignore'],
  });
  const events = [];
  createInterface({ input: child.stdout }).on('line', (line) => events.push(JSON.parse(line)));
  return new Promise((resolve) => child.on('close', () => resolve(events)));
}

const rows = [];
for (const [k, run] of runs.entries()) {
  if (values.only !== undefined && !values.only.split(',').includes(String(k))) continue;
  const events = await play(run, 28000 + 10 * k);
  const end = events.at(-1).at;
  const late = events.filter(({ at }) => at > end - 1000 * counted);
  const reports = late.flatMap(({ report }) => report ?? []);
  const clients = late.flatMap(({ clients }) => clients ?? []);
  const sum = (name) => reports.reduce((total, report) => total + report[name], 0);
  const grown = (name) => {
    let total = 0;
    for (let zone = 0; zone < run.zones; zone++) {
      const of = reports.filter((report) => report.zone === zone);
      if (of.length > 1) total += of.at(-1)[name] - of[0][name];
    }
    return total;
  };
  const ticks = sum('ticks');
  rows.push({
    zones: run.zones,
    clients: clients.at(-1)?.connected ?? 0,
    'sent to each': run.everything ? 'all of its room' : 'what it sees',
    'CPU ms a tick and zone': (grown('cpu') / 1000 / ticks).toFixed(2),
    'ms a tick and zone': (sum('work') / ticks).toFixed(2),
    worst: Math.max(...reports.map(({ worst }) => worst)).toFixed(1),
    'ticks a second': (ticks / run.zones / counted).toFixed(1),
    'late ticks': `${((100 * grown('late')) / ticks).toFixed(0)} %`,
    'ghosts a zone': (sum('ghosts') / reports.length).toFixed(0),
    'bytes a ghost': run.zones > 1 ? (grown('bytes') / grown('records')).toFixed(0) : '',
    'handed over': clients.at(-1)?.handedOver ?? 0,
    'patches a second and client': (
      ((clients.at(-1)?.patches ?? 0) - (clients[0]?.patches ?? 0)) /
      (clients.length - 1) /
      (clients.at(-1)?.connected ?? 0)
    ).toFixed(1),
  });
  console.log(JSON.stringify(rows.at(-1)));
}
console.table(rows);
