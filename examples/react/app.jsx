// What the page shows, and what a server renders; strict mode finds what is not pure.
import { StrictMode } from 'react';
import { Board } from './board.jsx';
import { Notes } from './notes.jsx';

/** search: the end of the address, as location.search. */
export function App({ search }) {
  const notes = new URLSearchParams(search).get('show') === 'notes';
  return <StrictMode>{notes ? <Notes /> : <Board />}</StrictMode>;
}
