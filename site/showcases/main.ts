// The page of showcases: each is fetched and started when it comes near the window. Code can be copied with one button.
import { runShowcase } from '../../examples/page/showcase.mjs';
import { showcases } from '../../examples/page/showcases.mjs';
import '../../examples/page/showcase.css';

/** How far below the window a showcase is fetched already. */
const ahead = '400px';
/** How long a button says that it has copied, in milliseconds. */
const said = 1500;

async function start(section: HTMLElement): Promise<void> {
  const controls = section.querySelector<HTMLElement>('.controls')!;
  try {
    const show = await showcases[section.id]!();
    runShowcase(show, section.querySelector<HTMLElement>('.stage')!, controls);
    section.dataset.ready = 'true';
  } catch (error) {
    controls.textContent = `This did not start: ${error instanceof Error ? error.message : String(error)}`;
  }
}

const near = new IntersectionObserver(
  (entries) => {
    for (const { target, isIntersecting } of entries) {
      if (!isIntersecting) continue;
      near.unobserve(target);
      void start(target as HTMLElement);
    }
  },
  { rootMargin: ahead },
);
for (const section of document.querySelectorAll<HTMLElement>('.showcase')) near.observe(section);

for (const code of document.querySelectorAll('pre')) code.tabIndex = 0; // so that it can be scrolled by keyboard

for (const button of document.querySelectorAll<HTMLButtonElement>('.copy')) {
  const label = button.textContent;
  button.addEventListener('click', async () => {
    const code = button.closest('.code-block')!.querySelector('code')!;
    try {
      await navigator.clipboard.writeText(code.textContent!);
      button.textContent = 'Copied';
    } catch {
      getSelection()!.selectAllChildren(code); // so that the visitor can copy it
      button.textContent = 'Selected';
    }
    setTimeout(() => {
      button.textContent = label;
    }, said);
  });
}
