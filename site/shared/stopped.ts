// Says in the view why a page stopped, which would otherwise be blank: some browsers switch WebAssembly off to be safer.
addEventListener('error', ({ error }) => {
  if (!error) return; // a remark of the browser, not an error of the page
  const view = document.querySelector('.view')!;
  const note = view.querySelector('.stopped') ?? document.createElement('p');
  note.className = 'stopped';
  note.setAttribute('role', 'alert');
  view.append(note);
  note.textContent = `This stopped: ${error instanceof Error ? error.message : String(error)}.`;
});
