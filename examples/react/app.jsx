// What the page shows and a server renders. Strict mode finds code that is not pure.
import { StrictMode } from 'react';
import { Board } from './board.jsx';
import { Notes } from './notes.jsx';

/** search: the query string of the URL, as in location.search. */
export function App({ search }) {
  const notes = new URLSearchParams(search).get('show') === 'notes';
  return <StrictMode>{notes ? <Notes /> : <Board />}</StrictMode>;
}
