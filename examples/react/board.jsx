// A board of tiles to select with a rubber band, with useSelection.
import { memo, useEffect, useRef, useState } from 'react';
import { useSelection } from './use-selection.mjs';

const gap = 8;
/** The least height of a row, with the gap below it. */
const row = 38;
const [narrowest, widest] = [18, 84];

/** The boxes of tiles of many widths, which fill a board of this size in rows. */
function layOut(width, height) {
  const boxes = [];
  const rows = Math.floor((height - gap) / row);
  for (let k = 0; k < rows; k++) {
    const top = gap + (k * (height - gap)) / rows;
    const bottom = gap + ((k + 1) * (height - gap)) / rows - gap;
    let left = gap;
    while (left + narrowest + gap <= width) {
      const wanted = left + narrowest + ((boxes.length * 47) % (widest - narrowest));
      const right = wanted + gap + narrowest + gap > width ? width - gap : wanted;
      boxes.push([left, top, right, bottom]);
      left = right + gap;
    }
  }
  return boxes;
}

/** The size of the board while nothing has a size yet: on a server, and until the page has been laid out. */
const rendered = [360, 400];
const sized = (width, height) => ({ boxes: layOut(width, height), width, height });

/** Rendered again only if something about it has changed. */
const Tile = memo(({ id, box: [minX, minY, maxX, maxY], hue, selected, active }) => (
  // biome-ignore lint/a11y/useFocusableInteractive: the board has the focus, and says which tile is active
  <div
    id={`tile-${id}`}
    role="option"
    aria-label={`Tile ${id + 1}`}
    aria-selected={selected}
    className={active ? 'tile active' : 'tile'}
    style={{ left: minX, top: minY, width: maxX - minX, height: maxY - minY, '--hue': hue }}
  />
));

export function Board() {
  const board = useRef(null);
  const [{ boxes, width, height }, resize] = useState(() => sized(...rendered));
  const [focused, setFocused] = useState(false);
  const { selected, band, active, took, handlers } = useSelection(boxes);

  useEffect(() => {
    const observer = new ResizeObserver(([{ contentRect }]) => {
      const { width, height } = contentRect;
      resize(sized(width, height));
    });
    observer.observe(board.current);
    return () => observer.disconnect();
  }, []);

  return (
    <>
      <div
        ref={board}
        className="stage"
        role="listbox"
        aria-label="Tiles. Draw a band, or use the arrow keys; Shift extends, Space toggles, Control A selects all, Escape none."
        aria-multiselectable="true"
        aria-activedescendant={`tile-${active}`}
        tabIndex={0}
        onFocus={({ target }) => setFocused(target.matches(':focus-visible'))}
        onBlur={() => setFocused(false)}
        {...handlers}
      >
        {boxes.map((box, id) => (
          <Tile
            key={`${width} ${box}`}
            id={id}
            box={box}
            hue={Math.round(200 + (120 * box[0]) / width + (60 * box[1]) / height)}
            selected={selected.has(id)}
            active={focused && id === active}
          />
        ))}
        {band && (
          <div
            className="band"
            style={{ left: band[0], top: band[1], width: band[2] - band[0], height: band[3] - band[1] }}
          />
        )}
      </div>
      <footer className="bar">
        <p role="status">
          <b>{selected.size}</b> of {boxes.length} tiles selected
          {took !== undefined && (
            <>
              , asked in <b>{took.toFixed(2)} ms</b>
            </>
          )}
        </p>
        <a href="?show=notes">Notes that overlap</a>
      </footer>
    </>
  );
}
