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

/** A function that has something drawn in the next frame: once, even if it is called many times until then. */
export function inNextFrame(draw) {
  let request = 0;
  return () => {
    cancelAnimationFrame(request);
    request = requestAnimationFrame(draw);
  };
}

/** The frames of a showcase: they run while something moves and is on the screen, and a button stops them. */
class Frames {
  /** To be set before the first of them runs. */
  demo;
  stopper = make('button', { type: 'button', className: 'button', textContent: 'Stop' });
  #still = matchMedia('(prefers-reduced-motion: reduce)');
  #request = 0;
  #onScreen = true;
  #moving = false;

  constructor() {
    this.#setMoving(false);
    this.stopper.addEventListener('click', () => this.#stop());
    this.#still.addEventListener('change', () => this.#moving && this.wake());
  }

  wake = () => {
    if (this.#still.matches) {
      this.#cancel();
      this.#request = requestAnimationFrame(() => {
        this.#request = 0;
        this.demo.settle();
      });
      return;
    }
    this.#setMoving(true);
    if (!this.#request && this.#onScreen) this.#request = requestAnimationFrame(this.#frame);
  };

  show(onScreen) {
    this.#onScreen = onScreen;
    if (onScreen && this.#moving) this.wake();
  }

  #frame = () => {
    this.#setMoving(this.demo.step());
    this.#request = this.#moving && this.#onScreen ? requestAnimationFrame(this.#frame) : 0;
  };

  #stop() {
    if (!this.#moving) return;
    this.#cancel();
    this.demo.stop?.();
  }

  #cancel() {
    cancelAnimationFrame(this.#request);
    this.#request = 0;
    this.#setMoving(false);
  }

  /** The button is not disabled: it would lose the focus when all is at rest. */
  #setMoving(now) {
    this.#moving = now;
    this.stopper.ariaDisabled = String(!now);
  }
}

/** The contenders to choose from, each with its milliseconds, and what times them all. */
function contendersOf(demo) {
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
  const legend = make('legend', { textContent: demo.legend });
  return { list: make('fieldset', { className: 'contenders' }, legend, ...rows), raceAll };
}

/** Runs a showcase in `stage`, with its controls in `controls`. */
export function runShowcase(show, stage, controls) {
  const status = make('p', { className: 'status', role: 'status' });
  const frames = new Frames();
  const say = (text) => status.textContent !== text && status.replaceChildren(text);
  /** Does it, and says why if it cannot be done: some browsers switch WebAssembly off to be safer. */
  const attempt = async (work) => {
    try {
      await work();
    } catch (error) {
      say(`This stopped: ${error.message}.`);
    }
  };
  const demo = show(stage, { wake: frames.wake, say });
  frames.demo = demo;
  const { list, raceAll } = contendersOf(demo);
  const buttons = Object.entries({ ...demo.actions, 'Race again': raceAll }).map(([label, act]) => {
    const button = make('button', { type: 'button', className: 'button', textContent: label });
    button.addEventListener('click', () => attempt(act));
    return button;
  });
  controls.append(make('div', { className: 'actions' }, ...buttons, frames.stopper), list, status);
  new IntersectionObserver((entries) => {
    const onScreen = entries.at(-1).isIntersecting;
    frames.show(onScreen);
    if (onScreen && !demo.raced) {
      demo.raced = true;
      void attempt(raceAll);
    }
  }).observe(stage);
  return demo;
}
