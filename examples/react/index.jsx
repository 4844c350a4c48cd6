// npm i && npm start: a board of tiles to select with a rubber band; with ?show=notes, notes that know which overlap.
// With `npm run server` the page is rendered on the server, and the same components take over in the browser.
import { createRoot, hydrateRoot } from 'react-dom/client';
import { App } from './app.jsx';

const root = document.getElementById('root');
const app = <App search={location.search} />;
if (root.firstElementChild) hydrateRoot(root, app);
else createRoot(root).render(app);
