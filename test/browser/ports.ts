/** Where the built site is served while the browser tests run. */
export const builtPort = 41873;
/** Where `npm start` is. */
export const startPort = 41874;
/** Where `npx vite examples` is. */
export const examplesPort = 41875;
