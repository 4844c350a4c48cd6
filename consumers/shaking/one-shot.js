import { findPairs } from 'broadphase';

console.log(String(findPairs([0, 0, 10, 10, 5, 5, 15, 15])));
