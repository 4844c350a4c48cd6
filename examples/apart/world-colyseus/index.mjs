// A seamless world on Colyseus: each zone is a room in a process of its own, and a page shows them all.
//
//   npm i && npm start
//   npm start -- --clients 300
//
// --zones 3, --entities 10000, --port 2567: the numbers, and the port of the first process
// --clients 60: simulated clients, in a process of their own
// --memory: one process, without Redis: the default if redis-server is not installed
// --everything: no interest management, for comparison: every client is sent its whole room
// --seconds 60: ends after this time; --json: reports and events as lines of JSON
import { spawn, spawnSync } from 'node:child_process';
import { createServer } from 'node:net';
import { createInterface } from 'node:readline';
import { fileURLToPath } from 'node:url';
import { parseArgs } from 'node:util';
import { needNewerNode } from './newer-node.mjs';

await needNewerNode();
const { values } = parseArgs({
  options: {
    zones: { type: 'string', default: '3' },
    entities: { type: 'string', default: '10000' },
    port: { type: 'string', default: '2567' },
    clients: { type: 'string', default: '60' },
    memory: { type: 'boolean', default: false },
    everything: { type: 'boolean', default: false },
    seconds: { type: 'string' },
    json: { type: 'boolean', default: false },
  },
});

function stop(why) {
  console.error(why);
  process.exit(2);
}

const whole = ([name, least, most]) => {
  const value = Number(values[name]);
  if (Number.isInteger(value) && value >= least && value <= most) return value;
  return stop(`--${name} is ${values[name]}, expected an integer from ${least} to ${most}`);
};
const [zones, entities, port, clients] = [
  ['zones', 1, 100],
  ['entities', 0, 2 ** 16],
  ['port', 1, 64_000],
  ['clients', 0, 1000],
].map(whole);
const path = (file) => fileURLToPath(new URL(file, import.meta.url));
const children = new Set();
let ending = false;

function say(event) {
  if (values.json) console.log(JSON.stringify({ at: Date.now(), ...event }));
  else if (event.text) console.log(`${event.process ? `[${event.process}] ` : ''}${event.text}`);
}

/** Starts a process whose lines are events. */
function start(file, options, ended) {
  const child = spawn(process.execPath, [path(file), JSON.stringify(options)], {
    stdio: ['ignore', 'pipe', 'inherit'],
    // In milliseconds: how long a request for a seat waits for a process that has just died.
    env: { ...process.env, COLYSEUS_PRESENCE_SHORT_TIMEOUT: '500' },
  });
  children.add(child);
  createInterface({ input: child.stdout }).on('line', (line) => {
    try {
      const event = JSON.parse(line);
      say(event);
      startClients(event);
    } catch {
      say({ text: line });
    }
  });
  child.on('close', (code, signal) => {
    children.delete(child);
    if (!ending) ended?.(code, signal);
  });
  return child;
}

/** Starts Debian's redis-server on a port of its own; returns the port, or undefined if it is not installed. */
async function startRedis() {
  if (spawnSync('redis-server', ['--version']).error) {
    say({ text: 'redis-server is not installed (apt-get install redis-server): one process, in memory' });
    return undefined;
  }
  const at = port + 1000;
  const run = () => {
    const redis = spawn('redis-server', ['--port', String(at), '--save', '', '--appendonly', 'no'], {
      stdio: 'ignore',
    });
    children.add(redis);
    redis.on('close', () => {
      children.delete(redis);
      if (ending) return;
      say({ text: 'redis-server ended: another is started in a second' });
      setTimeout(run, 1000);
    });
    say({ text: `redis-server listens at port ${at}`, redis: redis.pid });
  };
  run();
  return at;
}

function end() {
  ending = true;
  for (const child of children) child.kill();
  setTimeout(() => process.exit(), 300);
}
process.on('SIGINT', end);
process.on('SIGTERM', end);

/** Another world may be running. */
async function mustBeFree(at) {
  const server = createServer();
  await new Promise((resolve) => {
    server.once('error', ({ message }) => stop(`${message}; --port chooses other ports`));
    server.listen(at, resolve);
  });
  await new Promise((resolve) => server.close(resolve));
}

const begun = new Set();

/** Starts the clients once all zones have begun: before, no entity is free. */
function startClients({ begins }) {
  if (begins === undefined || begun.size === zones) return;
  if (begun.add(begins.zone).size < zones || clients === 0) return;
  start('clients.mjs', { ports: redis ? all.map((each) => port + each) : [port], zones, clients });
}

for (let k = 0; k < (values.memory ? 1 : zones); k++) await mustBeFree(port + k);
if (!values.memory) await mustBeFree(port + 1000);
const redis = values.memory ? undefined : await startRedis();
const all = Array.from({ length: zones }, (_, zone) => zone);
const { everything } = values;

/** Milliseconds before a dead process is restarted: first the remaining processes take over its zones. */
const restartTime = 2000;

/** Starts a process with these zones. If it dies, a process without zones is started in its place. */
function startServer(number, rooms) {
  const options = {
    port: port + number,
    zones,
    entities,
    redis,
    rooms,
    everything,
    prints: values.json && number === 0,
  };
  const child = start('server.mjs', options, (code, signal) => {
    say({
      text: `the process at port ${port + number} ended (${signal ?? code}): another is started in ${restartTime} ms`,
      died: child.pid,
    });
    setTimeout(() => !ending && startServer(number, []), restartTime);
  });
  say({ text: `started at port ${port + number}`, process: child.pid, started: rooms });
}

if (redis) for (const zone of all) startServer(zone, [zone]);
else startServer(0, all);
if (values.seconds) setTimeout(end, 1000 * Number(values.seconds));
