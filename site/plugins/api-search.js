// Makes Enter work in the search of the reference: it opens the first result, if none was chosen with the arrows.
// Results come a moment after the last key, so Enter waits for them.
const wait = 250; // typedoc's own pause is 200 ms

addEventListener('keydown', ({ key, target }) => {
  if (key !== 'Enter' || target.id !== 'tsd-search-input' || target.getAttribute('aria-activedescendant')) return;
  const typed = target.value;
  setTimeout(() => {
    if (target.value === typed) document.querySelector('#tsd-search-results a')?.click();
  }, wait);
});
