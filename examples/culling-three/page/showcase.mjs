// What the showcases share: a list of contenders to choose from, each with its milliseconds on the same input; buttons;
// and a loop that runs while something moves. A showcase is a function (stage, { wake, say }) that returns
//   contenders  the names of the contenders, by key, ours first
//   use(key)    makes that contender do the work from now on
//   race(key)   milliseconds of that contender, on the same input as the others
//   actions     functions by the label of their button
//   step()      runs a frame; returns whether there is more to come
//   settle()    runs all frames at once, if the visitor prefers reduced motion
//   stop()      if there is something to forget when the visitor stops it

const make = (name, properties, ...children) => {
  const element = Object.assign(document.createElement(name), properties);
  element.append(...children);
  return element;
};

const format = (milliseconds) => `${milliseconds < 100 ? milliseconds.toPrecision(2) : Math.round(milliseconds)} ms`;

/** Milliseconds of `work`, the mean of the faster half of some runs, each after `prepare`, which is not timed. */
export function time(work, prepare = () => {}) {
  const times = [];
  const begun = performance.now();
  do {
    prepare();
    const started = performance.now();
    work();
    times.push(performance.now() - started);
  } while (times.length < 5 || (times.length < 200 && performance.now() - begun < 30));
  const faster = times.sort((a, b) => a - b).slice(0, Math.ceil(times.length / 2));
  return faster.reduce((sum, taken) => sum + taken, 0) / faster.length;
}

/** Runs a showcase in `stage`, with its controls in `controls`. */
export function runShowcase(show, stage, controls) {
  const still = matchMedia('(prefers-reduced-motion: reduce)');
  const status = make('p', { className: 'status', role: 'status' });
  const stopper = make('button', { type: 'button', className: 'button', textContent: 'Stop' });
  let [request, onScreen, moving] = [0, true, false];

  // Not disabled: it would lose the focus when all is at rest.
  const setMoving = (now) => {
    moving = now;
    stopper.ariaDisabled = String(!moving);
  };
  setMoving(false);
  const frame = () => {
    setMoving(demo.step());
    request = moving && onScreen ? requestAnimationFrame(frame) : 0;
  };
  const wake = () => {
    if (still.matches) {
      cancelAnimationFrame(request);
      setMoving(false);
      request = requestAnimationFrame(() => {
        request = 0;
        demo.settle();
      });
      return;
    }
    setMoving(true);
    if (!request && onScreen) request = requestAnimationFrame(frame);
  };
  const stop = () => {
    if (!moving) return;
    cancelAnimationFrame(request);
    request = 0;
    setMoving(false);
    demo.stop?.();
  };
  stopper.addEventListener('click', stop);
  still.addEventListener('change', () => moving && wake());
  const demo = show(stage, { wake, say: (text) => status.textContent !== text && status.replaceChildren(text) });

  const outputs = new Map();
  const name = `contender-${Math.random().toString(36).slice(2)}`;
  const rows = Object.entries(demo.contenders).map(([key, label], k) => {
    const input = make('input', { type: 'radio', name, value: key, checked: k === 0 });
    input.addEventListener('change', () => demo.use(key));
    const output = make('output', { textContent: '–', ariaLive: 'off' });
    const bar = make('span', { className: 'share' });
    outputs.set(key, { output, bar });
    return make('label', {}, input, make('span', { className: 'name', textContent: label }), output, bar);
  });
  const raceAll = async () => {
    const times = new Map();
    for (const key of outputs.keys()) {
      await new Promise((done) => setTimeout(done, 30)); // keeps the page responsive
      demo.race(key); // in the first run, the browser compiles
      times.set(key, demo.race(key));
      const slowest = Math.max(...times.values());
      for (const [each, taken] of times) {
        const { output, bar } = outputs.get(each);
        output.textContent = format(taken);
        bar.style.setProperty('--share', String(Math.max(0.01, taken / slowest)));
      }
    }
  };
  const buttons = Object.entries({ ...demo.actions, 'Race again': raceAll }).map(([label, act]) => {
    const button = make('button', { type: 'button', className: 'button', textContent: label });
    button.addEventListener('click', act);
    return button;
  });
  const legend = make('legend', { textContent: demo.legend });
  controls.append(
    make('div', { className: 'actions' }, ...buttons, stopper),
    make('fieldset', { className: 'contenders' }, legend, ...rows),
    status,
  );
  new IntersectionObserver((entries) => {
    onScreen = entries.at(-1).isIntersecting;
    if (onScreen && moving) wake();
    if (onScreen && !demo.raced) {
      demo.raced = true;
      void raceAll();
    }
  }).observe(stage);
  return demo;
}
