// The world, end to end: three processes, with entities and clients handed over. One process is killed and its zone
// recreated within two seconds; one is silent and comes back; Redis is stopped and started again. At every tick that
// all zones report, no entity is missing or there twice. Then the same in memory. The world itself reports what the
// test waits for, and limits are counts of its reports, so a slow machine only takes longer.
//
//   npm run test:world
import { equal, ok } from 'node:assert/strict';
import { spawn, spawnSync } from 'node:child_process';
import { once } from 'node:events';
import { existsSync } from 'node:fs';
import { createServer } from 'node:net';
import { createInterface } from 'node:readline';
import { fileURLToPath } from 'node:url';
import { findNode } from '../apart/world-colyseus/newer-node.mjs';

const [zones, entities, clients] = [3, 1500, 24];
const { node, missing } = findNode();
const modules = fileURLToPath(new URL('../apart/node_modules/@colyseus/core', import.meta.url));
const skip = (why) => {
  console.log(`skipped: ${why}`);
  process.exit(process.env.CI ? 1 : 0);
};
if (!existsSync(modules)) skip('npm ci --prefix examples/apart brings what it needs');
if (missing) skip(missing);
if (spawnSync('redis-server', ['--version']).error) skip('redis-server is not installed: apt-get install redis-server');

/** The sum of all ids: a missing or doubled entity changes it. */
const allIds = (entities * (entities - 1)) / 2;
/** The most reports that anything may take; a zone that keeps up makes four per second. */
const patience = 1500;
/** Milliseconds without a report after which none is expected any more. */
const silence = 90_000;

const file = fileURLToPath(new URL('../apart/world-colyseus/index.mjs', import.meta.url));

class World {
  events = [];
  /** The newest report of each zone, and the number of reports. */
  reports = new Map();
  reported = 0;
  /** The newest reports of all zones for the same tick, and the number of such ticks. */
  whole;
  wholes = 0;
  clients = {};
  /** What was wrong in a tick. */
  fault = '';
  /** The end of the standard error of the processes. */
  complaints = '';
  #heard = performance.now();

  constructor(...options) {
    const args = ['--entities', String(entities), '--clients', String(clients), '--seconds', '900', ...options];
    this.child = spawn(node, [file, '--json', ...args], { stdio: ['ignore', 'pipe', 'pipe'] });
    this.child.stderr.on('data', (data) => {
      this.complaints = `${this.complaints}${data}`.slice(-4000);
    });
    this.lines = createInterface({ input: this.child.stdout });
    this.lines.on('line', (line) => {
      const event = JSON.parse(line);
      if (event.report) this.#take({ ...event.report, at: event.at });
      else if (event.clients) this.clients = event.clients;
      else this.events.push(event);
    });
  }

  #take(report) {
    this.#heard = performance.now();
    this.reported++;
    this.reports.set(report.zone, report);
    const all = [...this.reports.values()];
    // Zones that do not know each other run on their own, at ticks with the same numbers.
    if (all.length < zones || all.some(({ tick, beside }) => tick !== report.tick || beside < zones - 1)) return;
    this.whole = all;
    this.wholes++;
    const sum = (name) => all.reduce((total, each) => total + each[name], 0);
    if (sum('entities') === entities && sum('ids') === allIds) return;
    this.fault ||= `tick ${report.tick}: ${sum('entities')} entities with the sum ${sum('ids')}, expected ${entities} with ${allIds}`;
  }

  /** Waits for something; fails if anything is wrong, with the output since then. */
  async until(what, holds) {
    for (const last = this.reported + patience; !this.fault && this.reported < last; ) {
      const value = holds();
      if (value) return value;
      const signal = AbortSignal.timeout(Math.max(0, Math.ceil(this.#heard + silence - performance.now())));
      try {
        await once(this.lines, 'line', { signal });
      } catch {
        break;
      }
    }
    const said = this.events.map(({ at, text }) => `${at} ${text}`).join('\n');
    const reports = [...this.reports.values()].map((report) => JSON.stringify({ ...report, followed: undefined }));
    const state = [said, ...reports, JSON.stringify(this.clients), this.complaints].join('\n');
    throw new Error(`${this.fault || `${this.reported} reports, and not yet: ${what}`}\n${state}`);
  }

  said(pattern, since = 0) {
    return this.events.find(({ text, at }) => at >= since && pattern.test(text ?? ''));
  }

  /** That a zone began, since a time. */
  began(zone, since) {
    return this.events.find(({ begins, at }) => at >= since && begins?.zone === zone);
  }

  /** Waits for a tick after this one that all zones report. */
  wholeAfter = (tick) => this.until(`all zones after tick ${tick}`, () => this.whole?.[0].tick > tick && this.whole);

  async end() {
    const { stdout, stderr } = this.child;
    this.child.kill();
    if (this.child.exitCode === null && this.child.signalCode === null) await once(this.child, 'exit');
    for (const stream of [stdout, stderr]) stream.destroy();
  }
}

/** A free port, followed by as many free ones as the world needs. */
async function freePort() {
  for (;;) {
    const first = 20_000 + Math.floor(Math.random() * 10_000);
    const free = [first, first + 1, first + 2, first + 1000].map(
      (port) =>
        new Promise((resolve) => {
          const server = createServer();
          server.on('error', () => resolve(false));
          server.listen(port, () => server.close(() => resolve(true)));
        }),
    );
    if ((await Promise.all(free)).every(Boolean)) return String(first);
  }
}

/** All three zones run, each in its process, and entities and clients go from one to another. */
async function begins(world) {
  await world.until('a tick of all zones', () => world.whole);
  await world.until('all clients are there', () => world.clients.connected === clients);
  await world.until('clients were handed over', () => world.clients.handedOver >= 3);
  await world.until('entities were handed over', () => world.whole.reduce((sum, { given }) => sum + given, 0) > 20);
  equal(new Set(world.whole.map(({ process }) => process)).size, 3);
  const given = world.whole.reduce((sum, report) => sum + report.given, 0);
  console.log(`three processes: ${given} entities and ${world.clients.handedOver} clients were handed over`);
}

/**
 * A process is killed: within two seconds its zones are recreated elsewhere and take part again, and their clients
 * reconnect.
 */
async function isKilled(world) {
  // The first process is the one whose reports are read.
  const first = Math.min(...world.whole.map(({ port }) => port));
  const victim = await world.until('a zone of another process has clients', () =>
    [...world.reports.values()].find((report) => report.port !== first && report.clients > 0),
  );
  const zonesLost = world.whole.filter((report) => report.process === victim.process).map(({ zone }) => zone);
  const { lost } = world.clients;
  const killed = Date.now();
  process.kill(victim.process, 'SIGKILL');
  let took = 0;
  for (const zone of zonesLost) {
    const anew = await world.until(`zone ${zone} begins anew`, () => world.began(zone, killed));
    const here = new RegExp(`: zone ${zone} is here`);
    const back = await world.until(`others count with zone ${zone}`, () => world.said(here, killed));
    await world.wholeAfter(anew.begins.tick);
    took = Math.max(took, back.at - killed);
    console.log(`killed: "${anew.text}", taken over after ${back.at - killed} ms`);
  }
  ok(world.whole.every((report) => report.process !== victim.process));
  await world.until('all clients are back', () => {
    const { connected, found } = world.clients;
    return connected === clients && world.clients.lost > lost && found === world.clients.lost;
  });
  console.log(`clients: all back, ${world.clients.lost - lost} had lost their room`);
  const said = world.events.filter(({ at }) => at >= killed).map(({ at, text }) => `${at - killed} ms: ${text}`);
  ok(took < 2000, `taken over after ${took} ms, expected less than 2000\n${said.join('\n')}`);
}

/** A zone cannot be reached for a while, though its process is alive: the others go on, and it joins again. */
async function isSilent(world) {
  // Not the first process, whose reports are read; it has zone 0.
  const first = Math.min(...world.whole.map(({ port }) => port));
  const { process: silent, zone, tick } = world.whole.find(({ port }) => port !== first);
  const stopped = Date.now();
  process.kill(silent, 'SIGSTOP');
  try {
    const pattern = new RegExp(`^zone 0: zone ${zone} has said nothing for \\d+ ms \\(.+\\): going on without it`);
    await world.until(`the others go on without zone ${zone}`, () => world.said(pattern, stopped));
    await world.until('they do go on', () => world.reports.get(0).tick > tick + 20);
  } finally {
    process.kill(silent, 'SIGCONT');
  }
  const back = await world.until(`zone ${zone} is back`, () => world.began(zone, stopped));
  await world.wholeAfter(back.begins.tick);
  console.log(`silent: the others went on without zone ${zone}; "${back.text}"`);
}

/** Redis stops and starts again: the world waits, and goes on. */
async function losesRedis(world) {
  const { redis } = world.events.find((event) => event.redis);
  const stopped = Date.now();
  process.kill(redis, 'SIGKILL');
  const gone = /^Redis at port \d+ is gone \(.+\): trying again/;
  await world.until('the zones say that Redis is gone', () => world.said(gone, stopped));
  const back = await world.until('they say that it is back', () => world.said(/^Redis at port \d+ is back/, stopped));
  const { handedOver } = world.clients;
  await world.wholeAfter(world.whole[0].tick);
  await world.until('clients are handed over again', () => world.clients.handedOver > handedOver);
  console.log(`Redis was away for ${back.at - stopped} ms: the world waited, and went on`);
}

/** What is wrong is said, and nothing is started. */
function refuses(expected, ...options) {
  const { status, stdout, stderr } = spawnSync(node, [file, ...options, '--seconds', '9']);
  equal(status, 2);
  ok(String(stderr).startsWith(expected), String(stderr));
  equal(String(stdout), '');
}

refuses('--zones is 0, expected an integer from 1 to 100\n', '--zones', '0');
const port = await freePort();
const world = new World('--port', port);
try {
  await begins(world);
  refuses('listen EADDRINUSE', '--port', port);
  ok(!world.complaints.includes('no entity is free'), world.complaints);
  await isKilled(world);
  await isSilent(world);
  await losesRedis(world);
  console.log(`nobody was missing or there twice in any of ${world.wholes} ticks that were looked at`);
} finally {
  await world.end();
}

const alone = new World('--memory', '--port', await freePort());
try {
  await alone.until('a tick of all zones in memory', () => alone.whole);
  await alone.until('clients are handed over in memory', () => alone.clients.handedOver >= 2);
  equal(new Set(alone.whole.map(({ process }) => process)).size, 1);
  console.log(`in memory: one process, ${alone.clients.handedOver} clients were handed over`);
} finally {
  await alone.end();
}
console.log('the world: all passed');
