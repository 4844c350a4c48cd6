// All showcases, each fetched on demand.
export const showcases = {
  nodes: async () => (await import('../nodes-xyflow/demo.jsx')).nodesDemo,
  chart: async () => (await import('../force-d3/rectangles.mjs')).rectanglesDemo('chart'),
  cloud: async () => (await import('../force-d3/rectangles.mjs')).rectanglesDemo('cloud'),
  map: async () => (await import('../force-d3/map.mjs')).mapDemo,
  belt: async () => (await import('../culling-three/demo.mjs')).beltDemo(500_000),
};
