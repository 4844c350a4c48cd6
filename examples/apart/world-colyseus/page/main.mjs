// Draws what the zones report: entities in the colour of their zone, ghosts as rings, borders, and what one client
// sees.
const canvas = document.querySelector('canvas');
const pen = canvas.getContext('2d');
const said = document.querySelector('#said');
const rows = document.querySelector('tbody');
const reports = new Map();
const before = new Map();
let world;
let zones = 1;

const colour = (name) => getComputedStyle(document.documentElement).getPropertyValue(name).trim();
/** CSS has a colour for light and one for dark; a canvas needs the one in use. */
const inUse = (name) => {
  const probe = document.createElement('i');
  probe.style.color = `var(${name})`;
  document.body.append(probe);
  const { color } = getComputedStyle(probe);
  probe.remove();
  return color || colour(name);
};
const zoneName = (zone) => `--zone-${zone % 4}`;
const number = (value, digits = 0) => value.toLocaleString('en', { maximumFractionDigits: digits });

function unpack(text) {
  const bytes = Uint8Array.from(atob(text), (letter) => letter.charCodeAt(0));
  return new Uint16Array(bytes.buffer);
}

function draw() {
  requestAnimationFrame(draw);
  if (!world || ![...reports.values()].some(({ drawn }) => !drawn)) return;
  const box = canvas.parentElement.getBoundingClientRect();
  const scale = Math.min(box.width / world.width, box.height / world.height) * devicePixelRatio;
  canvas.width = world.width * scale;
  canvas.height = world.height * scale;
  const at = (value) => (value / 8) * scale;
  const dot = Math.max(1.5, devicePixelRatio * 1.2);
  for (const [zone, report] of reports) {
    report.drawn = true;
    if (performance.now() - report.arrived > 1500) continue;
    pen.fillStyle = pen.strokeStyle = inUse(zoneName(zone));
    pen.globalAlpha = 0.75;
    for (let k = 0; k < report.dots.length; k += 3) {
      pen.fillRect(at(report.dots[k + 1]) - dot / 2, at(report.dots[k + 2]) - dot / 2, dot, dot);
    }
    pen.globalAlpha = 0.35;
    for (let k = 0; k < report.rings.length; k += 2) {
      pen.strokeRect(at(report.rings[k]) - 2 * dot, at(report.rings[k + 1]) - 2 * dot, 4 * dot, 4 * dot);
    }
    pen.globalAlpha = 1;
    const [client, ...seen] = report.followed;
    pen.lineWidth = devicePixelRatio;
    for (const [, x, y] of seen) {
      pen.beginPath();
      pen.moveTo(at(client[1]), at(client[2]));
      pen.lineTo(at(x), at(y));
      pen.stroke();
    }
  }
  pen.fillStyle = inUse('--text');
  for (let k = 1; k < zones; k++) pen.fillRect((canvas.width * k) / zones, 0, devicePixelRatio, canvas.height);
}

function row(report) {
  let line = rows.querySelector(`[data-zone="${report.zone}"]`);
  if (!line) {
    line = document.createElement('tr');
    line.dataset.zone = report.zone;
    line.innerHTML = `${'<td></td>'.repeat(11)}<td><button type="button">Kill its process</button></td>`;
    line.querySelector('button').addEventListener('click', () => {
      fetch(`kill/${reports.get(report.zone).process}`, { method: 'POST' });
    });
    rows.append(line);
    const sorted = [...rows.children].sort((a, b) => a.dataset.zone - b.dataset.zone);
    rows.append(...sorted);
  }
  line.classList.remove('silent');
  const last = before.get(report.zone);
  const seconds = last ? (report.arrived - last.arrived) / 1000 : 0;
  const rate = (name) => (last && report[name] >= last[name] ? (report[name] - last[name]) / seconds : 0);
  const values = [
    `<i style="background: var(${zoneName(report.zone)})"></i>${report.zone}`,
    report.process,
    number(report.entities),
    number(report.ghosts),
    number(report.clients),
    number(report.pairs),
    number(report.work / Math.max(1, report.ticks), 1),
    number(report.worst, 1),
    number(rate('messages')),
    number(rate('bytes') / 1000),
    number(report.given),
  ];
  for (const [k, value] of values.entries()) line.children[k].innerHTML = value;
}

function summary() {
  const all = [...reports.values()].filter(({ arrived }) => performance.now() - arrived < 1500);
  const sum = (name) => all.reduce((total, report) => total + report[name], 0);
  for (const line of rows.children) {
    line.classList.toggle('silent', !all.some(({ zone }) => zone === Number(line.dataset.zone)));
  }
  const processes = new Set(all.map(({ process }) => process)).size;
  said.innerHTML = `<b>${number(sum('entities'))}</b> entities in <b>${all.length}</b> of ${zones} zones and <b>${processes}</b> processes; <b>${number(sum('clients'))}</b> clients, <b>${number(sum('pairs'))}</b> pairs of which one is a client's. Since each room began, <b>${number(sum('began'))}</b> began, <b>${number(sum('ended'))}</b> ended, and <b>${number(sum('given'))}</b> entities were handed over. Lines: whom one client of each zone sees.`;
}

new EventSource('reports').onmessage = ({ data }) => {
  const message = JSON.parse(data);
  if (message.world) {
    ({ world, zones } = message);
    return;
  }
  before.set(message.zone, reports.get(message.zone));
  message.arrived = performance.now();
  message.dots = unpack(message.places);
  message.rings = unpack(message.ghostPlaces);
  reports.set(message.zone, message);
  row(message);
};
setInterval(summary, 250);
draw();
