// The size of the JavaScript heap, if the browser reports it. Chromium does; the size is exact on a cross-origin
// isolated page, as this site is when served with its headers.

interface HeapClock {
  readonly memory?: { readonly usedJSHeapSize: number };
}

/** Bytes in use on the JavaScript heap, or undefined if the browser does not report them. */
export const heapSize = (): number | undefined => (performance as HeapClock).memory?.usedJSHeapSize;
