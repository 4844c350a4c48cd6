// npm i && npm start: a chart of rectangles, with ?show=cloud a cloud of
// words, with ?show=map a map with 20,000 labels.
import './page/page.css';
import './page/showcase.css';
import { mapDemo } from './map.mjs';
import { runShowcase } from './page/showcase.mjs';
import { rectanglesDemo } from './rectangles.mjs';

const demos = { chart: rectanglesDemo('chart'), cloud: rectanglesDemo('cloud'), map: mapDemo };
const wanted = new URLSearchParams(location.search).get('show') ?? 'chart';
const [stage, controls] = document.querySelectorAll('.stage, .bar');
globalThis.example = runShowcase(demos[wanted] ?? demos.chart, stage, controls);
