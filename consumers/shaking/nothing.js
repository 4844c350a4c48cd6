// biome-ignore-all lint/correctness/noUnusedImports: what is tried is that bundlers leave it out
import { BroadPhase, findPairs } from 'broadphase';
import { BroadPhase as FullBroadPhase } from 'broadphase/all';
import { drawSpace } from 'broadphase/draw';
import * as ro from 'broadphase/ro';
import { Shard } from 'broadphase/shard';
import { record } from 'broadphase/trace';

console.log('nothing of it is used');
