// One process of the world: a Colyseus server with the rooms of some zones, and the page that shows all zones.
// node server.mjs <JSON of { port, zones, entities, redis, rooms, everything }>: the launcher (index.mjs) starts these.
import { fileURLToPath } from 'node:url';
import { matchMaker, Server } from '@colyseus/core';
import { WebSocketTransport } from '@colyseus/ws-transport';
import express from 'express';
import { connect } from './presence.mjs';
import { world } from './world.mjs';
import { ZoneRoom } from './zone-room.mjs';

const options = JSON.parse(process.argv[2]);
const { port, redis, rooms, zones } = options;
const log = (text, event) => console.log(JSON.stringify({ at: Date.now(), process: process.pid, text, ...event }));
const path = (file) => fileURLToPath(new URL(file, import.meta.url));

// A restarted Redis knows no rooms.
const back = () =>
  matchMaker.restoreMissingRoomCaches().catch(({ message }) => log(`rooms cannot be listed: ${message}`));
const { presence, driver, isConnected } = connect(redis, log, back);
ZoneRoom.setup = { ...options, presence, isConnected, log };

/** The newest report of each zone, and the pages that watch. */
const reports = new Map();
const watchers = new Set();

const server = new Server({
  presence,
  driver,
  transport: new WebSocketTransport({ maxPayload: 2 ** 20 }),
  publicAddress: `localhost:${port}`,
  greet: false,
  gracefullyShutdown: false,
  selectProcessIdToCreateRoom: async (_, { process }) => process ?? matchMaker.processId,
  express(app) {
    app.use('/', express.static(path('page')));
    app.get('/reports', (_, response) => {
      response.writeHead(200, { 'Content-Type': 'text/event-stream', 'Cache-Control': 'no-store' });
      response.write(`data: ${JSON.stringify({ world, zones })}\n\n`);
      watchers.add(response);
      response.on('close', () => watchers.delete(response));
    });
    app.get('/process', (_, response) => response.send(matchMaker.processId));
    app.post('/kill/:process', (request, response) => {
      presence.publish('kill', Number(request.params.process));
      response.end();
    });
  },
});
server.define('zone', ZoneRoom).filterBy(['zone']);
await server.listen(port);
await presence.subscribe('kill', (id) => {
  // Like a crash: nothing is cleaned up.
  if (id === process.pid) process.kill(process.pid, 'SIGKILL');
});
await presence.subscribe('reports', (report) => {
  reports.set(report.zone, report);
  for (const watcher of watchers) watcher.write(`data: ${JSON.stringify(report)}\n\n`);
  if (options.prints)
    console.log(JSON.stringify({ at: Date.now(), report: { ...report, places: '', ghostPlaces: '' } }));
});
for (const zone of rooms) await matchMaker.createRoom('zone', { zone });
log(`listens at http://localhost:${port}, with the zones ${rooms.join(', ') || 'of others that die'}`);
