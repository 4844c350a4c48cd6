// npm i && npm start: a board of tiles to select by a rubber band, with ?show=notes notes that say which overlap.
// `npm run server` has the page rendered before it is sent; the same components then go on in the browser.
import { createRoot, hydrateRoot } from 'react-dom/client';
import { App } from './app.jsx';

const root = document.getElementById('root');
const app = <App search={location.search} />;
if (root.firstElementChild) hydrateRoot(root, app);
else createRoot(root).render(app);
