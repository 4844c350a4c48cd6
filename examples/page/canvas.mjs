// A canvas that fills its stage in device pixels, and the colours of the page, which follow light and dark.

/** Calls draw(context, width, height, colours) now and when size or colours change. Returns a function that does. */
export function canvasIn(stage, draw) {
  const canvas = document.createElement('canvas');
  canvas.setAttribute('aria-hidden', 'true');
  stage.append(canvas);
  const context = canvas.getContext('2d');
  const dark = matchMedia('(prefers-color-scheme: dark)');
  const redraw = () => {
    const [width, height] = [stage.clientWidth, stage.clientHeight];
    if (width * height === 0) return; // hidden
    const density = Math.min(2, devicePixelRatio);
    if (canvas.width !== Math.round(width * density) || canvas.height !== Math.round(height * density)) {
      canvas.width = Math.round(width * density);
      canvas.height = Math.round(height * density);
      canvas.style.width = `${width}px`;
      canvas.style.height = `${height}px`;
    }
    context.setTransform(density, 0, 0, density, 0, 0);
    context.clearRect(0, 0, width, height);
    const page = getComputedStyle(document.body).backgroundColor;
    draw(context, width, height, { dark: dark.matches, page, text: getComputedStyle(stage).color });
  };
  new ResizeObserver(redraw).observe(stage);
  dark.addEventListener('change', redraw);
  return redraw;
}
