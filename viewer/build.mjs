// Makes dist/: the page, one script and one sheet of styles, the same bytes for the same sources.

import { readFileSync, writeFileSync } from 'node:fs';
import { build } from 'esbuild';

const here = new URL('./', import.meta.url);
const path = (name) => new URL(name, here).pathname;

await build({
  entryPoints: { viewer: path('src/main.js') },
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
  entryPoints: { viewer: path('src/style.css') },
  outdir: path('dist'),
  minify: true,
  target: ['chrome111', 'firefox114', 'safari16.4'],
  logLevel: 'warning',
});
const page = readFileSync(path('page.html'), 'utf8');
writeFileSync(path('dist/index.html'), page.replace(/^ +/gm, '').replace(/\n+/g, '\n'));
