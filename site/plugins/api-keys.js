// What typedoc does by pointer alone, by keys: Enter in the search opens the first result, if none was chosen with the
// arrows. Results come a moment after the last key, so Enter waits for them.
const wait = 250; // typedoc's own pause is 200 ms

addEventListener('keydown', ({ key, target }) => {
  if (key !== 'Enter' || target.id !== 'tsd-search-input' || target.getAttribute('aria-activedescendant')) return;
  const typed = target.value;
  setTimeout(() => {
    if (target.value === typed) document.querySelector('#tsd-search-results a')?.click();
  }, wait);
});

// On a narrow screen, or zoomed in, the pages are listed in a menu: Enter opens it, Escape closes it.
addEventListener('keydown', (event) => {
  const button = document.querySelector('#tsd-toolbar-menu-trigger');
  if (event.key === 'Enter' && event.target === button) {
    event.preventDefault(); // else it would follow the link that has the focus then
    button.dispatchEvent(new MouseEvent('mouseup'));
    document.querySelector('.col-sidebar a').focus();
  } else if (event.key === 'Escape' && document.documentElement.classList.contains('has-menu')) {
    document.body.dispatchEvent(new MouseEvent('mousedown', { bubbles: true }));
    button.focus();
  }
});
