// npm i && npm start: drag a node, paste 500, untangle.
import './page/page.css';
import './page/showcase.css';
import { nodesDemo } from './demo.jsx';
import { runShowcase } from './page/showcase.mjs';

globalThis.example = runShowcase(nodesDemo, document.querySelector('.stage'), document.querySelector('.bar'));
