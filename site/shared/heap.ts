// The size of the JavaScript heap, where the browser tells it: in Chromium, exactly on a page that is cross-origin
// isolated, as this site is when served with its headers.

interface HeapClock {
  readonly memory?: { readonly usedJSHeapSize: number };
}

/** Bytes in use on the JavaScript heap, or undefined where the browser does not say. */
export const heapSize = (): number | undefined => (performance as HeapClock).memory?.usedJSHeapSize;
