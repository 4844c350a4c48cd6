/**
 * How a world is cut into zones, so that several processes, or workers, find together exactly what one space would. There
 * is no network in it: what zones have to tell each other comes as typed arrays, to be sent in whatever way.
 *
 * @module broadphase/shard
 */
export type { Delta } from './delta.ts';
export { Shard, type ShardOptions } from './shard.ts';
export { type Borders, Zones, type ZonesOptions } from './zones.ts';
