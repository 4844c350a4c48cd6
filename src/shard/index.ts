/**
 * Cuts a world into zones, so that several processes or workers together find exactly what one space would. It does no
 * networking: the messages between zones are typed arrays, for you to send.
 *
 * @module broadphase/shard
 */
export type { Delta } from './delta.ts';
export { Shard, type ShardOptions } from './shard.ts';
export { type Borders, Zones, type ZonesOptions } from './zones.ts';
