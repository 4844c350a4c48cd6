export interface Plan {
  warmUp: number;
  timed: number;
}
export const fewestTimed: number;
export function framesFor(count: number): Plan;
export function strideFor(millisecondsAFrame: number, plan: Plan, budget: number): number | undefined;
export function partOf(frame: number, plan: Plan, stride: number): 'timed' | 'along' | 'no';
