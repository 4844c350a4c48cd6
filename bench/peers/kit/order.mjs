// The boxes in the order of their first minima, for peers that sort by insertion.
export function orderAlongX(boxes, dimensions) {
  const stride = 2 * dimensions;
  const order = Uint32Array.from({ length: boxes.length / stride }, (_, id) => id);
  return order.sort((a, b) => boxes[stride * a] - boxes[stride * b]);
}
