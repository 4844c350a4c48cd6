// node examples/labels-d3/index.mjs: 300 labels are placed near their points, into labels.svg.
import { writeFileSync } from 'node:fs';
import { placeLabels, toSvg } from './labels.mjs';

const labels = placeLabels(300);
writeFileSync('labels.svg', toSvg(labels));
console.log('labels.svg: 300 labels, none over another');
