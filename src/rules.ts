// Which boxes may be a pair: setting rules, and reading them back. The kernel stores the rules of a box by its id.
import { badNumber, checkBits, checkBoolean, checkId, isFinitePositive, noBox } from './errors.ts';
import { enabledAt, groupAt, layerAt, maskAt, reachAt, staticAt } from './generated/abi.ts';
import type { KernelInstance } from './kernel/instance.ts';

/** What a box meets: see {@link BroadPhase.setFilter}. */
export interface Filter {
  /** What the box is: 32 bits. */
  layer: number;
  /** What it meets: 32 bits. */
  mask: number;
}

type Call = 'set_filter' | 'set_static' | 'set_enabled' | 'set_group' | 'set_reach';

export function setFilter(instance: KernelInstance, id: number, layer: number, mask: number): void {
  checkBits('setFilter: layer', layer);
  checkBits('setFilter: mask', mask);
  const rule = ruleInKernel(instance, 'setFilter', id);
  if (rule?.[layerAt] === layer && rule[maskAt] === mask) return;
  send(instance, 'setFilter', 'set_filter', id, layer, mask);
}

export function setStatic(instance: KernelInstance, id: number, isStatic: boolean): void {
  checkBoolean('setStatic: isStatic', isStatic);
  change(instance, 'setStatic', 'set_static', id, staticAt, isStatic ? 1 : 0);
}

export function setEnabled(instance: KernelInstance, id: number, enabled: boolean): void {
  checkBoolean('setEnabled: enabled', enabled);
  change(instance, 'setEnabled', 'set_enabled', id, enabledAt, enabled ? 1 : 0);
}

export function setGroup(instance: KernelInstance, id: number, group: number): void {
  checkBits('setGroup: group', group);
  change(instance, 'setGroup', 'set_group', id, groupAt, group);
}

export function setReach(instance: KernelInstance, id: number, distance: number): void {
  if (!isFinitePositive(distance, 0)) badNumber('setReach: distance', distance, 'a finite number, at least 0');
  change(instance, 'setReach', 'set_reach', id, reachAt, distance);
}

/** Sets the number at this place of a rule, unless it is the same. */
function change(instance: KernelInstance, where: string, call: Call, id: number, place: number, value: number): void {
  if (ruleInKernel(instance, where, id)?.[place] !== value) send(instance, where, call, id, value);
}

function send(instance: KernelInstance, where: string, call: Call, id: number, value: number, mask = 0): void {
  try {
    if (instance.kernel[call](id, value, mask) === 0) noBox(where, id);
  } catch (error) {
    instance.recover(error, where);
  }
}

export function filterOf(instance: KernelInstance, id: number): Filter | undefined {
  const rule = ruleOf(instance, 'filterOf', id);
  return rule && { layer: rule[layerAt]!, mask: rule[maskAt]! };
}

export function isStatic(instance: KernelInstance, id: number): boolean {
  return ruleOf(instance, 'isStatic', id)?.[staticAt] === 1;
}

export function isEnabled(instance: KernelInstance, id: number): boolean {
  return ruleOf(instance, 'isEnabled', id)?.[enabledAt] === 1;
}

export function groupOf(instance: KernelInstance, id: number): number | undefined {
  return ruleOf(instance, 'groupOf', id)?.[groupAt];
}

export function reachOf(instance: KernelInstance, id: number): number | undefined {
  return ruleOf(instance, 'reachOf', id)?.[reachAt];
}

/** The kernel's io array, with the rule of this box in it. */
function ruleOf(instance: KernelInstance, where: string, id: number): Float64Array | undefined {
  return ruleInKernel(instance, where, id) ?? (instance.reader.get_rule(id) === 1 ? instance.io() : undefined);
}

/**
 * The same without flushing the ring, which would take as long as setting 20 boxes: rules never wait there. `undefined`
 * if the box itself waits, or if there is none.
 */
function ruleInKernel(instance: KernelInstance, where: string, id: number): Float64Array | undefined {
  checkId(where, id);
  const io = instance.io();
  return instance.exports.get_rule(id) === 1 ? io : undefined;
}
