import { every } from './every.js';

addEventListener('message', async ({ data }) => postMessage(await every(data).catch(String)));
