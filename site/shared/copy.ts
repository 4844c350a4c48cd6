// A button at each code block, which copies it.
const said = 1500; // milliseconds for which the button says that it has copied

for (const block of document.querySelectorAll('.document pre')) {
  const button = Object.assign(document.createElement('button'), {
    type: 'button',
    className: 'copy',
    textContent: 'Copy',
  });
  button.addEventListener('click', async () => {
    button.textContent = await navigator.clipboard.writeText(block.textContent!.trimEnd()).then(
      () => 'Copied',
      () => 'Not allowed',
    );
    setTimeout(() => {
      button.textContent = 'Copy';
    }, said);
  });
  const frame = Object.assign(document.createElement('div'), { className: 'copied' });
  block.replaceWith(frame);
  frame.append(block, button);
}
