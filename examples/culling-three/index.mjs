// npm i && npm start: half a million stones, of which only those in view are drawn.
// ?stones=20000 in the URL changes the number.
import './page/page.css';
import './page/showcase.css';
import { beltDemo } from './demo.mjs';
import { runShowcase } from './page/showcase.mjs';

const stones = Number(new URLSearchParams(location.search).get('stones') ?? 500_000);
const [stage, controls] = document.querySelectorAll('.stage, .bar');
globalThis.example = runShowcase(beltDemo(stones), stage, controls);
