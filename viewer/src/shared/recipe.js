// The panel of a shared page: the values, the script and what else the model was made with.

import { find, make, say } from '../dom.js';
import { toast } from '../toast.js';

/** Fills the panel from `facts`, which may have no recipe. */
export function show({ recipe, seed, place }) {
  find('#recipe').hidden = !recipe;
  find('#no-recipe').hidden = Boolean(recipe);
  find('#place').hidden = !place;
  if (place) find('#place-list').replaceChildren(...pairs(Object.entries(place).map(placed)));
  if (!recipe) return;
  say(find('#seed'), seed);
  find('#values').replaceChildren(...recipe.values.flatMap(value));
  find('#no-values').hidden = recipe.values.length > 0;
  find('#made').replaceChildren(...pairs(parts(recipe)));
  script(recipe.files);
}

function value({ name, value: given, default: before, unit }) {
  const text = shown(given, unit);
  return [
    make('dt', { text: name }),
    make(
      'dd',
      { 'data-testid': `value-${name}`, title: text },
      typeof given === 'string' && /^#[0-9a-f]{6}$/i.test(given) ? swatch(given) : null,
      text,
      before === undefined ? null : make('small', { text: ` default ${shown(before, unit)}` }),
    ),
  ];
}

function swatch(color) {
  const made = make('i', { class: 'swatch', 'aria-hidden': 'true' });
  made.style.background = color;
  return made;
}

function shown(given, unit) {
  if (typeof given === 'boolean') return given ? 'yes' : 'no';
  if (Array.isArray(given)) return `${given.length} points`;
  const text = typeof given === 'number' ? String(Number(given.toPrecision(9))) : String(given);
  if (!unit) return text;
  return unit === 'deg' ? `${text}°` : `${text} ${unit}`;
}

/** What the model was made with besides its values. */
function parts({ program, steps, lod, part, packages = [], data = [], databases }) {
  const rows = [['Program', `Burgeon ${program}`]];
  if (steps !== undefined) rows.push(['Steps', String(steps)]);
  if (lod !== 3) rows.push(['Level of detail', String(lod)]);
  if (part) rows.push(['Part', part[0]]);
  for (const { name, version, hash } of packages) rows.push(['Package', `${name} ${version}`, hash]);
  for (const { name, hash } of data) rows.push(['Data', name, hash]);
  if (databases) rows.push(['Data', 'a database']);
  return rows;
}

const NAMES = { crs: 'Coordinate system' };

function placed([key, given]) {
  const name = NAMES[key] ?? key[0].toUpperCase() + key.slice(1);
  return [name, Array.isArray(given) ? given.join(', ') : String(given)];
}

const pairs = (rows) =>
  rows.flatMap(([name, text, title]) => [make('dt', { text: name }), make('dd', { text, title: title ?? text })]);

/** The files of the script, of which one is shown at a time. */
function script(files) {
  const choice = find('#files');
  const code = find('#code');
  choice.replaceChildren(...files.map(({ name }, i) => make('option', { value: i, text: name })));
  choice.hidden = files.length < 2;
  const chosen = () => files[Number(choice.value) || 0];
  const put = () => {
    const { name, text } = chosen();
    say(find('#file-name'), name);
    find('#file-name').hidden = files.length > 1;
    const lines = text.replace(/\n$/, '').split('\n');
    code.replaceChildren(...lines.map((line) => make('span', { class: 'line', text: `${line}\n` })));
    code.style.setProperty('--digits', String(String(lines.length).length));
    find('#code-place').scrollTop = 0;
  };
  choice.addEventListener('change', put);
  find('#copy').addEventListener('click', async () => {
    try {
      await navigator.clipboard.writeText(chosen().text);
      toast(`${chosen().name} is in the clipboard`);
    } catch {
      getSelection().selectAllChildren(code);
      toast('select and copy the text: the browser allows no clipboard here');
    }
  });
  find('#save-script').addEventListener('click', () => {
    const address = URL.createObjectURL(new Blob([chosen().text], { type: 'text/plain' }));
    make('a', { href: address, download: chosen().name.replace(/^.*\//, '') }).click();
    setTimeout(() => URL.revokeObjectURL(address), 10_000);
  });
  put();
}
