// npx vite examples --open /nodes-xyflow/: drag a node, paste 500, untangle.
import '../page/page.css';
import '../page/showcase.css';
import { runShowcase } from '../page/showcase.mjs';
import { nodesDemo } from './demo.jsx';

globalThis.example = runShowcase(nodesDemo, document.querySelector('.stage'), document.querySelector('.bar'));
