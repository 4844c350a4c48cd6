// What BroadPhase promises, by topic: signatures and their documentation, without code.
import type { Dimensions } from '../dimensions.ts';
import type { Contents } from './contents.ts';
import type { ManyQueries } from './many-queries.ts';
import type { Pairs } from './pairs.ts';
import type { Queries } from './queries.ts';
import type { Rules } from './rules.ts';
import type { Upkeep } from './upkeep.ts';

export interface Api<D extends Dimensions> extends Contents<D>, Rules, Pairs<D>, Queries<D>, ManyQueries, Upkeep {}
