// The presence and the driver of Colyseus: over Redis, or in memory for a single process.
import { LocalDriver, LocalPresence } from '@colyseus/core';
import { RedisDriver } from '@colyseus/redis-driver';
import { RedisPresence } from '@colyseus/redis-presence';
import { Redis } from 'ioredis';

/**
 * @param port of a Redis on this machine; without it, in memory
 * @param back called when Redis is back
 * @returns presence, driver, and whether they are connected now
 */
export function connect(port, log, back) {
  if (!port) return { presence: new LocalPresence(), driver: new LocalDriver(), isConnected: () => true };
  const options = {
    port,
    host: '127.0.0.1',
    maxRetriesPerRequest: null, // commands wait until it is back
    retryStrategy: (times) => Math.min(50 * times, 500),
  };
  const presence = new RedisPresence(options);
  const client = new Redis(options);
  const clients = [presence.pub, presence.sub, client];
  const isConnected = () => clients.every(({ status }) => status === 'ready');
  let away = false;
  for (const each of clients) {
    each.removeAllListeners('error'); // one message is enough
    each.on('error', ({ message, code }) => {
      if (!away) log(`Redis at port ${port} is gone (${message || code}): trying again until it is back`);
      away = true;
    });
    each.on('ready', () => {
      if (!away || !isConnected()) return;
      away = false;
      log(`Redis at port ${port} is back: going on`);
      back();
    });
  }
  return { presence, driver: new RedisDriver(client), isConnected };
}
