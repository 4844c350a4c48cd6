// Brings the figures to life: each is loaded and mounted shortly before it comes into sight, and notified when it leaves.

interface FigureModule {
  // biome-ignore lint/suspicious/noConfusingVoidType: a figure that has nothing to stop returns nothing
  mount(root: HTMLElement): void | (() => void);
}

const modules = import.meta.glob<FigureModule>('./figures/*.ts');
/** How far below the screen a figure is mounted, so that it is ready when the reader scrolls to it. */
const ahead = '900px 0px';

async function mount(figure: HTMLElement): Promise<void> {
  const load = modules[`./figures/${figure.dataset.figure}.ts`];
  const live = figure.querySelector<HTMLElement>('.live')!;
  if (!load) return;
  let loaded: FigureModule | undefined;
  try {
    loaded = await load();
    live.replaceChildren();
    const rest = loaded.mount(live);
    if (rest) {
      new IntersectionObserver(([entry]) => {
        if (!entry.isIntersecting) rest();
      }).observe(figure);
    }
    figure.dataset.state = 'live';
  } catch (error) {
    figure.dataset.state = 'failed';
    live.textContent = `This figure stopped: ${error instanceof Error ? error.message : String(error)}`;
    if (!loaded) offerAgain(figure, live); // without a network, perhaps, which comes back
    throw error;
  }
}

function offerAgain(figure: HTMLElement, live: HTMLElement): void {
  const button = document.createElement('button');
  Object.assign(button, { type: 'button', className: 'button', textContent: 'Try again' });
  button.addEventListener('click', () => void mount(figure));
  const row = document.createElement('p');
  row.append(button);
  live.append(row);
}

const nearing = new IntersectionObserver(
  (entries) => {
    for (const { isIntersecting, target } of entries) {
      if (!isIntersecting) continue;
      nearing.unobserve(target);
      void mount(target as HTMLElement);
    }
  },
  { rootMargin: ahead },
);
for (const figure of document.querySelectorAll('figure[data-figure]')) nearing.observe(figure);

// Code in the text can be scrolled by keyboard.
for (const formula of document.querySelectorAll<HTMLElement>('.formula')) formula.tabIndex = 0;
