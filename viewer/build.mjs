// Makes dist/: the pages of scripts and of tilesets, a script for each and one sheet of styles, the same bytes for the same
// sources.

import { readFileSync, writeFileSync } from 'node:fs';
import { build } from 'esbuild';

const here = new URL('./', import.meta.url);
const path = (name) => new URL(name, here).pathname;

// The renderer of tilesets and the editor are in scripts of their own, so that the page of scripts does not grow.
await build({
  entryPoints: { viewer: path('src/main.js'), tileset: path('src/tileset/main.js') },
  outdir: path('dist'),
  bundle: true,
  minify: true,
  format: 'iife',
  target: ['chrome111', 'firefox114', 'safari16.4'],
  charset: 'utf8',
  legalComments: 'inline',
  logLevel: 'warning',
});
await build({
  entryPoints: { editor: path('src/editor/main.js') },
  outdir: path('dist'),
  bundle: true,
  minify: true,
  format: 'iife',
  globalName: 'burgeonEditor',
  target: ['chrome111', 'firefox114', 'safari16.4'],
  charset: 'utf8',
  legalComments: 'inline',
  logLevel: 'warning',
});
await build({
  entryPoints: { viewer: path('src/style.css'), tileset: path('src/tileset/style.css') },
  outdir: path('dist'),
  minify: true,
  target: ['chrome111', 'firefox114', 'safari16.4'],
  logLevel: 'warning',
});
// What stands between <!--script--> and <!--/script--> is for scripts alone, and the same for tilesets.
const page = readFileSync(path('page.html'), 'utf8');
const other = { script: 'tileset', tileset: 'script' };
for (const [name, kind] of [
  ['index', 'script'],
  ['tileset', 'tileset'],
]) {
  const own = page
    .replace(new RegExp(`<!--${other[kind]}-->[^]*?<!--/${other[kind]}-->\\n?`, 'g'), '')
    .replace(/<!--\/?\w+-->\n?/g, '');
  writeFileSync(path(`dist/${name}.html`), own.replace(/^ +/gm, '').replace(/\n+/g, '\n'));
}
