// A panel of live numbers: every element with data-number="name" below the root shows the text given for that name.
// Text is replaced only if it has changed, so a still figure costs no layout.
export type NumberPanel = (name: string, text: string) => void;

export function numberPanel(root: ParentNode): NumberPanel {
  const places = new Map<string, { element: Element; text: string }>();
  for (const element of root.querySelectorAll('[data-number]')) {
    places.set(element.getAttribute('data-number')!, { element, text: '' });
  }
  return (name, text) => {
    const place = places.get(name);
    if (!place) throw new Error(`no number is called ${name}`);
    if (place.text === text) return;
    place.text = text;
    place.element.textContent = text;
  };
}
